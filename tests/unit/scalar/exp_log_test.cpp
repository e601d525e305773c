// exp, log and power against MPFR: error bounds per scalar, structured arguments, ends, special values, tables.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "isostep/scalar/math.inl"
#include "unit/scalar/mpfr_oracle.hpp"

namespace isostep {
namespace exp_log_test {

using Q24_40 = Fixed<std::int64_t, 40>;
using Q62_2 = Fixed<std::int64_t, 2>;
using TrapQ16_16 = Fixed<std::int32_t, 16, Overflow::trap>;

/// The errors promised, in ulp, as in scalar/README.md: 128 bits inside leave 2^-11 for the widest formats.
template <class S> constexpr double bound() {
  if constexpr (std::same_as<S, float>) return 0.5000001;
  if constexpr (std::same_as<S, double>) return 0.50001;
  return 0.501;
}

/// A number beyond the largest float is infinite; MPFR's own rounding says which.
template <class S> double error_of(S got, mpfr_ptr want) {
  if constexpr (!kIsFixed<S>) {
    if (!is_finite(got)) return got == get<S>(want) ? 0 : 1e9;
  }
  return ulp_error(got, want);
}

/// The numbers next to `centre` as far as S holds them.
template <class S> void push_near(std::vector<S>& result, mpfr_ptr centre) {
  if constexpr (kIsFixed<S>) {
    const double size = mpfr_get_d(centre, MPFR_RNDN);
    if (size <= 0.999 * to_double(S::lowest()) || size >= 0.999 * to_double(S::highest())) return;
  }
  for (int step = -3; step <= 3; ++step) result.push_back(nudged(get<S>(centre), step));
}
template <class S> void push_ends(std::vector<S>& result) {
  for (int step = 0; step < 4; ++step) {
    result.push_back(nudged(highest<S>(), -step));
    if constexpr (kIsFixed<S>) result.push_back(nudged(S::lowest(), step));
    if constexpr (!kIsFixed<S>) result.push_back(-nudged(highest<S>(), -step));
  }
}

/// Random magnitudes and moderate numbers; 0, powers of two, borders of the table's cells and logarithms of the ends
/// of the formats, with their neighbours; the ends.
template <class S> std::vector<S> exponents() {
  std::vector<S> result{S(0)};
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) {
    result.push_back(any_of<S>(random, -70, 11));
    const double moderate = (static_cast<double>(random.bits() >> 11) * 0x1p-52 - 1) * (1 << random.below(11));
    result.push_back(from_double<S>(moderate));
  }
  Real centre;
  for (int k = -80; k <= 60; ++k) {
    mpfr_set_si_2exp(centre, 1, k, MPFR_RNDN);
    push_near(result, centre);
    mpfr_neg(centre, centre, MPFR_RNDN);
    push_near(result, centre);
  }
  for (int i = -1100 * 64; i <= 1100 * 64; i += i > -200 && i < 200 ? 1 : 61) {  // 61 and 64 are coprime
    mpfr_const_log2(centre, MPFR_RNDN);
    mpfr_mul_si(centre, centre, i, MPFR_RNDN);
    mpfr_div_ui(centre, centre, 64, MPFR_RNDN);
    push_near(result, centre);
  }
  for (const int power : {-1075, -1074, -1022, -150, -149, -126, -33, -32, -17, 1, 15, 31, 128, 1024}) {
    mpfr_const_log2(centre, MPFR_RNDN);
    mpfr_mul_si(centre, centre, power, MPFR_RNDN);
    push_near(result, centre);
  }
  push_ends(result);
  return result;
}

/// Numbers above 0: random magnitudes; numbers near 1 at every distance; powers of two, borders of cells, the ends.
template <class S> std::vector<S> positives() {
  std::vector<S> all;
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) {
    all.push_back(abs(any_of<S>(random, -148, 126)));
    const double away =
        static_cast<double>(random.bits() >> 11) / static_cast<double>(std::uint64_t{1} << random.below(64));
    all.push_back(from_double<S>(1 + away * 0x1p-54));
    all.push_back(from_double<S>(1 - away * 0x1p-54));
  }
  Real centre;
  for (int k = -1080; k <= 1023; k += k > -70 && k < 70 ? 1 : 13) {
    for (int j = 127; j <= 256; j += k > -4 && k < 4 ? 1 : 129) {
      mpfr_set_si_2exp(centre, j, k - 7, MPFR_RNDN);
      push_near(all, centre);
    }
  }
  push_ends(all);
  std::vector<S> result;
  for (const S a : all) {
    if (a > S(0) && is_finite(a)) result.push_back(a);
  }
  return result;
}

