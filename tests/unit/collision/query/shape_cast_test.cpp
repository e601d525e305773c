// Shape casts against the distance of the two in double, which is a convex function of the fraction.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/shape_cast.hpp"

#include <gtest/gtest.h>

#include <array>

#include "unit/collision/query/cores.hpp"

namespace isostep::test {
namespace shape_cast_test {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class ShapeCast : public testing::Test {
 protected:
  using U = Unit<S>;
  Transform<S> transform(D3 at) { return {oracle::made<S>(at), to_matrix(random_.template orientation<S>())}; }
  /// [m] The rounding of what is computed of cores of this size, this far apart.
  static double rounding(double reach) {
    using F = Finer<S>;
    const double fine = 24 * to_double(resolution<F>()) + reach * to_double(resolution<Unit<F>>()) * 16;
    return fine + 8 * to_double(resolution<S>()) * (kIsFixed<S> ? 1 : reach);
  }

  oracle::Random random_{1};
};
TYPED_TEST_SUITE(ShapeCast, Scalars);

/// A cast in double.
template <class S> class Flight {
 public:
  Flight(const TestCore<S>& a, const Transform<S>& ta, const TestCore<S>& b, const Transform<S>& tb, Vec3<S> way)
      : a_(a.real_core()), b_(b.real_core()), ta_(oracle::real(ta)), tb_(oracle::real(tb)), way_(oracle::real(way)) {
    tb_.position = tb_.position - ta_.position;  // exact where both are far away
    ta_.position = {0, 0, 0};
  }
  Gap at(double t) const { return gap_of(a_, moved(t), b_, tb_); }
  double along(D3 n, double t) const { return separation_along(n, a_, moved(t), b_, tb_); }
  /// The fraction up to `end` at which they are nearest.
  double nearest(double end) const {
    double low = 0, high = end;
    for (int i = 0; i < 80; ++i) {
      const double p = low + (high - low) / 3, q = high - (high - low) / 3;
      (at(p).most <= at(q).most ? high : low) = at(p).most <= at(q).most ? q : p;
    }
    return (low + high) / 2;
  }
  /// [m] A bound of how deep they ever overlap up to `end`: by the planes where they begin and cease to.
  double depth(double end) const {
    const double middle = nearest(end);
    const Gap least = at(middle);
    if (least.normal != D3{0, 0, 0}) return -least.least;
    double low = 0, high = middle;
    for (int i = 0; i < 60; ++i) (at((low + high) / 2).normal == D3{0, 0, 0} ? high : low) = (low + high) / 2;
    const double before = -along(at(low).normal, middle);
    low = middle, high = end;
    for (int i = 0; i < 60; ++i) (at((low + high) / 2).normal == D3{0, 0, 0} ? low : high) = (low + high) / 2;
    return std::min(before, -along(at(high).normal, middle));
  }
  double length() const { return oracle::length(way_); }

 private:
  Transform<double> moved(double t) const { return {way_ * t, ta_.rotation}; }
  ConvexCore<double> a_, b_;
  Transform<double> ta_, tb_;
  D3 way_;
};

TYPED_TEST(ShapeCast, meets_the_first_touch_of_every_two_kinds) {
  using S = TypeParam;
  int hits = 0, misses = 0, early = 0;
  double latest = 0;
  for (int n = 0; n < 5000; ++n) {
    const double scale = n % 7 == 0 ? 0.03 : n % 7 == 1 ? 12 : 0.5;
    const TestCore<S> a = random_core<S>(static_cast<CoreKind>(n % 5), scale, this->random_);
    const TestCore<S> b = random_core<S>(static_cast<CoreKind>(n / 5 % 5), scale, this->random_);
    const D3 at = n % 3 == 0 ? D3{240, -130, 220} : D3{0, 0, 0}, from = this->random_.direction();
    const double apart = (a.size + b.size) * this->random_.in(1.1, 6);
    const Transform<S> ta = this->transform(at), tb = this->transform(at + from * apart);
    const D3 aim = from * apart + this->random_.arrow_of((a.size + b.size) * this->random_.in(0, 1));
    const Vec3<S> way = oracle::made<S>(aim * this->random_.in(0.5, 3));
    CastHit<S> hit = {};
    const bool found = cast_convex(a.core(), ta, b.core(), tb, {way, Unit<S>(1), S(0)}, hit);
    const Flight<S> flight(a, ta, b, tb, way);
    const double reach = a.size + b.size + apart + flight.length();
    const double error = this->rounding(reach) + flight.length() * 2 * to_double(resolution<Unit<S>>());
    if (!found) {
      ++misses;
      ASSERT_LT(flight.depth(1), error) << n;
      continue;
    }
    ++hits;
    ASSERT_FALSE(hit.inside);
    const double t = to_double(hit.fraction);
    const D3 normal = oracle::real(hit.normal);
    const double most = flight.at(t).most;
    latest = std::max(latest, flight.depth(t) / error);
    ASSERT_LT(flight.depth(t), error) << n << ": through";
    if (most > 4 * error) ++early;
    // A direction is worth as much as the gap that it was measured on: the one before the last step's.
    ASSERT_NEAR(oracle::length(normal), 1, 1e-15 + 8 * to_double(resolution<Unit<S>>()));
    ASSERT_LT(dot(normal, oracle::real(way)), 0);
    ASSERT_LT(std::fabs(flight.along(-normal, t) - most), 4 * error + 4e-3 * reach) << n;
  }
  EXPECT_GT(hits, 1500);
  EXPECT_GT(misses, 1000);
  EXPECT_LE(early, 3) << latest;
}

/// The less they close in, the longer is what is near on their way.
TYPED_TEST(ShapeCast, a_latest_fraction_hides_no_hit_up_to_it_and_changes_none) {
  using S = TypeParam;
  int hits = 0;
  for (int n = 0; n < 8000; ++n) {
    const TestCore<S> a = random_core<S>(static_cast<CoreKind>(n % 5), 0.5, this->random_);
    const TestCore<S> b = random_core<S>(static_cast<CoreKind>(n / 5 % 5), 0.5, this->random_);
    const D3 from = this->random_.direction();
    const double apart = (a.size + b.size) * this->random_.in(0.3, 1.2), length = this->random_.in(0.5, 4);
    const D3 aside = cross(from, this->random_.direction());
    const D3 aim = from * this->random_.in(0, n % 2 == 0 ? 1 : 0.02) + aside;
    const Transform<S> ta = this->transform({0, 0, 0}), tb = this->transform(from * apart);
    CastMotion<S> motion = {oracle::made<S>(aim * length), Unit<S>(1), S(0)};
    CastHit<S> whole = {};
    if (!cast_convex(a.core(), ta, b.core(), tb, motion, whole)) continue;
    ++hits;
    for (const double after : {0.0, 1e-7, 1e-4}) {
      motion.latest = min(whole.fraction + from_double<Unit<S>>(after), Unit<S>(1));
      CastHit<S> hit = {};
      ASSERT_TRUE(cast_convex(a.core(), ta, b.core(), tb, motion, hit)) << n << " " << after;
      EXPECT_EQ(hit.fraction, whole.fraction) << n;
      EXPECT_EQ(hit.normal, whole.normal) << n;
      EXPECT_EQ(hit.point, whole.point) << n;
    }
  }
  EXPECT_GT(hits, 1500);
}

TYPED_TEST(ShapeCast, spheres_meet_where_the_quadratic_says) {
  using S = TypeParam;
  int hits = 0, grazing = 0;
  for (int n = 0; n < 4000; ++n) {
    const double scale = n % 3 == 0 ? 0.02 : n % 3 == 1 ? 0.5 : 20;
    const TestCore<S> a = random_core<S>(CoreKind::point, scale, this->random_);
    const TestCore<S> b = random_core<S>(CoreKind::point, scale, this->random_);
    const double radii = a.size + b.size;
    const D3 at = n % 2 == 0 ? D3{240, -130, 220} : D3{0, 0, 0}, from = this->random_.direction();
    const double apart = radii * this->random_.in(1.2, 5);
    const Transform<S> ta = this->transform(at), tb = this->transform(at + from * apart);
    // Every fourth passes at about the radii's distance.
    const D3 side = oracle::unit(cross(from, this->random_.direction()));
    const D3 aim = n % 4 == 0 ? from * apart + side * (radii / std::sqrt(1 - radii * radii / (apart * apart)))
                              : from * apart + side * (radii * this->random_.in(0, 2));
    const Vec3<S> way = oracle::made<S>(aim * this->random_.in(1, 2));
    CastHit<S> hit = {};
    const bool found = cast_convex(a.core(), ta, b.core(), tb, {way, Unit<S>(1), S(0)}, hit);
    const D3 v = oracle::real(way), p = oracle::real(tb.position) - oracle::real(ta.position);
    const double r = to_double(a.radius) + to_double(b.radius), error = this->rounding(10 * r);
    const double closest = oracle::length(p - v * (dot(p, v) / dot(v, v)));
    if (closest > r + 4 * error || closest < r - error) {
      ASSERT_EQ(found, closest < r) << n;
    } else {
      ++grazing;
    }
    if (!found) continue;
    ++hits;
    const double t = to_double(hit.fraction), gap = oracle::length(p - v * t) - r;
    ASSERT_GT(gap, -error - oracle::length(v) * 1e-6 * (kIsFixed<S> ? 0 : 1)) << n;
    ASSERT_LT(gap, 4 * error + oracle::length(v) * 2 * to_double(resolution<Unit<S>>())) << n;
    const D3 out = oracle::unit(v * t - p), normal = oracle::real(hit.normal);
    ASSERT_LT(oracle::length(normal - out), std::sqrt(8 * error / r)) << n;
    const D3 on_b = oracle::real(hit.point) - oracle::real(ta.position) - p;
    ASSERT_LT(oracle::length(on_b - normal * to_double(b.radius)), 4 * this->rounding(10 * r + 300)) << n;
  }
  EXPECT_GT(hits, 1500);
  EXPECT_GT(grazing, 1);
}

/// Two cores where one cast ended at the other.
template <class S> struct Met {
  TestCore<S> a, b;
  Transform<S> ta, tb;
  D3 normal;  // [1] from b to a
};
template <class S> bool meet(int n, double scale, oracle::Random& random, Met<S>& met) {
  met.a = random_core<S>(static_cast<CoreKind>(n % 5), scale, random);
  met.b = random_core<S>(static_cast<CoreKind>(n / 5 % 5), scale, random);
  const D3 from = random.direction() * ((met.a.size + met.b.size) * 1.2);
  const auto placed = [&](D3 at) {
    return Transform<S>{oracle::made<S>(at), to_matrix(random.template orientation<S>())};
  };
  met.ta = placed({1, 2, 3});
  met.tb = placed(D3{1, 2, 3} + from);
  CastHit<S> hit = {};
  if (!cast_convex(met.a.core(), met.ta, met.b.core(), met.tb, {oracle::made<S>(from), Unit<S>(1), S(0)}, hit))
    return false;
  met.normal = oracle::real(hit.normal);
  met.ta.position += oracle::made<S>(from * to_double(hit.fraction));
  return true;
}

TYPED_TEST(ShapeCast, what_touches_at_the_start_misses_away_and_along_and_hits_inwards) {
  using S = TypeParam;
  int met = 0, along = 0;
  for (int n = 0; n < 3000; ++n) {
    Met<S> pair;
    const double scale = n % 2 == 0 ? 0.5 : 4, touch = 0.004 * scale;
    if (!meet<S>(n, scale, this->random_, pair)) continue;
    ++met;
    const D3 n0 = pair.normal, side = oracle::unit(cross(n0, this->random_.direction()));
    // A little apart, exactly there, or a little inside.
    const double gap = touch * std::array<double, 4>{0, 0.3, -0.3, 1e-5}[static_cast<std::size_t>(n % 4)];
    pair.ta.position += oracle::made<S>(n0 * gap);
    const auto cast = [&](D3 way, CastHit<S>& hit) {
      return cast_convex(pair.a.core(), pair.ta, pair.b.core(), pair.tb,
                         {oracle::made<S>(way * scale), Unit<S>(1), from_double<S>(touch)}, hit);
    };
    CastHit<S> hit = {};
    ASSERT_FALSE(cast(n0, hit)) << n;
    // Where corners meet, one plane that parts them is as good as another, and the other may lean against the way.
    along += cast(side + n0 * 0.05, hit) ? 1 : 0;
    ASSERT_FALSE(cast({0, 0, 0}, hit)) << n << ": no way at all";
    // Within a few digits of the touch, a normal at corners is any between those of the faces.
    const D3 in = oracle::unit(side * 0.2 - n0);
    ASSERT_TRUE(cast(in, hit)) << n;
    ASSERT_FALSE(hit.inside) << n;
    ASSERT_LT(to_double(hit.fraction) * scale, 2 * touch + 2e-5) << n;
    ASSERT_LT(dot(oracle::real(hit.normal), in), 0) << n;
  }
  EXPECT_GT(met, 500);
  EXPECT_LT(along, met / 200);
}

TYPED_TEST(ShapeCast, what_begins_inside_hits_at_nothing_and_says_the_way_out) {
  using S = TypeParam;
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    Met<S> pair;
    if (!meet<S>(n, 0.5, this->random_, pair)) continue;
    const double depth = 0.02;
    pair.ta.position -= oracle::made<S>(pair.normal * depth);
    const D3 way = n % 3 == 0 ? D3{0, 0, 0} : this->random_.point(1);
    CastHit<S> hit = {};
    const bool found = cast_convex(pair.a.core(), pair.ta, pair.b.core(), pair.tb,
                                   {oracle::made<S>(way), Unit<S>(1), from_double<S>(1e-4)}, hit);
    const ConvexCore<double> a = pair.a.real_core(), b = pair.b.real_core();
    const Transform<double> ta = oracle::real(pair.ta), tb = oracle::real(pair.tb);
    if (gap_of(a, ta, b, tb).least > -0.001) continue;  // thinner than that, or beside each other
    ++met;
    ASSERT_TRUE(found && hit.inside && hit.fraction == Unit<S>(0)) << n;
    const D3 out = oracle::real(hit.normal);
    ASSERT_NEAR(oracle::length(out), 1, 1e-6);
    const double parted = separation_along(-out, a, {ta.position + out * (depth + 1e-3), ta.rotation}, b, tb);
    ASSERT_GT(parted, 0) << n;
  }
  EXPECT_GT(met, 300);
}

TYPED_TEST(ShapeCast, looks_no_further_than_it_is_told) {
  using S = TypeParam;
  const TestCore<S> a = box_core<S>({0.5, 0.5, 0.5}), b = box_core<S>({0.25, 2, 2});
  const Transform<S> ta = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
  const Transform<S> tb = {{S(4), S(0), S(0)}, Mat3<Unit<S>>::identity()};
  const Vec3<S> way = {S(8), S(0), S(0)};
  CastHit<S> hit = {};
  EXPECT_FALSE(cast_convex(a.core(), ta, b.core(), tb, {way, Unit<S>(0.375), S(0)}, hit));
  ASSERT_TRUE(cast_convex(a.core(), ta, b.core(), tb, {way, Unit<S>(0.5), S(0)}, hit));
  EXPECT_NEAR(to_double(hit.fraction), 3.25 / 8, 1e-5);
  EXPECT_LE(to_double(hit.fraction), 3.25 / 8);
  EXPECT_NEAR(to_double(hit.normal.x), -1, 1e-6);
  EXPECT_NEAR(to_double(hit.point.x), 3.75, 1e-4);
}

}  // namespace shape_cast_test
}  // namespace isostep::test
