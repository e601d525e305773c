// The ellipse of friction: what grains make of it, and the nearest force in it, against dense searches.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/friction_ellipse.hpp"

#include "isostep/dynamics/solvers/island_number.hpp"
#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace friction_ellipse_test {

template <class S> class FrictionEllipses : public ::testing::Test {};
TYPED_TEST_SUITE(FrictionEllipses, AllScalars);

template <class S> Vec3<Unit<S>> unit(D3 v) {
  v = v * (1 / length(v));
  return {num<Unit<S>>(v.x), num<Unit<S>>(v.y), num<Unit<S>>(v.z)};
}
template <class S> Grain<S> grain_of(D3 factors, D3 axis = {0, 1, 0}, double angle = 0) {
  return {vec<S>(factors), to_matrix(turn<S>(axis, angle))};
}
/// The radius of a grain's ellipsoid along d.
template <class S> double radius_along(const Grain<S>& grain, D3 d) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const D3 axis = {to_double(grain.frame.rows[0][i]), to_double(grain.frame.rows[1][i]),
                     to_double(grain.frame.rows[2][i])};
    const double part = dot(axis, d) / to_double(grain.factors[i]);
    sum += part * part;
  }
  return 1 / std::sqrt(sum);
}
template <class S> double radius_along(const FrictionEllipse<S>& ellipse, D3 n, D3 d) {
  const D3 axis = real(ellipse.axis), across = cross(n, axis);
  const double wide = to_double(ellipse.wide), x = dot(d, axis), y = dot(d, across) / to_double(ellipse.ratio);
  return ellipse.ratio < Unit<S>(1) ? wide / std::hypot(x, y) : wide;
}

TYPED_TEST(FrictionEllipses, one_grain_leaves_the_ellipse_in_which_its_ellipsoid_meets_the_plane) {
  using S = TypeParam;
  Dice dice(17);
  for (int i = 0; i < 200; ++i) {
    const auto factor = [&] { return std::exp2(-dice.in(0, 6)); };
    const double fx = factor(), fy = factor(), fz = factor(), angle = dice.in(-3, 3);
    const D3 about = dice.direction(), n = dice.direction();
    const Grain<S> grain = grain_of<S>({fx, fy, fz}, about, angle), plain = grain_of<S>({1, 1, 1});
    const FrictionEllipse<S> ellipse =
        dice.one_in(2) ? friction_ellipse(grain, plain, unit<S>(n)) : friction_ellipse(plain, grain, unit<S>(n));
    if (ellipse.ratio < Unit<S>(1)) {
      EXPECT_NEAR(length(real(ellipse.axis)), 1, pick<S>(1e-6, 1e-12, 1e-4, 1e-8));
      EXPECT_NEAR(dot(real(ellipse.axis), n), 0, pick<S>(1e-6, 1e-12, 1e-4, 1e-8));
    }
    const Tangents<double> basis = tangents_of(n);
    for (int k = 0; k < 16; ++k) {
      const D3 d = basis.t * std::cos(kPi / 16 * k) + basis.u * std::sin(kPi / 16 * k);
      const double law = radius_along(grain, d);
      EXPECT_NEAR(radius_along(ellipse, n, d), law, law * pick<S>(2e-3, 1e-9, 0.05, 1e-4)) << i << " " << k;
    }
  }
}

TYPED_TEST(FrictionEllipses, two_grains_leave_an_ellipse_that_neither_exceeds_and_that_touches_both) {
  using S = TypeParam;
  Dice dice(23);
  const double near = pick<S>(0.02, 5e-3, 0.05, 5e-3);
  constexpr double kSearch = 0.02;  // what the search itself may miss of a place where two touch
  for (int i = 0; i < 200; ++i) {
    const auto factor = [&] { return std::exp2(-dice.in(0, 6)); };
    const auto draw = [&] {
      const double fx = factor(), fy = factor(), fz = factor(), angle = dice.in(-3, 3);
      return grain_of<S>({fx, fy, fz}, dice.direction(), angle);
    };
    const Grain<S> a = draw(), b = dice.one_in(4) ? a : draw();
    const D3 n = dice.direction();
    const FrictionEllipse<S> ellipse = friction_ellipse(a, b, unit<S>(n));
    const FrictionEllipse<S> mirrored = friction_ellipse(b, a, -unit<S>(n));
    const Tangents<double> basis = tangents_of(n);
    double to_a = 1, to_b = 1;              // of the radius that is missing, the least
    bool within_a = true, within_b = true;  // one ellipse lies within the other
    for (int k = 0; k < 256; ++k) {
      const D3 d = basis.t * std::cos(kPi / 256 * k) + basis.u * std::sin(kPi / 256 * k);
      const double seen = radius_along(ellipse, n, d), of_a = radius_along(a, d), of_b = radius_along(b, d);
      EXPECT_LE(seen, std::min(of_a, of_b) * (1 + near)) << i << " " << k;
      EXPECT_NEAR(radius_along(mirrored, -n, d), seen, seen * near) << i << " " << k;
      to_a = std::min(to_a, 1 - seen / of_a);
      to_b = std::min(to_b, 1 - seen / of_b);
      within_a = within_a && of_b <= of_a;
      within_b = within_b && of_a <= of_b;
    }
    EXPECT_TRUE(within_a || to_a < near + kSearch) << i;
    EXPECT_TRUE(within_b || to_b < near + kSearch) << i;
  }
}

