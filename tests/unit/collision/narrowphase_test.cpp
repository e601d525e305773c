// The contact manifolds of every pair of primitives against closed forms.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <vector>

#include "narrowphase/cases.hpp"

namespace isostep::test {
namespace narrowphase_test {

constexpr double kPi = std::numbers::pi;

template <class S> class NarrowPhase : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(NarrowPhase, Scalars);

#define EXPECT_VECTOR(v, expected, tolerance)           \
  do {                                                  \
    const Point p_ = point_of(v), e_ = expected;        \
    EXPECT_NEAR(p_[0], e_[0], tolerance) << "x of " #v; \
    EXPECT_NEAR(p_[1], e_[1], tolerance) << "y of " #v; \
    EXPECT_NEAR(p_[2], e_[2], tolerance) << "z of " #v; \
  } while (false)

/// The manifold's points in ascending x, then z.
template <class S> std::vector<Point> sorted_points(const Manifold<S>& m) {
  std::vector<Point> points;
  for (int i = 0; i < m.count; ++i) points.push_back(point_of(m.points[i].position));
  std::sort(points.begin(), points.end(),
            [](Point a, Point b) { return std::abs(a[0] - b[0]) > 1e-3 ? a[0] < b[0] : a[2] < b[2]; });
  return points;
}

// ---- spheres

TYPED_TEST(NarrowPhase, SpheresTouchMidwayBetweenTheirSurfaces) {
  using S = TypeParam;
  const auto m = touch(sphere_of<S>(1), at<S>({0, 0, 0}), sphere_of<S>(0.5), at<S>({0.84, 1.12, 0}));  // 1.4 apart
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0.6, 0.8, 0}), rounding<S>(1));
  EXPECT_NEAR(to_double(m.points[0].separation), -0.1, rounding<S>(1));
  EXPECT_VECTOR(m.points[0].position, (Point{0.57, 0.76, 0}), rounding<S>(1));  // 0.95 along the normal
}
TYPED_TEST(NarrowPhase, ConcentricSpheresPartUpwards) {
  using S = TypeParam;
  const auto m = touch(sphere_of<S>(1), at<S>({3, 4, 5}), sphere_of<S>(0.5), at<S>({3, 4, 5}));
  ASSERT_EQ(m.count, 1);
  EXPECT_TRUE((m.normal == Vec3<Unit<S>>{0, 1, 0}));
  EXPECT_EQ(to_double(m.points[0].separation), -1.5);
  EXPECT_VECTOR(m.points[0].position, (Point{3, 4.25, 5}), 0.0);  // surfaces at +1 and -0.5
}
TYPED_TEST(NarrowPhase, SpheresWithinTheMarginTouchAndBeyondItDoNot) {
  using S = TypeParam;
  const auto near = touch(sphere_of<S>(1), at<S>({0, 0, 0}), sphere_of<S>(1), at<S>({2.015625, 0, 0}));
  ASSERT_EQ(near.count, 1);
  EXPECT_NEAR(to_double(near.points[0].separation), 0.015625, rounding<S>(1));
  EXPECT_EQ(touch(sphere_of<S>(1), at<S>({0, 0, 0}), sphere_of<S>(1), at<S>({2.03125, 0, 0})).count, 0);
}
TYPED_TEST(NarrowPhase, SphereTouchesEachOfTheBoxes26RegionsAtItsClosestPoint) {
  using S = TypeParam;
  const Point half = {0.5, 1, 1.5};
  for (int region = 0; region < 27; ++region) {
    const Point side = {double(region % 3 - 1), double(region / 3 % 3 - 1), double(region / 9 - 1)};
    if (length3(side) == 0) continue;
    const Point out = side * (1 / length3(side));
    Point surface;
    for (std::size_t k = 0; k < 3; ++k) surface[k] = side[k] * half[k] + (side[k] == 0 ? 0.125 : 0);
    const Transform<S> frame = at<S>({0.5, -0.25, 2}, {1, 2, 3}, 0.7);
    const Point centre = surface + out * 0.3;  // 0.3 from the box, radius 0.35: 0.05 of overlap
    const Point world = point_of(to_world(frame, vec_of<S>(centre)));
    const auto m = touch(sphere_of<S>(0.35), at<S>(world), box_of<S>(half[0], half[1], half[2]), frame);
    ASSERT_EQ(m.count, 1) << region;
    // The sphere's centre is rounded to a resolution, which turns a normal taken from 0.3 m.
    EXPECT_VECTOR(m.normal, point_of(-(frame.rotation * vec_of<Unit<S>>(out))), rounding<S>(3) / 0.3);
    EXPECT_NEAR(to_double(m.points[0].separation), -0.05, rounding<S>(3));
    EXPECT_VECTOR(m.points[0].position, point_of(to_world(frame, vec_of<S>(surface - out * 0.025))),
                  2 * rounding<S>(3));
  }
}
TYPED_TEST(NarrowPhase, SphereWithItsCentreInsideABoxLeavesByTheNearestFace) {
  using S = TypeParam;
  for (std::size_t k = 0; k < 3; ++k) {
    for (double sign : {-1.0, 1.0}) {
      Point centre = {0.125, 0.125, 0.125}, out = {0, 0, 0};
      centre[k] = sign * 0.75;
      out[k] = sign;
      const auto m = touch(sphere_of<S>(0.5), at<S>(centre), box_of<S>(1, 1, 1), at<S>({0, 0, 0}));
      ASSERT_EQ(m.count, 1);
      EXPECT_VECTOR(m.normal, out * -1, 0.0);
      EXPECT_EQ(to_double(m.points[0].separation), -0.75);
      Point expected = centre;
      expected[k] = sign * 0.625;  // between the face at 1 and the sphere's far side at 0.25
      EXPECT_VECTOR(m.points[0].position, expected, 0.0);
    }
  }
}
TYPED_TEST(NarrowPhase, SphereAtTheBoxesCentreLeavesByTheLeastFaceWithTheLowestAxis) {
  using S = TypeParam;
  const auto m = touch(sphere_of<S>(0.25), at<S>({0, 0, 0}), box_of<S>(2, 1, 1), at<S>({0, 0, 0}));
  ASSERT_EQ(m.count, 1);
  EXPECT_TRUE((m.normal == Vec3<Unit<S>>{0, -1, 0}));
  EXPECT_EQ(to_double(m.points[0].separation), -1.25);
}
TYPED_TEST(NarrowPhase, SphereTouchesACapsulesSideAndItsEnd) {
  using S = TypeParam;
  const auto side = touch(sphere_of<S>(0.5), at<S>({0.7, 0.25, 0}), capsule_of<S>(0.25, 1), at<S>({0, 0, 0}));
  ASSERT_EQ(side.count, 1);
  EXPECT_VECTOR(side.normal, (Point{-1, 0, 0}), rounding<S>(1));
  EXPECT_NEAR(to_double(side.points[0].separation), -0.05, rounding<S>(1));
  EXPECT_VECTOR(side.points[0].position, (Point{0.225, 0.25, 0}), rounding<S>(1));
  const auto end = touch(sphere_of<S>(0.5), at<S>({0.42, 1.56, 0}), capsule_of<S>(0.25, 1), at<S>({0, 0, 0}));
  ASSERT_EQ(end.count, 1);  // 0.7 from the end of the core
  EXPECT_VECTOR(end.normal, (Point{-0.6, -0.8, 0}), rounding<S>(1));
  EXPECT_NEAR(to_double(end.points[0].separation), -0.05, rounding<S>(1));
}
TYPED_TEST(NarrowPhase, SphereOnACapsulesAxisLeavesAcrossIt) {
  using S = TypeParam;
  const auto m = touch(sphere_of<S>(0.5), at<S>({0, 0.25, 0}), capsule_of<S>(0.25, 1), at<S>({0, 0, 0}));
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(to_double(m.normal.y), 0.0);
  EXPECT_NEAR(length3(point_of(m.normal)), 1, rounding<S>(1));
  EXPECT_EQ(to_double(m.points[0].separation), -0.75);
}

