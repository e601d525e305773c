// The measures against closed forms.
// SPDX-License-Identifier: MIT
#include "scenes/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/distance.hpp"

namespace isostep::scenes {
namespace measure_test {

const Mat3<double> kUpright = to_matrix(Quat<double>::identity());
Mat3<double> turned(Vec3<double> axis, double angle) {
  return to_matrix(Quat<double>{axis.x * std::sin(angle / 2), axis.y * std::sin(angle / 2),
                                axis.z * std::sin(angle / 2), std::cos(angle / 2)});
}
Solid solid(ShapeType type, Vec3<double> centre, Vec3<double> half, double radius,
            const Mat3<double>& axes = kUpright) {
  return {type, centre, axes, half, radius, {0, 0, 0}, 0};
}
Solid box(Vec3<double> centre, Vec3<double> half, const Mat3<double>& axes = kUpright) {
  return solid(ShapeType::box, centre, half, 0, axes);
}
Solid sphere(Vec3<double> centre, double radius) { return solid(ShapeType::sphere, centre, {0, 0, 0}, radius); }
Solid capsule(Vec3<double> centre, double half, double radius, const Mat3<double>& axes = kUpright) {
  return solid(ShapeType::capsule, centre, {0, half, 0}, radius, axes);
}
constexpr double kHalfPi = 1.5707963267948966;

void expect_distance(const Solid& a, const Solid& b, double expected) {
  EXPECT_NEAR(signed_distance(a, b), expected, 1e-12);
  EXPECT_NEAR(signed_distance(b, a), expected, 1e-12);
}

TEST(Distance, OfSpheresIsThatOfTheirCentresLessTheRadii) {
  expect_distance(sphere({0, 0, 0}, 1), sphere({3, 4, 0}, 2), 2);
  expect_distance(sphere({0, 0, 0}, 3), sphere({3, 4, 0}, 3), -1);
}
TEST(Distance, OfCapsulesThatCrossIsAlongTheirCommonPerpendicular) {
  const Mat3<double> sideways = turned({0, 0, 1}, kHalfPi);
  expect_distance(capsule({0, 0, 0}, 2, 0.5), capsule({0, 0.3, 2}, 2, 0.25, sideways), 1.25);
  expect_distance(capsule({0, 0, 0}, 2, 1.5), capsule({0, 0.3, 2}, 2, 1, sideways), -0.5);
}
TEST(Distance, OfParallelCapsulesThatPassIsOfTheirLines) {
  expect_distance(capsule({0, 0, 0}, 1, 0.25), capsule({1, 1.5, 0}, 1, 0.25), 0.5);
  expect_distance(capsule({0, 0, 0}, 1, 0.25), capsule({3, 6, 0}, 1, 0.25), 4.5);  // ends 3, 4 apart
}
TEST(Distance, OfBoxesIsTheLeastOverlapOfAnyAxis) {
  expect_distance(box({0, 0, 0}, {1, 1, 1}), box({1.9, 0.5, 0.2}, {1, 1, 1}), -0.1);
  expect_distance(box({0, 0, 0}, {1, 1, 1}), box({2.25, 0, 0}, {1, 1, 1}), 0.25);
}
TEST(Distance, OfAnEdgeAboveAFaceIsThatOfTheEdge) {
  const double reach = std::sqrt(2.0);
  expect_distance(box({0, 0, 0}, {5, 1, 5}), box({0, 1 + reach - 0.125, 0}, {1, 1, 1}, turned({0, 0, 1}, kHalfPi / 2)),
                  -0.125);
}
/// Edges along z and x, both turned up by 45 degrees: they meet on the line between the centres.
TEST(Distance, OfCrossedEdgesIsAlongTheirCrossProduct) {
  const double reach = std::sqrt(2.0);
  const Solid low = box({0, 0, 0}, {1, 1, 4}, turned({0, 0, 1}, kHalfPi / 2));
  const Solid high = box({0, 2 * reach - 0.1, 0}, {4, 1, 1}, turned({1, 0, 0}, kHalfPi / 2));
  expect_distance(low, high, -0.1);
}
TEST(Distance, OfASphereAtACornerIsToTheCorner) {
  expect_distance(box({0, 0, 0}, {1, 1, 1}), sphere({2, 3, 3}, 1), 2);  // (1, 2, 2) from the corner
  expect_distance(box({0, 0, 0}, {1, 2, 3}), sphere({0.5, 0, 0}, 0.25), -0.75);
}
TEST(Distance, OfACapsuleOverABoxIsOfItsNearestPoint) {
  const Mat3<double> lying = turned({0, 0, 1}, kHalfPi);
  expect_distance(box({0, 0, 0}, {1, 1, 1}), capsule({0, 2, 0}, 5, 0.25, lying), 0.75);
  expect_distance(box({0, 0, 0}, {1, 1, 1}), capsule({0, 1.125, 0}, 5, 0.25, lying), -0.125);
  expect_distance(box({0, 0, 0}, {1, 1, 1}), capsule({0.5, 3, 0}, 1, 0.5), 0.5);
  expect_distance(box({0, 0, 0}, {3, 1, 3}), capsule({0, 1.5, 0}, 1, 0.25), -0.75);  // its core dips in 0.5
}
TEST(Distance, ToAHalfSpaceIsThatOfTheLowestPoint) {
  Solid ground = {ShapeType::half_space, {0, 0, 0}, kUpright, {0, 0, 0}, 0, {0, 1, 0}, 2};
  expect_distance(ground, sphere({7, 4, 1}, 0.5), 1.5);
  expect_distance(ground, box({0, 2 + std::sqrt(2.0), 0}, {1, 1, 1}, turned({0, 0, 1}, kHalfPi / 2)), 0);
  expect_distance(ground, capsule({0, 3, 0}, 1, 0.25), -0.25);
}

template <class S> class Measure : public testing::Test {
 protected:
  World<S> world = World<S>({60, 4, {S(0), S(-10), S(0)}, false, SolverName::soft_step});
  BodyId add(ShapeId shape, double x, double y, double z, BodyType type = BodyType::dynamic) {
    BodyDefinition<S> body;
    body.type = type;
    body.shape = shape;
    body.position = {from_double<S>(x), from_double<S>(y), from_double<S>(z)};
    return world.create(body);
  }
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Measure, Scalars);

/// Overlaps of 1/4, 1/8 and, 1/256 apart, 0; a fourth neighbour 1/16 away does not count.
TYPED_TEST(Measure, OverlapIsOfPairsCloserThanACentimetre) {
  const ShapeId cube = this->world.add_shape(Box{{0.5, 0.5, 0.5}});
  this->add(cube, 0, 0, 0);
  this->add(cube, 0.75, 0, 0);
  this->add(cube, 1.625, 0, 0);
  this->add(cube, 2.62890625, 0, 0);
  this->add(cube, 3.69140625, 0, 0);
  const Overlap overlap = measure_overlap(this->world);
  EXPECT_EQ(overlap.pairs, 3u);
  EXPECT_EQ(overlap.deep, 2u);
  EXPECT_NEAR(overlap.worst, 0.25, 1e-9);
  EXPECT_NEAR(overlap.p99, 0.25, 1e-9);
  EXPECT_NEAR(overlap.mean, 0.125, 1e-9);
}

TYPED_TEST(Measure, OverlapLeavesOutFixedPairsAndJoinedPairs) {
  using S = TypeParam;
  const ShapeId ball = this->world.add_shape(Sphere{0.5});
  this->add(ball, 0, 0, 0, BodyType::static_);
  this->add(ball, 0.25, 0, 0, BodyType::static_);
  const BodyId a = this->add(ball, 10, 0, 0), b = this->add(ball, 10.5, 0, 0);
  EXPECT_NEAR(measure_overlap(this->world).worst, 0.5, 1e-9);
  const Pose<S> middle = {{from_double<S>(10.25), S(0), S(0)}, Quat<Unit<S>>::identity()};
  ASSERT_TRUE(this->world.create(this->world.joint_at(JointType::ball, a, b, middle)));
  EXPECT_EQ(measure_overlap(this->world).pairs, 0u);
}

/// A 2 x 2 x 2 box of 8 kg, m w^2 (2^2 + 2^2) / 12 / 2 = 8/3 w^2: 3 m/s, 2 rad/s, 5 m up.
TYPED_TEST(Measure, EnergyIsKineticOfBothKindsAndPotential) {
  using S = TypeParam;
  const BodyId body = this->add(this->world.add_shape(Box{{1, 1, 1}}), 1, 5, 2);
  ASSERT_TRUE(this->world.set_velocity(body, {S(3), S(0), S(0)}, {S(0), S(2), S(0)}));
  const Energy energy = measure_energy(this->world);
  EXPECT_NEAR(energy.mass, 8, 1e-3);
  EXPECT_NEAR(energy.kinetic, 0.5 * 8 * 9 + 8.0 / 3 * 4, 0.01);
  EXPECT_NEAR(energy.potential, 8 * 10 * 5, 0.05);
}

TYPED_TEST(Measure, JointErrorIsTheDistanceOfTheAnchors) {
  using S = TypeParam;
  const BodyId body = this->add(this->world.add_shape(Sphere{0.5}), 0, 0, 0);
  const Pose<S> origin = Pose<S>::identity();
  ASSERT_TRUE(this->world.create(this->world.joint_at(JointType::ball, BodyId{}, body, origin)));
  EXPECT_EQ(largest_joint_error(this->world), 0);
  this->world.set_pose(body, {{S(3), S(4), S(0)}, Quat<Unit<S>>::identity()});
  EXPECT_NEAR(largest_joint_error(this->world), 5, 1e-4);
}

}  // namespace measure_test
}  // namespace isostep::scenes
