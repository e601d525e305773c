// Aabb against Eigen's AlignedBox over long double, and at the borders where touching counts.
// SPDX-License-Identifier: MIT
#include "isostep/math/aabb.hpp"

#include "oracle.hpp"

namespace isostep {
namespace aabb_test {

using namespace test;
using Box = Eigen::AlignedBox<Real, 3>;

template <class S> Box real(const Aabb<S>& a) { return {test::real(a.low), test::real(a.high)}; }
template <class S> Aabb<S> draw_box(Draw& draw) {
  const Vec3<S> a = draw.vector<S>(3), b = draw.vector<S>(3);
  return {min(a, b), max(a, b)};
}

template <class S> class AabbTest : public testing::Test {};
TYPED_TEST_SUITE(AabbTest, Scalars);

TYPED_TEST(AabbTest, RelationsAreThoseOfIntervals) {
  using S = TypeParam;
  Draw draw(41);
  int overlapping = 0, containing = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Aabb<S> a = draw_box<S>(draw);
    const Vec3<S> inside = min(max(draw.vector<S>(3), a.low), a.high);
    const Aabb<S> b = i % 3 == 0 ? Aabb<S>{inside, max(inside, min(draw.vector<S>(3), a.high))} : draw_box<S>(draw);
    EXPECT_EQ(overlap(a, b), real(a).intersects(real(b)));
    EXPECT_EQ(overlap(b, a), overlap(a, b));
    EXPECT_EQ(contains(a, b), real(a).contains(real(b)));
    overlapping += overlap(a, b) ? 1 : 0;
    containing += contains(a, b) ? 1 : 0;
  }
  EXPECT_GT(overlapping, kDraws / 10);
  EXPECT_LT(overlapping, kDraws);
  EXPECT_GT(containing, kDraws / 10);
  EXPECT_LT(containing, kDraws);
}

TYPED_TEST(AabbTest, MergedBoxesAreTheSmallestAroundBoth) {
  using S = TypeParam;
  Draw draw(42);
  for (int i = 0; i < kDraws; ++i) {
    const Aabb<S> a = draw_box<S>(draw), b = draw_box<S>(draw);
    const Box expected = real(a).merged(real(b));
    expect_near(test::real(merge(a, b).low), RealVec(expected.min()), 0);
    expect_near(test::real(merge(a, b).high), RealVec(expected.max()), 0);
    EXPECT_TRUE(contains(merge(a, b), a) && contains(merge(a, b), b));
    EXPECT_TRUE(merge(a, a) == a);
  }
}

TYPED_TEST(AabbTest, GrowsByAMarginOnEverySide) {
  using S = TypeParam;
  Draw draw(43);
  for (int i = 0; i < kDraws; ++i) {
    const Aabb<S> a = draw_box<S>(draw);
    const S margin = abs(draw.number<S>(0));
    const RealVec m = RealVec::Constant(test::real(margin));
    expect_near(test::real(grow(a, margin).low), RealVec(test::real(a.low) - m), bound<S>(0, 1, 16));
    expect_near(test::real(grow(a, margin).high), RealVec(test::real(a.high) + m), bound<S>(0, 1, 16));
  }
}

TYPED_TEST(AabbTest, HalfTheAreaIsTheSumOfThreeFaces) {
  using S = TypeParam;
  Draw draw(44);
  for (int i = 0; i < kDraws; ++i) {
    const Aabb<S> a = draw_box<S>(draw);
    const RealVec d = real(a).sizes();
    const Real expected = d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
    EXPECT_NEAR(double(test::real(round_to<S>(half_area(a))) - expected), 0, double(bound<S>(1, 6, 3 * 256)));
    EXPECT_FALSE(half_area(merge(a, draw_box<S>(draw))) < half_area(a)) << "a cost that shrank would mislead the tree";
  }
  const Aabb<S> flat = Aabb<S>::around(Vec3<S>::zero(), {S(2), S(0), S(3)});
  EXPECT_EQ(round_to<S>(half_area(flat)), S(24));
}

TYPED_TEST(AabbTest, TouchingCountsAsOverlapAndAsContained) {
  using S = TypeParam;
  const Aabb<S> unit = Aabb<S>::around(Vec3<S>::zero(), {S(1), S(1), S(1)});
  EXPECT_TRUE(contains(unit, unit));
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      Vec3<S> centre = Vec3<S>::zero();
      centre[axis] = S(2 * sign);
      EXPECT_TRUE(overlap(unit, Aabb<S>::around(centre, {S(1), S(1), S(1)})));
      centre[axis] = S(2 * sign) + S(sign) * S(0.001);
      EXPECT_FALSE(overlap(unit, Aabb<S>::around(centre, {S(1), S(1), S(1)})));
      EXPECT_FALSE(contains(unit, Aabb<S>::around(centre, {S(0), S(0), S(0)})));
    }
  }
}

}  // namespace aabb_test
}  // namespace isostep