template <class S> class Exponential : public ::testing::Test {};
using Formats = ::testing::Types<float, double, Q16_16, Q32_32, Unit<Q16_16>, Unit<Q32_32>, Q24_40, Q62_2, TrapQ16_16>;
TYPED_TEST_SUITE(Exponential, Formats);

template <class Out, class S> void expect_exponential_within_bound() {
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : exponents<S>()) {
    if (!is_finite(a)) continue;
    set(x, a);
    mpfr_exp(want, x, MPFR_RNDN);
    worst.see(error_of(exp_to<Out>(a), want));
    ASSERT_LE(worst.ulp(), bound<Out>()) << to_double(a);
  }
}
template <class Out, class S> void expect_logarithm_within_bound() {
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : positives<S>()) {
    set(x, a);
    mpfr_log(want, x, MPFR_RNDN);
    worst.see(error_of(log_to<Out>(a), want));
    ASSERT_LE(worst.ulp(), bound<Out>()) << to_double(a);
  }
}

TYPED_TEST(Exponential, StaysWithinItsBound) { expect_exponential_within_bound<TypeParam, TypeParam>(); }
TYPED_TEST(Exponential, AsADirectionStaysWithinTheBoundOfUnit) {
  expect_exponential_within_bound<Unit<TypeParam>, TypeParam>();
}
TYPED_TEST(Exponential, AsAFractionStaysWithinTheBoundOfStep) {
  expect_exponential_within_bound<Step<TypeParam>, TypeParam>();
}
TYPED_TEST(Exponential, LogarithmStaysWithinItsBound) { expect_logarithm_within_bound<TypeParam, TypeParam>(); }
TYPED_TEST(Exponential, LogarithmOfUnitAndStepStaysWithinTheBoundOfS) {
  expect_logarithm_within_bound<TypeParam, Unit<TypeParam>>();
  expect_logarithm_within_bound<TypeParam, Step<TypeParam>>();
}

template <class S> class FixedPower : public ::testing::Test {};
using FixedFormats = ::testing::Types<Q16_16, Q32_32, Q24_40, TrapQ16_16>;
TYPED_TEST_SUITE(FixedPower, FixedFormats);

TYPED_TEST(FixedPower, StaysWithinTheBoundOfStep) {
  using S = TypeParam;
  using H = Step<S>;
  Real x, h, want;
  Worst worst("max_ulp");
  Random random;
  std::vector<H> fractions{H(0), H::from_raw(1), H::highest(), H(0.5), H(0.25), H(0x1p-10)};
  for (const int rate : {30, 50, 60, 64, 120, 240, 480, 1000}) fractions.push_back(divide_to<H>(S(1), S(rate)));
  for (const S base : positives<S>()) {
    for (int i = 0; i < 3; ++i) {
      const H exponent = i == 0 ? abs(any_of<H>(random)) : fractions[static_cast<std::size_t>(random.below(14))];
      set(x, base);
      set(h, exponent);
      mpfr_pow(want, x, h, MPFR_RNDN);
      worst.see(error_of(power_to<H>(base, exponent), want));
      ASSERT_LE(worst.ulp(), bound<H>()) << to_double(base) << " ^ " << to_double(exponent);
    }
  }
}

TYPED_TEST(FixedPower, OfZeroOneAndNegativeBasesHasDocumentedValues) {
  using S = TypeParam;
  using H = Step<S>;
  const H one = H::highest();
  for (const S base : {S(0), S(-1), S::lowest()}) {
    EXPECT_EQ(power_to<H>(base, H(0)), one);
    EXPECT_EQ(power_to<H>(base, H::from_raw(1)), H(0));
    EXPECT_EQ(power_to<H>(base, H(0.5)), H(0));
  }
  for (const H exponent : {H(0), H::from_raw(1), H(0.5), H::highest()}) EXPECT_EQ(power_to<H>(S(1), exponent), one);
  EXPECT_EQ(power_to<H>(S(2), H(0.5)), one);
  EXPECT_EQ(power_to<H>(S(0.25), H(0.5)), H(0.5));
}

TYPED_TEST(FixedPower, LogarithmOfZeroAndBelowIsTheLowest) {
  using S = TypeParam;
  for (const S a : {S(0), S(-1), S::from_raw(-1), S::lowest()}) EXPECT_EQ(isostep::log(a), S::lowest());
}

TYPED_TEST(FixedPower, ExponentialEndsWithTheFormat) {
  using S = TypeParam;
  EXPECT_EQ(isostep::exp(S::highest()), S::highest());
  EXPECT_EQ(isostep::exp(S::lowest()), S(0));
  EXPECT_EQ(isostep::exp(S(0)), S(1));
  EXPECT_EQ(isostep::log(S(1)), S(0));
  EXPECT_EQ(exp_to<Step<S>>(S(0)), Step<S>::highest());
  EXPECT_EQ(exp_to<Step<S>>(S(3)), Step<S>::highest());
  EXPECT_EQ(log_to<Unit<S>>(S::from_raw(1)), -Unit<S>::highest());
}

