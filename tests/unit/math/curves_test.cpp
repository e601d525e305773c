// Angles, curves and polynomials against their formulas in long double, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/curves.hpp"

#include <vector>

#include "isostep/math/angles.hpp"
#include "oracle.hpp"

namespace isostep {
namespace curves_test {

using namespace test;

constexpr Real kPi = 3.14159265358979323846264338327950288L;

template <class S> class CurvesTest : public testing::Test {
 protected:
  /// A number in [0, 1].
  static Unit<S> part(Draw& draw) { return abs(draw.number<Unit<S>>(0)); }
};
TYPED_TEST_SUITE(CurvesTest, Scalars);

TYPED_TEST(CurvesTest, angles_wrap_to_half_a_turn_either_way) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(51);
  for (int i = 0; i < kDraws; ++i) {
    const S angle = draw.number<S>(i % 12), other = draw.number<S>(i % 12);
    const Real turns = std::remainder(real(angle), 2 * kPi);
    const Real tolerance = half_ulp<S>(4) * 2 + bound<Unit<S>>(16, 16, 1);
    const auto off = [](Real a, Real b) { return double(std::remainder(a - b, 2 * kPi)); };
    EXPECT_NEAR(off(real(wrap_angle(angle)), turns), 0, double(tolerance));
    EXPECT_LE(real(abs(wrap_angle(angle))), kPi + tolerance);
    const S way = angle_difference(angle, other);
    const Real size = std::abs(real(angle)) + std::abs(real(other)) + 4;
    EXPECT_NEAR(off(real(angle) + real(way), real(other)), 0, double(tolerance + half_ulp<S>(size) * 2));
    const S nearer = turn_towards(angle, other, S(0.25));
    const Real left = std::abs(std::remainder(real(other) - real(nearer), 2 * kPi));
    EXPECT_NEAR(double(left), double(std::max(Real(0), std::abs(real(way)) - Real(0.25))),
                double(tolerance * 2 + half_ulp<S>(size) * 4));
    const U t = this->part(draw);
    EXPECT_NEAR(off(real(lerp_angle<S>(angle, other, t)), real(angle) + real(way) * real(t)), 0,
                double(tolerance * 2 + half_ulp<S>(size) * 4));
  }
  EXPECT_EQ(wrap_angle(S(3)), S(3));
  EXPECT_EQ(turn_towards(S(1), S(1.125), S(0.25)), S(1.125));
  EXPECT_NEAR(to_double(to_degrees(S(0.5))), 28.6478897565411604, double(half_ulp<S>(32) * 4));
  EXPECT_NEAR(to_double(to_radians(S(90))), 1.57079632679489661923, double(half_ulp<S>(2) * 4));
}

TYPED_TEST(CurvesTest, straight_ways_end_exactly_and_never_overflow) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(52);
  constexpr int kLargest = kIsFixed<S> ? (sizeof(S) == 4 ? 13 : 29) : 20;
  for (int i = 0; i < kDraws; ++i) {
    const S a = draw.number<S>(kLargest), b = draw.number<S>(kLargest);
    const U t = this->part(draw);
    EXPECT_EQ(lerp(a, b, U(0)), a);
    EXPECT_EQ(lerp(a, b, U(1)), b);
    const Real size = std::abs(real(a)) + std::abs(real(b));
    const Real tolerance = bound<S>(1, 6, size) + bound<U>(0, 2, 1) * size;
    EXPECT_NEAR(double(real(lerp(a, b, t)) - (real(a) + (real(b) - real(a)) * real(t))), 0, double(tolerance));
    if (abs(b - a) < S(1)) continue;
    const S x = draw.number<S>(kLargest);
    const Real exact = std::clamp((real(x) - real(a)) / (real(b) - real(a)), Real(0), Real(1));
    EXPECT_NEAR(double(real(inverse_lerp(a, b, x)) - exact), 0,
                double(bound<U>(2, 4, 1) + half_ulp<S>(size) * 4 / std::abs(real(b) - real(a))));
  }
  EXPECT_EQ(inverse_lerp(S(2), S(2), S(5)), U(0));
}