TYPED_TEST(FrictionEllipses, of_two_grains_with_the_same_axes_the_lesser_factor_counts_along_each) {
  using S = TypeParam;
  const Vec3<Unit<S>> n = unit<S>({0, 1, 0});
  const Grain<S> a = grain_of<S>({0.25, 1, 1}), b = grain_of<S>({1, 1, 0.5});
  const FrictionEllipse<S> both = friction_ellipse(a, b, n), same = friction_ellipse(a, a, n);
  const double near = pick<S>(1e-6, 1e-12, 1e-3, 1e-7);
  EXPECT_NEAR(to_double(both.wide), 0.5, near);
  EXPECT_NEAR(to_double(both.ratio), 0.5, near);
  EXPECT_NEAR(std::fabs(to_double(both.axis.z)), 1, near);
  EXPECT_NEAR(to_double(same.wide), 1, near);
  EXPECT_NEAR(to_double(same.ratio), 0.25, near);
  const Grain<S> even = grain_of<S>({0.5, 0.5, 0.5});
  EXPECT_NEAR(to_double(friction_ellipse(even, grain_of<S>({1, 1, 1}), n).wide), 0.5, near);
  EXPECT_NEAR(to_double(friction_ellipse(even, grain_of<S>({1, 1, 1}), n).ratio), 1, near);
  EXPECT_NEAR(to_double(spinning_factor(Unit<S>(0.5))), std::sqrt((1 + 0.25) / 2), near);
}

/// Returns the distance from a point to the nearest of an ellipse, by a search of its rim.
double nearest_by_search(double x, double y, double limit, double ratio) {
  const auto distance = [&](double angle) {
    return std::hypot(limit * std::cos(angle) - x, limit * ratio * std::sin(angle) - y);
  };
  double best = 0, step = 2 * kPi / 512;
  for (int k = 0; k < 512; ++k) {
    if (distance(step * k) < distance(best)) best = step * k;
  }
  for (; step > 1e-12; step /= 2) {
    for (const double to : {best - step, best + step}) {
      if (distance(to) < distance(best)) best = to;
    }
  }
  return distance(best);
}

template <class T> T number(double x) {
  if constexpr (std::is_same_v<T, Exact<double>>) return T(x);
  else return num<T>(x);
}

/// From a thousandth of the limit to a thousand times it, along the axes and near them, down to the narrowest ellipse.
template <class T, class U, class Hold> void expect_nearest(const Hold& hold, double scale, double near) {
  Dice dice(5);
  for (int i = 0; i < 5000; ++i) {
    const double ratio = to_double(number<U>(std::exp2(-dice.in(0, 6))));
    const double limit = dice.one_in(20) ? 0 : scale * std::exp2(-dice.in(0, 4));
    const double size = scale * std::exp2(dice.in(-10, 0)), angle = dice.in(-kPi, kPi);
    T x = number<T>(dice.one_in(9) ? 0 : size * std::cos(angle));
    T y = number<T>(dice.one_in(9) ? 0 : size * std::sin(angle) * (dice.one_in(2) ? ratio : 1));
    const double was_x = to_double(x), was_y = to_double(y), most = to_double(number<T>(limit));
    const bool outside = hold(number<U>(ratio), number<T>(limit), x, y);
    const double reach = std::hypot(was_x * ratio, was_y);
    if (std::fabs(reach - most * ratio) > near * ratio * scale) EXPECT_EQ(outside, most * ratio < reach) << i;
    if (!outside) {
      EXPECT_EQ(to_double(x), was_x);
      EXPECT_EQ(to_double(y), was_y);
      continue;
    }
    const double seen_x = to_double(x), seen_y = to_double(y);
    EXPECT_LE(std::hypot(seen_x * ratio, seen_y), most * ratio + near * ratio * scale) << i;
    EXPECT_LE(std::hypot(seen_x - was_x, seen_y - was_y), nearest_by_search(was_x, was_y, most, ratio) + near * scale)
        << i << " " << ratio << " " << most << " " << was_x << " " << was_y;
  }
}

TYPED_TEST(FrictionEllipses, what_is_outside_is_brought_to_the_nearest_point) {
  using S = TypeParam;
  using V = Velocity<S>;
  expect_nearest<V, Unit<S>>(
      [](Unit<S> ratio, V limit, V& x, V& y) { return hold_impulse_in_ellipse<S>(ratio, limit, x, y); }, 64,
      pick<S>(2e-6, 1e-8, 2e-5, 1e-8));
}

TEST(FrictionEllipseOfIslands, what_is_outside_is_brought_to_the_nearest_point) {
  using F = Fixed<std::int64_t, 62>;
  using E = Exact<double>;
  expect_nearest<F, F>(
      [](F ratio, F limit, F& x, F& y) { return hold_in_ellipse<IslandNumber<F>>(ratio, limit, x, y); }, 1.0 / 16,
      1e-8);
  expect_nearest<E, E>(
      [](E ratio, E limit, E& x, E& y) { return hold_in_ellipse<IslandNumber<E>>(ratio, limit, x, y); }, 1000, 1e-8);
}

}  // namespace friction_ellipse_test
}  // namespace isostep::test
