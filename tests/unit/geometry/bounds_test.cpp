// World boxes against the support function in double and against sampled surfaces.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/bounds.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "oracle.hpp"

namespace isostep {
namespace bounds_test {

using oracle::D3;

template <class S> class BoundsTest : public testing::Test {
 protected:
  /// Three steps at the size of the coordinates used here, 32 m.
  static double slack() { return 3 * to_double(resolution<S>()) * (kIsFixed<S> ? 1 : 32); }
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(BoundsTest, Scalars);

template <class S> Transform<S> any_transform(oracle::Random& random) {
  const Vec3<S> position = oracle::made<S>(random.point(20));
  return {position, to_matrix(random.orientation<S>())};
}

/// Furthest reach of the primitive along a unit direction of its own frame.
double support(const Primitive<double>& p, D3 d) {
  const double across = std::hypot(d.x, d.z) * p.radius;
  if (p.type == ShapeType::cylinder) return std::fabs(d.y) * p.half.y + across;
  if (p.type == ShapeType::cone) return std::fmax(across - d.y * p.half.y, d.y * p.half.y);
  const double core = std::fabs(d.x) * p.half.x + std::fabs(d.y) * p.half.y + std::fabs(d.z) * p.half.z;
  return core + p.radius * oracle::length(d);
}

TYPED_TEST(BoundsTest, EverySideTouchesTheShape) {
  using S = TypeParam;
  oracle::Random random(1);
  for (int n = 0; n < 300; ++n) {
    const Primitive<S> p = random.primitive<S>(n % 5, 0.05, 8);
    const Transform<S> t = any_transform<S>(random);
    const Aabb<S> box = bounds(p, t);
    const Transform<double> real = oracle::real(t);
    for (int axis = 0; axis < 3; ++axis) {
      const double up = support(oracle::real(p), real.rotation.rows[axis]);
      const double down = support(oracle::real(p), -real.rotation.rows[axis]);
      EXPECT_NEAR(to_double(box.high[axis]), real.position[axis] + up, this->slack()) << n;
      EXPECT_NEAR(to_double(box.low[axis]), real.position[axis] - down, this->slack()) << n;
    }
  }
}

TYPED_TEST(BoundsTest, NoSurfacePointLiesOutside) {
  using S = TypeParam;
  oracle::Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Primitive<S> p = random.primitive<S>(n % 5, 0.05, 8);
    const Transform<S> t = any_transform<S>(random);
    const Aabb<S> box = bounds(p, t);
    const Primitive<double> shape = oracle::real(p);
    for (int k = 0; k < 50; ++k) {
      const D3 d = random.direction();
      const double far = 40;  // bisect from the centre outwards
      double low = 0, high = far;
      for (int i = 0; i < 60; ++i) {
        const double mid = (low + high) / 2;
        (oracle::signed_distance(shape, d * mid) < 0 ? low : high) = mid;
      }
      const D3 world = to_world(oracle::real(t), d * low);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(world[axis], to_double(box.low[axis]) - this->slack());
        EXPECT_LE(world[axis], to_double(box.high[axis]) + this->slack());
      }
    }
  }
}

TYPED_TEST(BoundsTest, ALevelFloorEndsAtItsSurface) {
  using S = TypeParam;
  using U = Unit<S>;
  const Primitive<S> floor = primitive_of(HalfSpace<S>{{U(0), U(1), U(0)}, S(0.5)});
  const Transform<S> t = {{S(3), S(-2), S(7)}, Mat3<U>::identity()};
  const Aabb<S> box = bounds(floor, t);
  EXPECT_EQ(box.high.y, S(-1.5));
  EXPECT_LT(box.low.y, -Limits<S>::position());
  EXPECT_GT(box.high.x, Limits<S>::position());
  EXPECT_TRUE(overlap(box, Aabb<S>::around({S(100), S(-1), S(0)}, {S(1), S(1), S(1)})));
  EXPECT_FALSE(overlap(box, Aabb<S>::around({S(100), S(1), S(0)}, {S(1), S(1), S(1)})));
}

TYPED_TEST(BoundsTest, ACeilingBeginsAtItsSurface) {
  using S = TypeParam;
  using U = Unit<S>;
  const Primitive<S> ceiling = primitive_of(HalfSpace<S>{{U(0), U(-1), U(0)}, S(-4)});  // all points with y >= 4
  const Aabb<S> box = bounds(ceiling, {{S(0), S(1), S(0)}, Mat3<U>::identity()});
  EXPECT_EQ(box.low.y, S(5));
}

TYPED_TEST(BoundsTest, ATiltedHalfSpaceIsBoundedByTheWorldAlone) {
  using S = TypeParam;
  oracle::Random random(3);
  const Primitive<S> slope = primitive_of(HalfSpace<S>{{Unit<S>(0.6), Unit<S>(0.8), Unit<S>(0)}, S(0)});
  const Aabb<S> box = bounds(slope, any_transform<S>(random));
  EXPECT_TRUE(contains(
      box, Aabb<S>::around(Vec3<S>::zero(), {Limits<S>::position(), Limits<S>::position(), Limits<S>::position()})));
}

TYPED_TEST(BoundsTest, AListIsBoundedByItsChildrenTogether) {
  using S = TypeParam;
  using U = Unit<S>;
  const Primitive<S> ball = primitive_of(Sphere<S>{S(0.5)});
  const Primitive<S> rod = primitive_of(Capsule<S>{S(0.25), S(1)});
  Child<S> low = {ball, Pose<S>::identity()}, high = {rod, Pose<S>::identity()};
  low.pose.position = {S(-2), S(0), S(0)};
  high.pose.position = {S(3), S(4), S(0)};
  const std::vector<Child<S>> list = {low, high};
  // A quarter turn about z, exact: x to y, y to -x.
  const Transform<S> quarter = {{S(10), S(0), S(0)}, {{{U(0), U(-1), U(0)}, {U(1), U(0), U(0)}, {U(0), U(0), U(1)}}}};
  const Aabb<S> box = bounds(std::span<const Child<S>>(list), quarter);
  EXPECT_EQ(box.low, (Vec3<S>{S(4.75), S(-2.5), S(-0.5)}));
  EXPECT_EQ(box.high, (Vec3<S>{S(10.5), S(3.25), S(0.5)}));
}

TEST(Limits, AreWhatTheirPageSays) {
  EXPECT_EQ(to_double(Limits<Q16_16>::extent()), 128);
  EXPECT_EQ(to_double(Limits<Q16_16>::minimum_size()), 1.0 / 64);
  EXPECT_EQ(to_double(Limits<Q16_16>::position()), 512);
  EXPECT_EQ(to_double(Limits<Q16_16>::speed()), 64);
  EXPECT_EQ(to_double(Limits<Q16_16>::angular_speed()), 64);
  EXPECT_EQ(to_double(Limits<Q16_16>::mass()), 8192);
  EXPECT_EQ(to_double(Limits<Q16_16>::mass_ratio()), 128);
  EXPECT_EQ(to_double(Limits<Q32_32>::extent()), 16384);
  EXPECT_EQ(to_double(Limits<Q32_32>::position()), 1048576);
  EXPECT_EQ(to_double(Limits<Q32_32>::minimum_size()), 1.0 / 1024);
}

/// The inequalities of the argument, for shipped formats and a user's own.
template <class S> void expect_argued_limits() {
  const double top = to_double(S::highest());
  const double extent = to_double(Limits<S>::extent()), speed = to_double(Limits<S>::speed());
  const double angular_speed = to_double(Limits<S>::angular_speed()), size = to_double(Limits<S>::minimum_size());
  EXPECT_LT(extent * extent, top);
  EXPECT_LT(3 * speed * speed, top);
  EXPECT_LT(2 * (speed + std::sqrt(3.0) * angular_speed * extent), top);
  EXPECT_LT(16 * to_double(Limits<S>::position()), top);
  EXPECT_GE(to_double(Limits<S>::position()), extent);
  EXPECT_LT(2.5 / (size * size), top);
  EXPECT_GE(size, 1000 * to_double(resolution<S>()));
  EXPECT_LT(2 * to_double(Limits<S>::mass()), top);
}
TEST(Limits, LeaveRoomForEveryIntermediateNamed) {
  expect_argued_limits<Q16_16>();
  expect_argued_limits<Q32_32>();
  expect_argued_limits<Fixed<std::int64_t, 40>>();
  expect_argued_limits<Fixed<std::int64_t, 48>>();
  expect_argued_limits<Fixed<std::int32_t, 20>>();
}

}  // namespace bounds_test
}  // namespace isostep