// ---- half-spaces

TYPED_TEST(NarrowPhase, SphereAndBoxRestOnAHalfSpace) {
  using S = TypeParam;
  const auto ground = half_space_of<S>({0, 1, 0}, 0.5);
  const auto ball = touch(sphere_of<S>(1), at<S>({2, 1.25, 3}), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(ball.count, 1);
  EXPECT_VECTOR(ball.normal, (Point{0, -1, 0}), 0.0);
  EXPECT_EQ(to_double(ball.points[0].separation), -0.25);
  EXPECT_VECTOR(ball.points[0].position, (Point{2, 0.375, 3}), 0.0);
  const auto crate = touch(box_of<S>(1, 2, 3), at<S>({2, 2.25, 3}), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(crate.count, 4);
  const auto corners = sorted_points(crate);
  EXPECT_EQ(corners, (std::vector<Point>{{1, 0.375, 0}, {1, 0.375, 6}, {3, 0.375, 0}, {3, 0.375, 6}}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(to_double(crate.points[i].separation), -0.25);
}
TYPED_TEST(NarrowPhase, TiltedBoxTouchesAHalfSpaceWithAnEdgeOrACorner) {
  using S = TypeParam;
  const auto ground = half_space_of<S>({0, 1, 0}, 0);
  const auto edge = touch(box_of<S>(1, 1, 2), at<S>({0, 1.4, 0}, {0, 0, 1}, kPi / 4), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(edge.count, 2);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(to_double(edge.points[i].separation), 1.4 - std::sqrt(2.0), rounding<S>(2));
  const Point diagonal = {1, 0, -1};  // about this axis by acos(1/sqrt 3) a corner points down
  const auto corner =
      touch(box_of<S>(1, 1, 1), at<S>({0, 1.7, 0}, diagonal, std::acos(1 / std::sqrt(3.0))), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(corner.count, 1);
  EXPECT_NEAR(to_double(corner.points[0].separation), 1.7 - std::sqrt(3.0), rounding<S>(2));
}
TYPED_TEST(NarrowPhase, HalfSpaceKeepsTheVerticesOfTheFaceThatLooksMostAtIt) {
  using S = TypeParam;
  Random random(11);
  for (int n = 0; n < 200; ++n) {
    const double x = random.in(0.1, 1), y = random.in(0.1, 1);
    const auto crate = box_of<S>(x, y, random.in(0.1, 1));
    const auto pose = random_pose<S>(random, 1);
    const auto ground = half_space_of<S>(random.direction(), 5);  // all eight are under it
    const auto m = touch(crate, pose, ground, at<S>({0, 0, 0}));
    const Solid box = solid(crate, pose), plane = solid(ground, at<S>({0, 0, 0}));
    double most = 0;
    Point down = {0, 0, 0};  // out of that face
    for (std::size_t k = 0; k < 3; ++k) {
      const double facing = dot3(plane.normal, box.axes[k]);
      if (std::abs(facing) <= most) continue;
      most = std::abs(facing);
      for (std::size_t i = 0; i < 3; ++i) down[i] = facing > 0 ? -box.axes[k][i] : box.axes[k][i];
    }
    std::vector<double> depths;
    for (int i = 0; i < 8; ++i) {
      const Point corner = box.corner(i);
      if (dot3(down, corner - box.centre) > 0) depths.push_back(dot3(plane.normal, corner) - plane.offset);
    }
    std::sort(depths.begin(), depths.end());
    ASSERT_EQ(m.count, 4);
    std::vector<double> found;
    for (int i = 0; i < 4; ++i) found.push_back(to_double(m.points[i].separation));
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], depths[i], rounding<S>(5));
  }
}
TYPED_TEST(NarrowPhase, CapsuleLiesOnAHalfSpaceWithBothEndsAndStandsOnOne) {
  using S = TypeParam;
  const auto ground = half_space_of<S>({0, 1, 0}, 0);
  const auto lying = touch(capsule_of<S>(0.5, 1), at<S>({0, 0.5, 0}, {0, 0, 1}, kPi / 2), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(lying.count, 2);
  const auto ends = sorted_points(lying);
  EXPECT_NEAR(ends[0][0], -1, rounding<S>(1));
  EXPECT_NEAR(ends[1][0], 1, rounding<S>(1));
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(to_double(lying.points[i].separation), 0, rounding<S>(1));
  const auto standing = touch(capsule_of<S>(0.5, 1), at<S>({0, 1.5, 0}), ground, at<S>({0, 0, 0}));
  ASSERT_EQ(standing.count, 1);
  EXPECT_EQ(to_double(standing.points[0].separation), 0.0);
}
TYPED_TEST(NarrowPhase, HalfSpacesNeverTouch) {
  using S = TypeParam;
  const auto up = half_space_of<S>({0, 1, 0}, 1), down = half_space_of<S>({0, -1, 0}, 1);
  EXPECT_EQ(touch(up, at<S>({0, 0, 0}), down, at<S>({0, 0, 0})).count, 0);
}

// ---- capsules

TYPED_TEST(NarrowPhase, CrossedCapsulesTouchInOnePoint) {
  using S = TypeParam;
  const auto m = touch(capsule_of<S>(0.5, 2), at<S>({0, 0, 0}, {0, 0, 1}, kPi / 2), capsule_of<S>(0.25, 2),
                       at<S>({0.5, 0.7, -0.25}, {1, 0, 0}, kPi / 2));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), rounding<S>(2));
  EXPECT_NEAR(to_double(m.points[0].separation), -0.05, rounding<S>(2));
  EXPECT_VECTOR(m.points[0].position, (Point{0.5, 0.475, 0}), rounding<S>(2));
}
TYPED_TEST(NarrowPhase, ParallelCapsulesTouchInTwoPointsAtTheEndsOfTheirOverlap) {
  using S = TypeParam;
  for (double turn : {0.0, kPi}) {  // b in the same sense and in the opposite one
    const auto m =
        touch(capsule_of<S>(0.5, 1), at<S>({0, 0, 0}), capsule_of<S>(0.5, 1), at<S>({1, 1.25, 0}, {1, 0, 0}, turn));
    ASSERT_EQ(m.count, 2);
    EXPECT_VECTOR(m.normal, (Point{1, 0, 0}), rounding<S>(1));
    double low = 9, high = -9;
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(to_double(m.points[i].separation), 0, rounding<S>(1));
      low = std::min(low, to_double(m.points[i].position.y));
      high = std::max(high, to_double(m.points[i].position.y));
    }
    EXPECT_NEAR(low, 0.25, rounding<S>(1));
    EXPECT_NEAR(high, 1, rounding<S>(1));
    EXPECT_NE(m.points[0].feature, m.points[1].feature);
  }
}
TYPED_TEST(NarrowPhase, CapsulesEndToEndTouchInOnePoint) {
  using S = TypeParam;
  const auto m = touch(capsule_of<S>(0.5, 1), at<S>({0, 0, 0}), capsule_of<S>(0.5, 1), at<S>({0, 2.9375, 0}));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), rounding<S>(1));
  EXPECT_EQ(to_double(m.points[0].separation), -0.0625);
}
TYPED_TEST(NarrowPhase, CapsulesWhoseAxesCrossLeaveAcrossBoth) {
  using S = TypeParam;
  const auto m =
      touch(capsule_of<S>(0.5, 2), at<S>({0, 0, 0}), capsule_of<S>(0.25, 2), at<S>({0, 0, 0}, {1, 0, 0}, kPi / 2));
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(std::abs(to_double(m.normal.x)), 1, rounding<S>(1));
  EXPECT_NEAR(to_double(m.points[0].separation), -0.75, rounding<S>(1));
}
TYPED_TEST(NarrowPhase, CapsulesThatCoincideLeaveAcrossTheirAxis) {
  using S = TypeParam;
  const auto m = touch(capsule_of<S>(0.5, 2), at<S>({1, 1, 1}), capsule_of<S>(0.5, 2), at<S>({1, 1, 1}));
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(to_double(m.normal.y), 0, rounding<S>(1));
  EXPECT_NEAR(length3(point_of(m.normal)), 1, rounding<S>(1));
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(to_double(m.points[i].separation), -1, rounding<S>(1));
}