TYPED_TEST(CurvesTest, steps_are_smooth) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(53);
  for (int i = 0; i < kDraws; ++i) {
    const U t = this->part(draw);
    const Real x = real(t);
    EXPECT_NEAR(double(real(smooth_step(t)) - x * x * (3 - 2 * x)), 0, double(bound<U>(8, 8, 1)));
    EXPECT_NEAR(double(real(smoother_step(t)) - x * x * x * (10 - 15 * x + 6 * x * x)), 0, double(bound<U>(32, 16, 1)));
  }
  for (const U end : {U(0), U(1)}) {
    EXPECT_EQ(smooth_step(end), end);
    EXPECT_EQ(smoother_step(end), end);
  }
}

TYPED_TEST(CurvesTest, polynomials_are_horners) {
  using S = TypeParam;
  Draw draw(54);
  for (int i = 0; i < kDraws; ++i) {
    std::vector<S> coefficients(static_cast<std::size_t>(i % 6));
    for (S& c : coefficients) c = draw.number<S>(2);
    const S x = draw.number<S>(1);
    Real sum = 0, size = 1;
    for (std::size_t k = coefficients.size(); k-- > 0;) {
      sum = sum * real(x) + real(coefficients[k]);
      size = size * std::abs(real(x)) + 4;
    }
    EXPECT_NEAR(double(real(polynomial(std::span<const S>(coefficients), x)) - sum), 0, double(bound<S>(64, 12, size)));
  }
}

TYPED_TEST(CurvesTest, cubics_pass_their_points_with_their_slopes) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(55);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(3), b = draw.vector<S>(3), c = draw.vector<S>(3), d = draw.vector<S>(3);
    const U t = this->part(draw);
    const Real x = real(t), u = 1 - x;
    const Real tolerance = bound<S>(2, 16, 64) + bound<U>(16, 16, 1) * 64;
    const RealVec hermite_at = real(a) * (1 - x * x * (3 - 2 * x)) + real(b) * (x * u * u) +
                               real(c) * (x * x * (3 - 2 * x)) - real(d) * (x * x * u);
    expect_near(real(hermite(a, b, c, d, t)), hermite_at, tolerance);
    const RealVec slope = (real(c) - real(a)) * (6 * x * u) + real(b) * (u * (1 - 3 * x)) + real(d) * (x * (3 * x - 2));
    expect_near(real(hermite_slope(a, b, c, d, t)), slope, tolerance * 2);
    const RealVec out = (real(c) - real(a)) / 2, in = (real(d) - real(b)) / 2;
    const RealVec catmull =
        real(b) * (1 - x * x * (3 - 2 * x)) + out * (x * u * u) + real(c) * (x * x * (3 - 2 * x)) - in * (x * x * u);
    expect_near(real(catmull_rom(a, b, c, d, t)), catmull, tolerance);
    const RealVec curve =
        real(a) * (u * u * u) + real(b) * (3 * u * u * x) + real(c) * (3 * u * x * x) + real(d) * (x * x * x);
    expect_near(real(bezier(a, b, c, d, t)), curve, tolerance);
    EXPECT_EQ(hermite(a, b, c, d, U(0)), a);
    EXPECT_EQ(hermite(a, b, c, d, U(1)), c);
    EXPECT_EQ(hermite_slope(a, b, c, d, U(0)), b);
    EXPECT_EQ(hermite_slope(a, b, c, d, U(1)), d);
    EXPECT_EQ(catmull_rom(a, b, c, d, U(0)), b);
    EXPECT_EQ(catmull_rom(a, b, c, d, U(1)), c);
    EXPECT_EQ(bezier(a, b, c, d, U(0)), a);
    EXPECT_EQ(bezier(a.x, b.x, c.x, d.x, U(1)), d.x);
    EXPECT_EQ(catmull_rom(a.y, b.y, c.y, d.y, t), catmull_rom(a, b, c, d, t).y);
  }
}

}  // namespace curves_test
}  // namespace isostep