TYPED_TEST(FixedPower, ExponentialAndLogarithmNeverFallWhereTheirArgumentsRise) {
  using S = TypeParam;
  for (const S a : exponents<S>()) {
    if (a == S::highest()) continue;
    ASSERT_LE(exp_to<Step<S>>(a), exp_to<Step<S>>(nudged(a, 1))) << to_double(a);
  }
  for (const S a : positives<S>()) {
    if (a == S::highest()) continue;
    ASSERT_LE(isostep::log(a), isostep::log(nudged(a, 1))) << to_double(a);
  }
}

template <class S> class FloatPower : public ::testing::Test {};
using FloatFormats = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FloatPower, FloatFormats);

TYPED_TEST(FloatPower, StaysWithinItsBound) {
  using S = TypeParam;
  Real x, h, want;
  Worst worst("max_ulp");
  Random random;
  for (const S base : positives<S>()) {
    for (const S exponent : {any_of<S>(random, -40, -1), any_of<S>(random, -3, 12), S(1) / S(60), S(1), S(-1), S(3)}) {
      set(x, base);
      set(h, exponent);
      mpfr_pow(want, x, h, MPFR_RNDN);
      worst.see(error_of(power_to<S>(base, exponent), want));
      ASSERT_LE(worst.ulp(), bound<S>()) << base << " ^ " << exponent;
    }
  }
}

TYPED_TEST(FloatPower, ReachesTheSubnormalNumbersAndNoFurther) {
  using S = TypeParam;
  const S least = std::numeric_limits<S>::denorm_min();
  const S small = std::numeric_limits<S>::min();
  EXPECT_EQ(power(S(2), S(std::numeric_limits<S>::min_exponent - std::numeric_limits<S>::digits)), least);
  EXPECT_EQ(power(least, S(1)), least);
  EXPECT_EQ(power(least * 5, S(1)), least * 5);
  EXPECT_EQ(power(small, S(2)), S(0));
  EXPECT_EQ(isostep::exp(isostep::log(small) * 2), S(0));
  EXPECT_EQ(isostep::exp(least), S(1));
  EXPECT_EQ(isostep::exp(-least), S(1));
}

TYPED_TEST(FloatPower, SpecialValuesFollowIeee754) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const S nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(to_bits(isostep::exp(nan)), to_bits(nan));
  EXPECT_EQ(to_bits(isostep::exp(-nan)), to_bits(nan));
  EXPECT_EQ(isostep::exp(inf), inf);
  EXPECT_EQ(to_bits(isostep::exp(-inf)), to_bits(S(0)));
  EXPECT_EQ(isostep::exp(highest<S>()), inf);
  EXPECT_EQ(to_bits(isostep::exp(-highest<S>())), to_bits(S(0)));
  EXPECT_EQ(isostep::exp(S(0)), S(1));
  EXPECT_EQ(isostep::exp(-S(0)), S(1));
  for (const S x : {nan, -nan, -inf, S(-1), -std::numeric_limits<S>::denorm_min()}) {
    EXPECT_EQ(to_bits(isostep::log(x)), to_bits(nan)) << x;
  }
  EXPECT_EQ(isostep::log(S(0)), -inf);
  EXPECT_EQ(isostep::log(-S(0)), -inf);
  EXPECT_EQ(isostep::log(inf), inf);
  EXPECT_EQ(to_bits(isostep::log(S(1))), to_bits(S(0)));
}

TYPED_TEST(FloatPower, PowersOfZeroAndInfinityAreTheirLimits) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const S nan = std::numeric_limits<S>::quiet_NaN();
  for (const S h : {S(0), S(0.5), S(-0.5), S(3), inf, -inf}) {
    Real x, y, want;
    for (const S base : {S(0), S(0.5), S(1), S(2), inf}) {
      set(x, base);
      set(y, h);
      mpfr_pow(want, x, y, MPFR_RNDN);
      EXPECT_EQ(to_bits(power(base, h)), to_bits(get<S>(want))) << base << " ^ " << h;
    }
    EXPECT_EQ(power(-S(0), h), power(S(0), h));
    EXPECT_EQ(to_bits(power(S(-2), h)), to_bits(nan));
    EXPECT_EQ(to_bits(power(-inf, h)), to_bits(nan));
    EXPECT_EQ(to_bits(power(nan, h)), to_bits(nan));
    EXPECT_EQ(to_bits(power(h, nan)), to_bits(nan));
  }
}

