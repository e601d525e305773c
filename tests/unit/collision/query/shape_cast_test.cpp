// Shape casts against the distance of the two in double, which is a convex function of the fraction.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/shape_cast.hpp"

#include <gtest/gtest.h>

#include "unit/collision/query/cores.hpp"

namespace isostep::test {
namespace {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class ShapeCast : public testing::Test {
 protected:
  using U = Unit<S>;
  Transform<S> transform(D3 at) { return {oracle::made<S>(at), to_matrix(random_.template orientation<S>())}; }
  /// [m] of what is computed of cores of this size, this far apart.
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
    const D3 aim = from * apart + this->random_.direction() * ((a.size + b.size) * this->random_.in(0, 1));
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
    ASSERT_LT(std::fabs(flight.along(-normal, t) - most), 4 * error + 1e-3 * reach) << n;
  }
  EXPECT_GT(hits, 1500);
  EXPECT_GT(misses, 1000);
  EXPECT_LE(early, 3) << latest;
}

}  // namespace
}  // namespace isostep::test