// ---- boxes and capsules

TYPED_TEST(NarrowPhase, CapsuleLyingOnABoxTouchesAtTheEndsOfTheStretchAboveTheFace) {
  using S = TypeParam;
  const auto m = touch(box_of<S>(1, 0.5, 1), at<S>({0, 0, 0}), capsule_of<S>(0.25, 1),
                       at<S>({0.5, 0.75, 0.25}, {0, 0, 1}, kPi / 2));
  ASSERT_EQ(m.count, 2);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), 0.0);
  const auto ends = sorted_points(m);
  EXPECT_NEAR(ends[0][0], -0.5, rounding<S>(2));  // the capsule's end
  EXPECT_NEAR(ends[1][0], 1, rounding<S>(2));     // the box's edge
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(to_double(m.points[i].separation), 0, rounding<S>(2));
    EXPECT_NEAR(to_double(m.points[i].position.z), 0.25, rounding<S>(2));
  }
}
TYPED_TEST(NarrowPhase, CapsuleThatTipsOverABoxesEdgeByOneDegreeKeepsTwoPoints) {
  using S = TypeParam;
  for (double degrees : {-1.0, -0.1, 0.1, 1.0}) {
    const auto m = touch(box_of<S>(1, 0.5, 1), at<S>({0, 0, 0}), capsule_of<S>(0.25, 1),
                         at<S>({0.5, 0.75, 0}, {0, 0, 1}, kPi / 2 + degrees * kPi / 180), 0.05);
    EXPECT_EQ(m.count, 2) << degrees;
  }
}
TYPED_TEST(NarrowPhase, CapsuleAlongABoxesEdgeTouchesInTwoPoints) {
  using S = TypeParam;
  const double d = 0.7 / std::sqrt(2.0);  // 0.7 from the edge at 45 degrees
  const auto m = touch(box_of<S>(1, 1, 1), at<S>({0, 0, 0}), capsule_of<S>(0.75, 2), at<S>({1 + d, 0.5, 1 + d}));
  ASSERT_EQ(m.count, 2);
  EXPECT_VECTOR(m.normal, (Point{std::sqrt(0.5), 0, std::sqrt(0.5)}), rounding<S>(2));
  double low = 9, high = -9;
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(to_double(m.points[i].separation), -0.05, rounding<S>(2));
    low = std::min(low, to_double(m.points[i].position.y));
    high = std::max(high, to_double(m.points[i].position.y));
  }
  EXPECT_NEAR(low, -1, rounding<S>(2));
  EXPECT_NEAR(high, 1, rounding<S>(2));
}
TYPED_TEST(NarrowPhase, CapsuleStandingOnABoxTouchesInOnePoint) {
  using S = TypeParam;
  const auto m = touch(box_of<S>(1, 1, 1), at<S>({0, 0, 0}), capsule_of<S>(0.25, 1), at<S>({0.5, 2.25, 0.25}));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), 0.0);
  EXPECT_EQ(to_double(m.points[0].separation), 0.0);
  EXPECT_VECTOR(m.points[0].position, (Point{0.5, 1, 0.25}), 0.0);
}
TYPED_TEST(NarrowPhase, CapsuleInsideABoxLeavesByTheFaceOfLeastDepth) {
  using S = TypeParam;
  const auto m = touch(box_of<S>(1, 2, 2), at<S>({0, 0, 0}), capsule_of<S>(0.25, 0.5), at<S>({-0.5, 0.25, 0}));
  ASSERT_EQ(m.count, 2);
  EXPECT_VECTOR(m.normal, (Point{-1, 0, 0}), 0.0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(to_double(m.points[i].separation), -0.75);
}
TYPED_TEST(NarrowPhase, CapsuleThatPiercesABoxesEdgeLeavesAcrossTheEdge) {
  using S = TypeParam;
  // The core crosses the edge x = y = 1 at right angles, along (1, -1, 0), 0.1 below it.
  const double c = 1 - 0.1 / std::sqrt(2.0);
  const auto m =
      touch(box_of<S>(1, 1, 1), at<S>({0, 0, 0}), capsule_of<S>(0.25, 3), at<S>({c, c, 0.5}, {0, 0, 1}, kPi / 4));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{std::sqrt(0.5), std::sqrt(0.5), 0}), rounding<S>(2));
  EXPECT_NEAR(to_double(m.points[0].separation), -0.35, rounding<S>(2));
  EXPECT_NEAR(to_double(m.points[0].position.z), 0.5, rounding<S>(2));
}