void expect_word_pair(mpfr_ptr exact, int scale, UInt128Parts table) {
  Real low;
  mpfr_mul_2si(exact, exact, scale, MPFR_RNDN);
  mpfr_rint(exact, exact, MPFR_RNDN);
  mpfr_set_ui_2exp(low, table.high, 64, MPFR_RNDN);
  mpfr_sub(exact, exact, low, MPFR_RNDN);
  EXPECT_EQ(mpfr_cmp_ui(exact, table.low), 0);
}

TEST(ExpLogTables, FollowFromTheirDefinitions) {
  Real exact, ratio;
  mpfr_const_log2(exact, MPFR_RNDN);
  expect_word_pair(exact, 116, detail::kLn2Q116);
  mpfr_const_log2(exact, MPFR_RNDN);
  expect_word_pair(exact, 128, detail::kLn2Q128);
  mpfr_const_log2(exact, MPFR_RNDN);
  mpfr_ui_div(exact, 1, exact, MPFR_RNDN);
  expect_word_pair(exact, 127, detail::kLog2E);
  for (unsigned i = 0; i < 64; ++i) {
    mpfr_set_ui_2exp(exact, i, -6, MPFR_RNDN);
    mpfr_exp2(exact, exact, MPFR_RNDN);
    expect_word_pair(exact, 127, detail::kExp2Of64ths[i]);
  }
  for (unsigned j = 0; j <= 64; ++j) {
    const detail::LogCell cell = detail::kLogCells[j];
    EXPECT_EQ(cell.reciprocal, ((2u << 22) / (64 + j) + 1) / 2) << j;
    mpfr_set_ui_2exp(ratio, 1, 16, MPFR_RNDN);
    mpfr_div_ui(ratio, ratio, cell.reciprocal, MPFR_RNDN);
    mpfr_log(exact, ratio, MPFR_RNDN);
    expect_word_pair(exact, 116, cell.log);
  }
}

/// sum of c[i] (sign u)^i in units of 2^-64, exactly as the coefficients stand.
void evaluate(mpfr_ptr out, const std::uint64_t* c, int degree, mpfr_ptr u) {
  Real coefficient;
  mpfr_set_zero(out, 1);
  for (int i = degree; i >= 0; --i) {
    mpfr_mul(out, out, u, MPFR_RNDN);
    mpfr_set_ui_2exp(coefficient, c[i], -64, MPFR_RNDN);
    mpfr_add(out, out, coefficient, MPFR_RNDN);
  }
}
double log2_of_difference(mpfr_ptr a, mpfr_ptr b) {
  mpfr_sub(a, a, b, MPFR_RNDN);
  if (mpfr_zero_p(a)) return -1000;
  mpfr_abs(a, a, MPFR_RNDN);
  mpfr_log2(a, a, MPFR_RNDN);
  return mpfr_get_d(a, MPFR_RNDN);
}

TEST(ExpLogTables, SeriesApproximateTheirFunctionsAsStated) {
  Real r, u, got, want;
  for (int i = 1; i <= 4096; ++i) {
    mpfr_set_si_2exp(r, i, -18, MPFR_RNDN);  // to 1/64
    mpfr_mul_ui(u, r, 64, MPFR_RNDN);
    evaluate(got, detail::kExpSeries, 5, u);
    mpfr_const_log2(want, MPFR_RNDN);
    mpfr_mul(want, want, r, MPFR_RNDN);
    mpfr_expm1(want, want, MPFR_RNDN);
    mpfr_div(want, want, r, MPFR_RNDN);
    mpfr_const_log2(u, MPFR_RNDN);
    mpfr_sub(want, want, u, MPFR_RNDN);
    mpfr_div(want, want, r, MPFR_RNDN);
    ASSERT_LT(log2_of_difference(got, want), -63.8) << i;  // most of it the coefficients' rounding, 2^-65 each
  }
  for (int i = -2056; i <= 2056; ++i) {
    if (i == 0) continue;
    mpfr_set_si_2exp(r, i, -18, MPFR_RNDN);  // a little beyond 1/128
    mpfr_mul_si(u, r, -64, MPFR_RNDN);
    evaluate(got, detail::kLogSeries, 7, u);
    mpfr_log1p(want, r, MPFR_RNDN);
    mpfr_sub(want, r, want, MPFR_RNDN);
    mpfr_sqr(u, r, MPFR_RNDN);
    mpfr_div(want, want, u, MPFR_RNDN);
    ASSERT_LT(log2_of_difference(got, want), -63.8) << i;
  }
}

}  // namespace exp_log_test
}  // namespace isostep
