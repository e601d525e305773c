// Ray casts and closest points against closed forms and against distance fields in double.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../geometry/oracle.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/overlap_shape.hpp"
#include "isostep/collision/query/ray_cast.hpp"

namespace isostep {
namespace query_test {

using oracle::D3;

/// Reach of the rays [m], a coordinate's raw unit or ulp [m] at that reach, and half a step of a fraction.
constexpr double kSmallest = 0.05;  // [m]
template <class S> struct Accuracy;
template <> struct Accuracy<float> { static constexpr double reach = 1000, coordinate = 6e-5, fraction = 6e-8; };
template <> struct Accuracy<double> { static constexpr double reach = 1000, coordinate = 1.2e-13, fraction = 1e-15; };
template <> struct Accuracy<Q16_16> { static constexpr double reach = 100, coordinate = 0x1p-16, fraction = 0x1p-17; };
template <> struct Accuracy<Q32_32> { static constexpr double reach = 1000, coordinate = 0x1p-32, fraction = 0x1p-33; };

template <class S> Transform<S> any_transform(oracle::Random& random, double reach) {
  const Vec3<S> position = oracle::made<S>(random.point(reach));
  return {position, to_matrix(random.orientation<S>())};
}
template <class S> Primitive<S> any_half_space(oracle::Random& random) {
  const D3 n = random.direction();
  const auto u = direction_of(from_double<S>(n.x), from_double<S>(n.y), from_double<S>(n.z));
  return primitive_of(HalfSpace<S>{{u.x, u.y, u.z}, from_double<S>(random.in(-2, 2))});
}

/// A march by the distance field: the way along a ray to the surface, or the least distance on a ray that misses.
struct March {
  bool hit;
  double way;
  double clearance;
};
March march(const Primitive<double>& p, D3 origin, D3 direction, double length) {
  March m = {false, 0, 1e300};
  while (m.way <= length) {
    const double d = oracle::signed_distance(p, origin + direction * m.way);
    m.clearance = std::fmin(m.clearance, d);
    if (d < 1e-13) return {true, m.way, 0};
    m.way += d;
  }
  return m;
}

template <class S> class QueryTest : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(QueryTest, Scalars);

template <class S> struct Cast {
  bool hit;
  RayHit<S> at;
};
template <class S>
Cast<S> cast(const Primitive<S>& p, Vec3<S> origin, Vec3<S> translation, S most = S(1),
             Transform<S> t = Transform<S>::of(Pose<S>::identity())) {
  Cast<S> result = {false, {S(-1), Vec3<Unit<S>>::zero()}};
  result.hit = ray_cast(p, t, origin, translation, most, result.at);
  return result;
}

TYPED_TEST(QueryTest, LongRaysAgreeWithMarching) {
  using S = TypeParam;
  using A = Accuracy<S>;
  oracle::Random random(1);
  int hits = 0, misses = 0;
  for (int n = 0; n < 4000; ++n) {
    const bool plane = n % 6 == 5;
    const Primitive<S> p = plane ? any_half_space<S>(random) : random.primitive<S>(n % 6, kSmallest, 5);
    const Transform<S> t = any_transform<S>(random, 20);
    const double size = to_double(max_abs(p.half) + p.radius);
    const D3 away = random.arrow_of(A::reach * random.in(0.05, 0.5));
    const D3 aim = random.arrow_of(size * random.in(0, 1.5));
    const Vec3<S> origin = t.position + oracle::made<S>(away);
    const Vec3<S> translation = oracle::made<S>((aim - away) * random.in(0.9, 1.9));
    const Transform<double> frame = oracle::real(t);
    const Primitive<double> shape = oracle::real(p);
    const D3 from = to_local(frame, oracle::real(origin));
    const D3 way = transposed_times(frame.rotation, oracle::real(translation));
    const double length = oracle::length(way);
    if (oracle::signed_distance(shape, from) < 0.01) continue;
    const March expected = march(shape, from, oracle::unit(way), length);
    const Cast<S> got = cast(p, origin, translation, S(1), t);
    SCOPED_TRACE(testing::Message() << "ray " << n << ", type " << static_cast<int>(p.type));
    if (!expected.hit) {
      const bool clear = expected.clearance > 10 * A::coordinate;
      if (!clear) continue;
      ASSERT_FALSE(got.hit);
      ++misses;
      continue;
    }
    // Grazing rays magnify every error: judge those that meet the surface at 6 degrees or more.
    const D3 touch = from + oracle::unit(way) * expected.way;
    const double dip = oracle::signed_distance(shape, touch + oracle::unit(way) * 1e-4) / 1e-4;
    const bool judged = dip < -0.1 && expected.way < length - 50 * A::coordinate;
    if (!judged) continue;
    ASSERT_TRUE(got.hit);
    const double slack = 4 * A::coordinate / -dip + A::fraction * length;
    EXPECT_NEAR(to_double(got.at.fraction) * length, expected.way, slack);
    const D3 normal = transposed_times(frame.rotation, oracle::real(got.at.normal));
    EXPECT_NEAR(oracle::length(normal), 1, 2e-6);
    EXPECT_LT(dot(normal, way), 0);
    // A step along the normal is a step away from the surface.
    EXPECT_NEAR(oracle::signed_distance(shape, touch + normal * 0.01), 0.01, 1e-12 + 40 * A::coordinate / -dip);
    ++hits;
  }
  EXPECT_GT(hits, 1200);
  EXPECT_GT(misses, 600);
}

TYPED_TEST(QueryTest, AHundredMetreRayIsRightToAMillimetre) {
  using S = TypeParam;
  const Primitive<S> shapes[] = {primitive_of(Sphere<S>{S(0.5)}), primitive_of(Box<S>{{S(0.5), S(0.5), S(0.5)}}),
                                 primitive_of(Capsule<S>{S(0.5), S(1)}),
                                 primitive_of(HalfSpace<S>{{Unit<S>(-1), Unit<S>(0), Unit<S>(0)}, S(0.5)})};
  for (const Primitive<S>& p : shapes) {
    const auto got = cast<S>(p, {S(-73), S(0), S(0)}, {S(100), S(0), S(0)});
    ASSERT_TRUE(got.hit);
    EXPECT_NEAR(to_double(got.at.fraction) * 100, 72.5, 1e-3);
    EXPECT_EQ(got.at.normal, (Vec3<Unit<S>>{Unit<S>(-1), Unit<S>(0), Unit<S>(0)}));
  }
}

TYPED_TEST(QueryTest, ClosedFormsOfASphere) {
  using S = TypeParam;
  // Line y = 3/5 past a unit sphere: enters at x = -4/5 with normal (-4/5, 3/5, 0).
  const auto got = cast<S>(primitive_of(Sphere<S>{S(1)}), {S(-4), S(0.6), S(0)}, {S(8), S(0), S(0)});
  ASSERT_TRUE(got.hit);
  const double slack = 8 * to_double(resolution<S>());
  EXPECT_NEAR(to_double(got.at.fraction), 0.4, slack);
  EXPECT_NEAR(to_double(got.at.normal.x), -0.8, 4 * slack);
  EXPECT_NEAR(to_double(got.at.normal.y), 0.6, 4 * slack);
}

TYPED_TEST(QueryTest, ACapsuleIsHitOnItsSideAndOnItsEnds) {
  using S = TypeParam;
  const Primitive<S> rod = primitive_of(Capsule<S>{S(0.5), S(1)});
  const auto side = cast<S>(rod, {S(4), S(0.75), S(0)}, {S(-8), S(0), S(0)});
  ASSERT_TRUE(side.hit);
  EXPECT_EQ(to_double(side.at.fraction), 3.5 / 8);
  const auto top = cast<S>(rod, {S(0), S(4), S(0)}, {S(0), S(-4), S(0)});
  ASSERT_TRUE(top.hit);
  EXPECT_EQ(to_double(top.at.fraction), 0.625);
  EXPECT_EQ(top.at.normal.y, Unit<S>(1));
  const auto bottom = cast<S>(rod, {S(0.3), S(-4), S(0)}, {S(0), S(4), S(0)});
  ASSERT_TRUE(bottom.hit);
  EXPECT_NEAR(to_double(bottom.at.fraction), (4 - 1.4) / 4, 8 * to_double(resolution<S>()));
  EXPECT_FALSE(cast<S>(rod, {S(0.51), S(4), S(0)}, {S(0), S(-8), S(0)}).hit);
}

TYPED_TEST(QueryTest, ARayInsideASlabButBesideTheBoxMisses) {
  using S = TypeParam;
  const Primitive<S> box = primitive_of(Box<S>{{S(1), S(1), S(1)}});
  EXPECT_FALSE(cast<S>(box, {S(-4), S(1.0625), S(0)}, {S(8), S(0), S(0)}).hit);
  EXPECT_TRUE(cast<S>(box, {S(-4), S(1), S(0)}, {S(8), S(0), S(0)}).hit) << "along the face itself";
  EXPECT_FALSE(cast<S>(box, {S(-4), S(0), S(0)}, {S(-8), S(0), S(0)}).hit) << "behind";
  EXPECT_FALSE(cast<S>(box, {S(-4), S(0), S(0)}, {S(2.9375), S(0), S(0)}).hit) << "too short";
}

TYPED_TEST(QueryTest, ADiagonalThroughACornerHitsTheLowestAxis) {
  using S = TypeParam;
  const auto got = cast<S>(primitive_of(Box<S>{{S(1), S(1), S(1)}}), {S(-3), S(-3), S(-3)}, {S(4), S(4), S(4)});
  ASSERT_TRUE(got.hit);
  EXPECT_NEAR(to_double(got.at.fraction), 0.5, 4 * to_double(resolution<S>()));
  EXPECT_EQ(got.at.normal, (Vec3<Unit<S>>{Unit<S>(-1), Unit<S>(0), Unit<S>(0)}));
}

TYPED_TEST(QueryTest, NothingBeyondMaxFractionIsHitAndTheAnswerStaysUntouched) {
  using S = TypeParam;
  const Primitive<S> ball = primitive_of(Sphere<S>{S(1)});
  EXPECT_TRUE(cast<S>(ball, {S(-4), S(0), S(0)}, {S(6), S(0), S(0)}, S(0.5)).hit);
  const auto got = cast<S>(ball, {S(-4), S(0), S(0)}, {S(6), S(0), S(0)}, S(0.4375));
  EXPECT_FALSE(got.hit);
  EXPECT_EQ(got.at.fraction, S(-1));
}

TYPED_TEST(QueryTest, ARayThatStartsInsideReportsItsStart) {
  using S = TypeParam;
  using U = Unit<S>;
  const Primitive<S> shapes[] = {primitive_of(Sphere<S>{S(1)}), primitive_of(Box<S>{{S(1), S(1), S(1)}}),
                                 primitive_of(Capsule<S>{S(1), S(1)}),
                                 primitive_of(HalfSpace<S>{{U(0), U(1), U(0)}, S(1)})};
  for (const Primitive<S>& p : shapes) {
    for (const S y : {S(0), S(0.5), S(1)}) {  // centre, inside, surface or inside
      const auto got = cast<S>(p, {S(0), y, S(0)}, {S(0), S(-2), S(0)});
      ASSERT_TRUE(got.hit);
      EXPECT_EQ(got.at.fraction, S(0));
      EXPECT_EQ(got.at.normal, (Vec3<U>{U(0), U(1), U(0)}));
    }
    const auto still = cast<S>(p, Vec3<S>::zero(), Vec3<S>::zero());
    ASSERT_TRUE(still.hit);
    EXPECT_EQ(still.at.normal, Vec3<U>::zero());
    EXPECT_FALSE(cast<S>(p, {S(0), S(3), S(0)}, Vec3<S>::zero()).hit);
  }
}

TYPED_TEST(QueryTest, AHalfSpaceIsMissedByRaysThatRiseOrRunLevel) {
  using S = TypeParam;
  using U = Unit<S>;
  const Primitive<S> floor = primitive_of(HalfSpace<S>{{U(0), U(1), U(0)}, S(0)});
  EXPECT_FALSE(cast<S>(floor, {S(0), S(1), S(0)}, {S(10), S(0), S(0)}).hit);
  EXPECT_FALSE(cast<S>(floor, {S(0), S(1), S(0)}, {S(10), S(1), S(0)}).hit);
  const auto got = cast<S>(floor, {S(0), S(1), S(0)}, {S(10), S(-4), S(0)});
  ASSERT_TRUE(got.hit);
  EXPECT_EQ(to_double(got.at.fraction), 0.25);
}

TYPED_TEST(QueryTest, ClosestPointsAgreeWithTheDistanceField) {
  using S = TypeParam;
  using A = Accuracy<S>;
  oracle::Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const bool plane = n % 6 == 5;
    const Primitive<S> p = plane ? any_half_space<S>(random) : random.primitive<S>(n % 6, kSmallest, 5);
    const Transform<S> t = any_transform<S>(random, 20);
    const double size = to_double(max_abs(p.half) + p.radius);
    const Vec3<S> query = t.position + oracle::made<S>(random.arrow_of((size + 1) * random.in(0, 2)));
    const ClosestPoint<S> got = closest_point(p, t, query);
    const Transform<double> frame = oracle::real(t);
    const Primitive<double> shape = oracle::real(p);
    const double slack = 4 * (kIsFixed<S> ? A::coordinate : 32 * to_double(resolution<S>()));
    SCOPED_TRACE(testing::Message() << "query " << n << ", type " << static_cast<int>(p.type));
    const D3 from = to_local(frame, oracle::real(query));
    EXPECT_NEAR(to_double(got.distance), oracle::signed_distance(shape, from), slack);
    EXPECT_NEAR(oracle::signed_distance(shape, to_local(frame, oracle::real(got.point))), 0, slack);
    const D3 back = oracle::real(got.point) + oracle::real(got.normal) * to_double(got.distance);
    EXPECT_NEAR(oracle::length(back - oracle::real(query)), 0, slack);
    const D3 outside = oracle::real(got.point) + oracle::real(got.normal);
    EXPECT_NEAR(oracle::signed_distance(shape, to_local(frame, outside)), 1, 1e-2) << "the normal points outwards";
  }
}

TYPED_TEST(QueryTest, NoSampledSurfacePointIsCloser) {
  using S = TypeParam;
  oracle::Random random(3);
  const Primitive<S> box = primitive_of(Box<S>{{S(0.5), S(1), S(1.5)}});
  const Transform<S> t = any_transform<S>(random, 5);
  for (int n = 0; n < 50; ++n) {
    const D3 local = random.point(2.5);
    const Vec3<S> query = oracle::made<S>(to_world(oracle::real(t), local));
    const double distance = std::fabs(to_double(closest_point(box, t, query).distance));
    for (int k = 0; k < 400; ++k) {
      D3 surface = {random.in(-0.5, 0.5), random.in(-1, 1), random.in(-1.5, 1.5)};
      const int face = k % 3;
      surface[face] = (k & 1 ? 1 : -1) * (0.5 + 0.5 * face);
      EXPECT_GE(oracle::length(surface - local), distance - 1e-4);
    }
  }
}

TYPED_TEST(QueryTest, CentresAnswerAlongADefiniteAxis) {
  using S = TypeParam;
  using U = Unit<S>;
  const Transform<S> here = Transform<S>::of(Pose<S>::identity());
  const Vec3<U> x = {U(1), U(0), U(0)};
  const auto ball = closest_point(primitive_of(Sphere<S>{S(2)}), here, Vec3<S>::zero());
  EXPECT_EQ(ball.normal, x);
  EXPECT_EQ(ball.distance, S(-2));
  EXPECT_EQ(ball.point, (Vec3<S>{S(2), S(0), S(0)}));
  const auto rod = closest_point(primitive_of(Capsule<S>{S(0.5), S(2)}), here, {S(0), S(1), S(0)});
  EXPECT_EQ(rod.normal, x);
  EXPECT_EQ(rod.distance, S(-0.5));
  EXPECT_EQ(rod.point, (Vec3<S>{S(0.5), S(1), S(0)}));
  const auto cube = closest_point(primitive_of(Box<S>{{S(1), S(1), S(1)}}), here, Vec3<S>::zero());
  EXPECT_EQ(cube.normal, x);
  EXPECT_EQ(cube.distance, S(-1));
  const auto low = closest_point(primitive_of(Box<S>{{S(1), S(1), S(1)}}), here, {S(0), S(0), S(-0.5)});
  EXPECT_EQ(low.normal, (Vec3<U>{U(0), U(0), U(-1)}));
  EXPECT_EQ(low.distance, S(-0.5));
}

TYPED_TEST(QueryTest, ABallOverlapsWhatItsCentreIsNearEnoughTo) {
  using S = TypeParam;
  oracle::Random random(4);
  int inside = 0, outside = 0;
  for (int n = 0; n < 1200; ++n) {
    const bool plane = n % 6 == 5;
    const Primitive<S> p = plane ? any_half_space<S>(random) : random.primitive<S>(n % 6, 0.1, 2);
    const Transform<S> t = any_transform<S>(random, 5);
    const Primitive<S> ball = primitive_of(Sphere<S>{S(0.5)});
    const Transform<S> there = {t.position + oracle::made<S>(random.point(3)), Mat3<Unit<S>>::identity()};
    const D3 centre = to_local(oracle::real(t), oracle::real(there.position));
    const double gap = oracle::signed_distance(oracle::real(p), centre) - 0.5;
    if (std::fabs(gap) < 1e-3) continue;
    EXPECT_EQ(overlaps(p, t, ball, there), gap < 0) << n << " gap " << gap;
    EXPECT_EQ(overlaps(ball, there, p, t), gap < 0) << n << " gap " << gap;
    ++(gap < 0 ? inside : outside);
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TYPED_TEST(QueryTest, TouchingIsOverlap) {
  using S = TypeParam;
  const Transform<S> here = Transform<S>::of(Pose<S>::identity());
  const auto beside = [&](S x) { return Transform<S>{{x, S(0), S(0)}, here.rotation}; };
  const Primitive<S> ball = primitive_of(Sphere<S>{S(1)});
  const Primitive<S> box = primitive_of(Box<S>{{S(1), S(1), S(1)}});
  for (const Primitive<S>& a : {ball, box}) {
    for (const Primitive<S>& b : {ball, box}) {
      EXPECT_TRUE(overlaps(a, here, b, beside(S(2))));
      EXPECT_FALSE(overlaps(a, here, b, beside(S(2.0625))));
    }
  }
}

}  // namespace query_test
}  // namespace isostep