// ---- boxes

TYPED_TEST(NarrowPhase, BoxesThatTouchExactlyHaveFourPointsAtTheCornersOfTheOverlap) {
  using S = TypeParam;
  const auto m = touch(box_of<S>(0.5, 0.5, 0.5), at<S>({0, 0, 0}), box_of<S>(0.5, 0.5, 0.5), at<S>({0.25, 1, -0.125}));
  ASSERT_EQ(m.count, 4);
  EXPECT_TRUE((m.normal == Vec3<Unit<S>>{0, 1, 0}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(to_double(m.points[i].separation), 0.0);
  EXPECT_EQ(sorted_points(m),
            (std::vector<Point>{{-0.25, 0.5, -0.5}, {-0.25, 0.5, 0.375}, {0.5, 0.5, -0.5}, {0.5, 0.5, 0.375}}));
}
TYPED_TEST(NarrowPhase, EveryFaceOfABoxCarriesAnother) {
  using S = TypeParam;
  for (std::size_t k = 0; k < 3; ++k) {
    for (double sign : {-1.0, 1.0}) {
      Point p = {0, 0, 0}, n = {0, 0, 0};
      p[k] = sign * 0.96875;
      n[k] = sign;
      const auto m = touch(box_of<S>(0.5, 0.5, 0.5), at<S>({0, 0, 0}), box_of<S>(0.25, 0.5, 0.5),
                           at<S>(p, {0, 0, 1}, k == 0 ? kPi / 2 : 0));
      ASSERT_EQ(m.count, 4);
      EXPECT_VECTOR(m.normal, n, rounding<S>(1));
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(to_double(m.points[i].separation), -0.03125, rounding<S>(1));
    }
  }
}
TYPED_TEST(NarrowPhase, SmallBoxOnAHugeSlabTouchesWithItsFourCorners) {
  using S = TypeParam;
  const auto m =
      touch(box_of<S>(50, 1, 50), at<S>({0, 0, 0}), box_of<S>(0.025, 0.025, 0.025), at<S>({37.5, 1.025, -41.25}));
  ASSERT_EQ(m.count, 4);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), 0.0);
  const auto corners = sorted_points(m);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(to_double(m.points[i].separation), 0, rounding<S>(1));
  EXPECT_NEAR(corners[0][0], 37.475, rounding<S>(40));
  EXPECT_NEAR(corners[3][2], -41.225, rounding<S>(40));
  const auto mirrored =
      touch(box_of<S>(0.025, 0.025, 0.025), at<S>({0, 0, 0}), box_of<S>(50, 1, 50), at<S>({37.5, -1.025, -41.25}));
  ASSERT_EQ(mirrored.count, 4);
  EXPECT_VECTOR(mirrored.normal, (Point{0, -1, 0}), 0.0);
}
TYPED_TEST(NarrowPhase, SquareTurnedBy45DegreesOnASquareKeepsFourOfTheOctagonsCornersAndMostOfItsArea) {
  using S = TypeParam;
  const auto m = touch(box_of<S>(0.5, 0.5, 0.5), at<S>({0, 0, 0}), box_of<S>(0.5, 0.5, 0.5),
                       at<S>({0, 0.99, 0}, {0, 1, 0}, kPi / 4));
  ASSERT_EQ(m.count, 4);
  const double reach = 0.5 * (std::sqrt(2.0) - 1);  // the octagon's corners are (1/2, +-reach) and their turns
  std::vector<Point> p;
  for (int i = 0; i < 4; ++i) {
    p.push_back(point_of(m.points[i].position));
    EXPECT_NEAR(to_double(m.points[i].separation), -0.01, rounding<S>(1));
    const double x = std::abs(p.back()[0]), z = std::abs(p.back()[2]);
    EXPECT_NEAR(std::max(x, z), 0.5, rounding<S>(1));
    EXPECT_NEAR(std::min(x, z), reach, rounding<S>(1));
  }
  const double area = length3(cross3(p[2] - p[0], p[3] - p[1])) / 2;
  EXPECT_GT(area,
            0.6 * 8 * 0.25 * (std::sqrt(2.0) - 1));  // octagon: 8 r^2 tan(pi/8); its inscribed square: 0.707 of it
}
TYPED_TEST(NarrowPhase, CrossedEdgesTouchInOnePoint) {
  using S = TypeParam;
  // Two square beams, one along x and one along z, each standing on its edge: edges cross at right angles.
  const double r = 0.5 * std::sqrt(2.0);
  const auto m = touch(box_of<S>(2, 0.5, 0.5), at<S>({0, 0, 0}, {1, 0, 0}, kPi / 4), box_of<S>(0.5, 0.5, 2),
                       at<S>({0.75, 2 * r - 0.05, -0.5}, {0, 0, 1}, kPi / 4));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), rounding<S>(2));
  EXPECT_NEAR(to_double(m.points[0].separation), -0.05, rounding<S>(2));
  EXPECT_VECTOR(m.points[0].position, (Point{0.75, r - 0.025, 0}), rounding<S>(2));
}
TYPED_TEST(NarrowPhase, CornerOfABoxOnAFaceTouchesInOnePoint) {
  using S = TypeParam;
  const auto m =
      touch(box_of<S>(2, 0.5, 2), at<S>({0, 0, 0}), box_of<S>(0.5, 0.5, 0.5),
            at<S>({0.25, 0.5 + 0.5 * std::sqrt(3.0) - 0.01, 0.5}, {1, 0, -1}, std::acos(1 / std::sqrt(3.0))));
  ASSERT_EQ(m.count, 1);
  EXPECT_VECTOR(m.normal, (Point{0, 1, 0}), 0.0);
  EXPECT_NEAR(to_double(m.points[0].separation), -0.01, rounding<S>(1));
  EXPECT_VECTOR(m.points[0].position, (Point{0.25, 0.495, 0.5}), rounding<S>(1));
}
TYPED_TEST(NarrowPhase, BoxesFurtherApartThanTheMarginDoNotTouch) {
  using S = TypeParam;
  const auto crate = box_of<S>(0.5, 0.5, 0.5);
  for (std::size_t k = 0; k < 3; ++k) {
    Point p = {0.25, 0.25, 0.25};
    p[k] = 1.015625;
    EXPECT_EQ(touch(crate, at<S>({0, 0, 0}), crate, at<S>(p)).count, 4);
    p[k] = 1.03125;
    EXPECT_EQ(touch(crate, at<S>({0, 0, 0}), crate, at<S>(p)).count, 0);
  }
}
TYPED_TEST(NarrowPhase, RoundedBoxesTouchTheirRadiiEarlier) {
  using S = TypeParam;
  auto a = box_of<S>(0.5, 0.5, 0.5), b = a;
  a.radius = S(0.125);
  b.radius = S(0.0625);
  const auto m = touch(a, at<S>({0, 0, 0}), b, at<S>({0, 1.25, 0}));
  ASSERT_EQ(m.count, 0);
  const auto closer = touch(a, at<S>({0, 0, 0}), b, at<S>({0, 1.125, 0}));
  ASSERT_EQ(closer.count, 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(to_double(closer.points[i].separation), -0.0625);
    EXPECT_EQ(to_double(closer.points[i].position.y), 0.59375);  // between 0.625 and 0.5625
  }
}
TYPED_TEST(NarrowPhase, StackThatRocksSlightlyKeepsItsReferenceFaceAndItsFeatures) {
  using S = TypeParam;
  const auto crate = box_of<S>(0.5, 0.5, 0.5);
  std::set<std::uint32_t> features;
  for (int n = 0; n < 64; ++n) {
    const double phase = n * 0.7, angle = 0.0015;
    const auto m = touch(crate, at<S>({0, 0, 0}, {isostep::cos(phase), 0, isostep::sin(phase)}, angle), crate,
                         at<S>({0.125, 0.999, 0.0625}, {isostep::sin(phase), 0, isostep::cos(phase)}, angle));
    ASSERT_EQ(m.count, 4);
    for (int i = 0; i < 4; ++i) features.insert(m.points[i].feature);
  }
  EXPECT_EQ(features.size(), 4u);
}
TYPED_TEST(NarrowPhase, BoxRestingExactlyEdgeToEdgeTouchesWithoutDoubledPoints) {
  using S = TypeParam;
  const auto crate = box_of<S>(0.5, 0.5, 0.5);
  const auto m = touch(crate, at<S>({0, 0, 0}), crate, at<S>({1, 1, 0}));
  EXPECT_EQ(m.count, 2);
  for (int i = 0; i < m.count; ++i) EXPECT_EQ(to_double(m.points[i].separation), 0.0);
}

}  // namespace narrowphase_test
}  // namespace isostep::test
