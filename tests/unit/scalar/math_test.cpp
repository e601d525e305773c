// Elementary functions against MPFR: error bounds per scalar, structured inputs, ends, special values, tables.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/math.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "isostep/scalar/math.inl"
#include "unit/scalar/mpfr_oracle.hpp"

namespace isostep {
namespace math_test {

using Q24_40 = Fixed<std::int64_t, 40>;
using TrapQ16_16 = Fixed<std::int32_t, 16, Overflow::trap>;

/// Powers of two, multiples of pi/2 and the ends, each with its neighbours.
template <class S> std::vector<S> structured() {
  std::vector<S> centres;
  if constexpr (kIsFixed<S>) {
    for (int k = 0; k < S::kBits - 1; ++k) centres.push_back(S::from_raw(static_cast<typename S::Raw>(1) << k));
    centres.push_back(S::from_raw(S::highest().raw() - 3));
  } else {
    for (double p = 0x1p-70; p < 0x1p70; p *= 2) centres.push_back(static_cast<S>(p));
  }
  Real multiple;
  for (int n = 1; n < 3000; n += n < 40 ? 1 : 37) {
    mpfr_const_pi(multiple, MPFR_RNDN);
    mpfr_mul_ui(multiple, multiple, static_cast<unsigned>(n), MPFR_RNDN);
    mpfr_div_ui(multiple, multiple, 2, MPFR_RNDN);
    if constexpr (kIsFixed<S>) {
      if (mpfr_cmp_d(multiple, to_double(S::highest()) - 0.01) < 0) centres.push_back(get<S>(multiple));
    } else {
      centres.push_back(get<S>(multiple));
      mpfr_mul_2ui(multiple, multiple, 18, MPFR_RNDN);
      centres.push_back(get<S>(multiple));
    }
  }
  std::vector<S> result{S(0)};
  for (const S centre : centres) {
    for (int step = -3; step <= 3; ++step) {
      result.push_back(nudged(centre, step));
      result.push_back(-nudged(centre, step));
    }
  }
  if constexpr (kIsFixed<S>) result.push_back(S::lowest());
  return result;
}
template <class S> std::vector<S> arguments(int low = -60, int high = 60) {
  std::vector<S> result = structured<S>();
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) result.push_back(any_of<S>(random, low, high));
  return result;
}
/// Random within [-1, 1], some of them close to the ends.
template <class S> std::vector<S> sines() {
  std::vector<S> result;
  Random random;
  for (const S x : arguments<S>(-40, -1)) {
    if (x < S(-1) || x > S(1)) continue;
    const S gap = S(1) - abs(x);
    result.push_back(x);
    result.push_back(random.below(2) != 0 ? gap : -gap);
  }
  return result;
}

/// The errors promised, in ulp, as in scalar/README.md.
struct Bounds {
  double circular, inverse, rsqrt, direction, length, quaternion;
};
template <class S> constexpr Bounds bounds() {
  if constexpr (std::same_as<S, float>) return {0.5000001, 0.5000001, 1.5, 2.5, 1.5, 3};
  if constexpr (std::same_as<S, double>) return {0.51, 0.51, 1.5, 2.5, 1.5, 3};
  if constexpr (kIsFixed<S>) {
    if constexpr (S::kFracBits >= 60) return {2, 3, 1.0, 2, 0.5, 2};
  }
  return {0.5001, 0.5001, 0.51, 2, 0.5, 2};
}

template <class S> class ElementaryFunction : public ::testing::Test {};
using Formats = ::testing::Types<float, double, Q16_16, Q32_32, Unit<Q16_16>, Unit<Q32_32>, Q24_40, TrapQ16_16>;
TYPED_TEST_SUITE(ElementaryFunction, Formats);

TYPED_TEST(ElementaryFunction, SineStaysWithinItsBound) {
  using S = TypeParam;
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : arguments<S>()) {
    set(x, a);
    mpfr_sin(want, x, MPFR_RNDN);
    worst.see(ulp_error(isostep::sin(a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().circular) << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, CosineStaysWithinItsBound) {
  using S = TypeParam;
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : arguments<S>()) {
    set(x, a);
    mpfr_cos(want, x, MPFR_RNDN);
    worst.see(ulp_error(isostep::cos(a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().circular) << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, SineAndCosineTogetherAreTheSameBits) {
  using S = TypeParam;
  for (const S a : arguments<S>()) {
    const SinCos<S> both = sin_cos(a);
    ASSERT_EQ(to_bits(both.sin), to_bits(isostep::sin(a)));
    ASSERT_EQ(to_bits(both.cos), to_bits(isostep::cos(a)));
  }
}

TYPED_TEST(ElementaryFunction, SineAsADirectionStaysWithinTheBoundOfUnit) {
  using S = TypeParam;
  using U = Unit<S>;
  Real x, sine, cosine;
  for (const S a : arguments<S>()) {
    set(x, a);
    mpfr_sin_cos(sine, cosine, x, MPFR_RNDN);
    const SinCos<U> both = sin_cos_to<U>(a);
    ASSERT_LE(ulp_error(both.sin, sine), bounds<U>().circular) << to_double(a);
    ASSERT_LE(ulp_error(both.cos, cosine), bounds<U>().circular) << to_double(a);
  }
}

template <class S> std::vector<std::pair<S, S>> points() {
  std::vector<std::pair<S, S>> result;
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) {
    const S y = any_of<S>(random);
    result.push_back({y, any_of<S>(random)});
    result.push_back({y, nudged(y, random.below(9) - 4)});  // near the diagonal
    result.push_back({random.below(2) != 0 ? S(0) : y, random.below(2) != 0 ? -y : S(0)});
  }
  if constexpr (kIsFixed<S>) {
    for (const S y : {S::lowest(), S::highest(), S::from_raw(1), S::from_raw(-1), S(0)}) {
      for (const S x : {S::lowest(), S::highest(), S::from_raw(1), S::from_raw(-1), S(0)}) result.push_back({y, x});
    }
  }
  return result;
}

TYPED_TEST(ElementaryFunction, AngleOfAPointStaysWithinItsBound) {
  using S = TypeParam;
  Real x, y, want;
  Worst worst("max_ulp");
  for (const auto& [b, a] : points<S>()) {
    set(x, a);
    set(y, b);
    mpfr_atan2(want, y, x, MPFR_RNDN);
    worst.see(ulp_error(isostep::atan2(b, a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().inverse) << to_double(b) << ' ' << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, ArcSineStaysWithinItsBound) {
  using S = TypeParam;
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : sines<S>()) {
    set(x, a);
    mpfr_asin(want, x, MPFR_RNDN);
    worst.see(ulp_error(isostep::asin(a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().inverse) << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, ArcCosineStaysWithinItsBound) {
  using S = TypeParam;
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : sines<S>()) {
    set(x, a);
    mpfr_acos(want, x, MPFR_RNDN);
    worst.see(ulp_error(isostep::acos(a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().inverse) << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, ArcSineAndArcCosineClampTheirArgument) {
  using S = TypeParam;
  const S beyond = S(1) + resolution<S>();
  EXPECT_EQ(isostep::asin(beyond), isostep::asin(S(1)));
  EXPECT_EQ(isostep::asin(-beyond), isostep::asin(S(-1)));
  EXPECT_EQ(isostep::acos(beyond), S(0));
  EXPECT_EQ(isostep::acos(-beyond), isostep::acos(S(-1)));
}

TYPED_TEST(ElementaryFunction, SquareRootIsTheNearest) {
  using S = TypeParam;
  Real x, want;
  for (const S a : arguments<S>(-120, 120)) {
    if (a < S(0)) continue;
    set(x, a);
    mpfr_sqrt(want, x, MPFR_RNDN);
    ASSERT_EQ(to_bits(isostep::sqrt(a)), to_bits(get<S>(want))) << to_double(a);
  }
}

TYPED_TEST(ElementaryFunction, ReciprocalRootStaysWithinItsBound) {
  using S = TypeParam;
  Real x, want;
  Worst worst("max_ulp");
  for (const S a : arguments<S>()) {
    if (a <= S(0)) continue;
    set(x, a);
    mpfr_rec_sqrt(want, x, MPFR_RNDN);
    worst.see(ulp_error(rsqrt(a), want));
    ASSERT_LE(worst.ulp(), bounds<S>().rsqrt) << to_double(a);
  }
}

template <class S> std::vector<std::vector<S>> vectors(std::size_t dimension, int low, int high) {
  std::vector<std::vector<S>> result;
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) {
    std::vector<S> v;
    const int shift = random.below(30);
    for (std::size_t k = 0; k < dimension; ++k) {
      S c = any_of<S>(random, low, high);
      if constexpr (kIsFixed<S>) {
        if (i % 2 == 0) c = S::from_raw(static_cast<typename S::Raw>(random.bits()) >> shift);  // one magnitude
      }
      v.push_back(i % 7 == 0 && k == 1 ? S(0) : c);
    }
    result.push_back(v);
  }
  if constexpr (kIsFixed<S>) {
    result.push_back(std::vector<S>(dimension, S::from_raw(1)));
    result.push_back(std::vector<S>(dimension, S::highest()));
    if (dimension == 3) result.push_back(std::vector<S>(dimension, S::lowest()));
    result.push_back(std::vector<S>(dimension, S(0)));
    result.back()[0] = S::from_raw(-1);
    result.push_back(std::vector<S>(dimension, S(0)));
    result.back()[0] = S::lowest();
  }
  return result;
}
/// Exact enough: 200 bits hold any sum of squares of these formats and ranges.
template <class S> void length(mpfr_ptr out, const std::vector<S>& v) {
  Real c;
  mpfr_set_zero(out, 1);
  for (const S x : v) {
    set(c, x);
    mpfr_sqr(c, c, MPFR_RNDN);
    mpfr_add(out, out, c, MPFR_RNDN);
  }
  mpfr_sqrt(out, out, MPFR_RNDN);
}

TYPED_TEST(ElementaryFunction, DirectionAndLengthStayWithinTheirBounds) {
  using S = TypeParam;
  Real size, want;
  Worst component("max_ulp_component"), whole("max_ulp_length");
  const bool wide = std::same_as<S, double>;
  for (const std::vector<S>& v : vectors<S>(3, wide ? -1000 : -120, wide ? 1000 : 120)) {
    length(size, v);
    if (mpfr_zero_p(static_cast<mpfr_ptr>(size))) continue;
    const Direction<S> d = direction_of(v[0], v[1], v[2]);
    const Unit<S> got[3] = {d.x, d.y, d.z};
    for (std::size_t k = 0; k < 3; ++k) {
      set(want, v[k]);
      mpfr_div(want, want, size, MPFR_RNDN);
      component.see(ulp_error(got[k], want, -40));
    }
    whole.see(ulp_error(d.length, size));
    ASSERT_LE(component.ulp(), bounds<S>().direction);
    ASSERT_LE(whole.ulp(), bounds<S>().length);
  }
}

TYPED_TEST(ElementaryFunction, DirectionOfTheZeroVectorIsZero) {
  using S = TypeParam;
  const Direction<S> d = direction_of(S(0), S(0), S(0));
  EXPECT_EQ(d.x, Unit<S>(0));
  EXPECT_EQ(d.y, Unit<S>(0));
  EXPECT_EQ(d.z, Unit<S>(0));
  EXPECT_EQ(d.length, S(0));
}

TYPED_TEST(ElementaryFunction, DirectionOfAnAxisIsExact) {
  using S = TypeParam;
  for (const S a : structured<S>()) {
    if (a == S(0)) continue;
    const Direction<S> d = direction_of(S(0), a, S(0));
    EXPECT_EQ(d.x, Unit<S>(0));
    EXPECT_EQ(d.z, Unit<S>(0));
    EXPECT_EQ(d.y, a < S(0) ? Unit<S>(-1) : Unit<S>(1));
  }
}

TYPED_TEST(ElementaryFunction, QuaternionOfNormBetweenAQuarterAndTwoBecomesUnit) {
  using U = Unit<TypeParam>;
  Real size, want;
  Worst worst("max_ulp");
  Random random;
  for (int i = 0; i < ISOSTEP_MATH_SAMPLES; ++i) {
    std::vector<U> q(4);
    const int closeness = random.below(40);  // from norms anywhere to norms near 1
    double squared = 0;
    double c[4];
    for (double& a : c) {
      a = static_cast<double>(random.bits() >> 11) * 0x1p-52 - 1;
      squared += a * a;
    }
    double root = 1;
    for (int k = 0; k < 40; ++k) root = (root + squared / root) / 2;
    double off = static_cast<double>(random.bits() >> 11) * 0x1p-53;
    for (int k = 0; k < closeness; ++k) off *= 0.5;
    const double norm = closeness < 3 ? 0.25 + 1.74 * off : 1 + (random.below(2) != 0 ? off : -off);
    for (std::size_t k = 0; k < 4; ++k) q[k] = from_double<U>(c[k] / root * norm);
    length(size, q);
    std::vector<U> got = q;
    normalise4(got[0], got[1], got[2], got[3]);
    for (std::size_t k = 0; k < 4; ++k) {
      set(want, q[k]);
      mpfr_div(want, want, size, MPFR_RNDN);
      worst.see(ulp_error(got[k], want));
    }
    ASSERT_LE(worst.ulp(), bounds<TypeParam>().quaternion);
  }
}

TYPED_TEST(ElementaryFunction, ZeroQuaternionBecomesTheIdentity) {
  using U = Unit<TypeParam>;
  U x(0), y(0), z(0), w(0);
  normalise4(x, y, z, w);
  EXPECT_EQ(x, U(0));
  EXPECT_EQ(y, U(0));
  EXPECT_EQ(z, U(0));
  EXPECT_EQ(w, U(1));
}

template <class S> class FixedFunction : public ::testing::Test {};
using FixedFormats = ::testing::Types<Q16_16, Q32_32, Q24_40>;
TYPED_TEST_SUITE(FixedFunction, FixedFormats);

TYPED_TEST(FixedFunction, RootsOfZeroAndBelowHaveDocumentedValues) {
  using S = TypeParam;
  for (const S a : {S(0), S(-1), S::lowest()}) {
    EXPECT_EQ(isostep::sqrt(a), S(0));
    EXPECT_EQ(rsqrt(a), S::highest());
  }
}

TYPED_TEST(FixedFunction, AngleOfTwoUnitsKeepsTheRangeOfS) {
  using S = TypeParam;
  using U = Unit<S>;
  Real x, y, want;
  for (const auto& [b, a] : points<U>()) {
    set(x, a);
    set(y, b);
    mpfr_atan2(want, y, x, MPFR_RNDN);
    ASSERT_LE(ulp_error(atan2_to<S>(b, a), want), 0.5001);
  }
}

template <class S> class FloatFunction : public ::testing::Test {};
using FloatFormats = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FloatFunction, FloatFormats);

TYPED_TEST(FloatFunction, HugeArgumentsKeepTheBound) {
  using S = TypeParam;
  Real x, want;
  Random random;
  std::vector<S> huge{std::numeric_limits<S>::max(), S(0x1p31), S(0x1p100)};
  if constexpr (sizeof(S) == 8) huge.push_back(6381956970095103.0 * 0x1p797);  // nearest of all to a multiple of pi/2
  for (int i = 0; i < 2000; ++i) huge.push_back(any_of<S>(random, 30, std::numeric_limits<S>::max_exponent - 1));
  for (const S a : huge) {
    set(x, a);
    mpfr_sin(want, x, MPFR_RNDN);
    ASSERT_LE(ulp_error(isostep::sin(a), want), bounds<S>().circular) << to_double(a);
    mpfr_cos(want, x, MPFR_RNDN);
    ASSERT_LE(ulp_error(isostep::cos(a), want), bounds<S>().circular) << to_double(a);
  }
}

TYPED_TEST(FloatFunction, SubnormalNumbersAreNotFlushed) {
  using S = TypeParam;
  const S least = std::numeric_limits<S>::denorm_min();
  EXPECT_EQ(to_bits(isostep::sin(least)), 1u);
  EXPECT_EQ(to_bits(isostep::asin(least)), 1u);
  EXPECT_EQ(to_bits(isostep::atan2(least, S(1))), 1u);
  EXPECT_EQ(to_bits(isostep::atan2(least * 5, S(2))), 2u);  // 2.5 units: ties to even
  EXPECT_EQ(to_bits(isostep::atan2(least, S(4))), 0u);
  EXPECT_EQ(to_bits(isostep::sqrt(least * 4)), to_bits(isostep::sqrt(least) * 2));
}

TYPED_TEST(FloatFunction, NotANumberAndInfinityFollowIeee754) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const S nan = std::numeric_limits<S>::quiet_NaN();
  for (const S x : {inf, -inf, nan, -nan}) {
    EXPECT_EQ(to_bits(isostep::sin(x)), to_bits(nan));
    EXPECT_EQ(to_bits(isostep::cos(x)), to_bits(nan));
    EXPECT_EQ(to_bits(sin_cos(x).sin), to_bits(nan));
  }
  for (const S x : {S(1), S(0), inf, nan}) {
    EXPECT_EQ(to_bits(isostep::atan2(nan, x)), to_bits(nan));
    EXPECT_EQ(to_bits(isostep::atan2(x, nan)), to_bits(nan));
  }
  EXPECT_EQ(to_bits(isostep::asin(nan)), to_bits(nan));
  EXPECT_EQ(to_bits(isostep::acos(nan)), to_bits(nan));
  EXPECT_EQ(isostep::asin(inf), isostep::asin(S(1)));
  EXPECT_EQ(isostep::sqrt(inf), inf);
  EXPECT_FALSE(is_finite(isostep::sqrt(S(-1))));
  Real x, y, want;
  for (const S b : {inf, -inf, S(0), -S(0), S(2), S(-2)}) {
    for (const S a : {inf, -inf, S(0), -S(0), S(3), S(-3)}) {
      set(x, a);
      set(y, b);
      mpfr_atan2(want, y, x, MPFR_RNDN);
      EXPECT_EQ(to_bits(isostep::atan2(b, a)), to_bits(get<S>(want))) << b << ' ' << a;
    }
  }
}

TYPED_TEST(FloatFunction, DirectionNeitherOverflowsNorVanishes) {
  using S = TypeParam;
  const S most = std::numeric_limits<S>::max();
  const S least = std::numeric_limits<S>::denorm_min();
  const Direction<S> big = direction_of(most, S(0), -most / 2);
  Real want;
  mpfr_set_ui(want, 5, MPFR_RNDN);
  mpfr_rec_sqrt(want, want, MPFR_RNDN);
  EXPECT_LE(ulp_error(-big.z, want), 2);
  mpfr_mul_ui(want, want, 2, MPFR_RNDN);
  EXPECT_LE(ulp_error(big.x, want), 2);
  const Direction<S> small = direction_of(least * 3, least * 4, S(0));
  EXPECT_LE(abs(small.x - S(3) / S(5)), resolution<S>());
  EXPECT_LE(abs(small.y - S(4) / S(5)), resolution<S>());
  EXPECT_EQ(small.length, least * 5);
}

TEST(Soft, RoundsADoubleToFloatAsTheProcessorDoes) {
  Random random;
  for (int i = 0; i < 300000; ++i) {
    double value = any_of<double>(random, -155, 129);
    if (i % 3 == 0) value = from_bits<double>((to_bits(value) & ~std::uint64_t{0x1fffffff}) | 0x10000000u);  // a tie
    const auto expected = static_cast<float>(value);
    ASSERT_EQ(to_bits(detail::from_soft<float>(detail::to_soft(value))), to_bits(expected)) << value;
    ASSERT_EQ(to_bits(detail::from_soft<double>(detail::to_soft(value))), to_bits(value));
    ASSERT_EQ(to_bits(detail::from_soft<float>(detail::to_soft(expected))), to_bits(expected));
  }
}

TEST(MathTables, FollowFromTheirDefinitions) {
  Real exact;
  auto word = [&](int scale) {
    mpfr_mul_2si(exact, exact, scale, MPFR_RNDN);
    return static_cast<std::uint64_t>(mpfr_get_ui(exact, MPFR_RNDN));
  };
  mpfr_const_pi(exact, MPFR_RNDN);
  EXPECT_EQ(word(62), detail::kPiQ62);
  mpfr_const_pi(exact, MPFR_RNDN);
  EXPECT_EQ(word(61), detail::kHalfPiQ62);
  for (int i = 1, k = 0; i <= 64; ++i) {
    if (i == 2 << k) ++k;
    mpfr_set_ui_2exp(exact, static_cast<unsigned>(i), -6, MPFR_RNDN);
    mpfr_atan(exact, exact, MPFR_RNDN);
    EXPECT_EQ(word(69 - k), detail::kAtan64ths[i]) << i;
  }
  mpfr_t digits;
  mpfr_init2(digits, 2000);
  mpfr_const_pi(digits, MPFR_RNDN);
  mpfr_ui_div(digits, 2, digits, MPFR_RNDN);
  for (int i = 2; i < 21; ++i) {
    mpfr_mul_2ui(digits, digits, 64, MPFR_RNDN);
    const std::uint64_t digit = mpfr_get_ui(digits, MPFR_RNDD);
    EXPECT_EQ(digit, detail::kTwoOverPi[i]) << i;
    mpfr_sub_ui(digits, digits, digit, MPFR_RNDN);
  }
  mpfr_clear(digits);
}

TEST(RsqrtCore, SeedIsBelowTheCurveAndTheAnswerWithinItsBound) {
  Random random;
  Real m, want, e;
  Worst worst("max_units");
  for (int i = 0; i < 64 * ISOSTEP_MATH_SAMPLES / 8; ++i) {
    std::uint64_t a = random.bits() | (std::uint64_t{1} << 62);
    if (i < 192 * 8) {  // both ends of every cell of the table
      a = (static_cast<std::uint64_t>(i / 8 + 64) << 56) + static_cast<std::uint64_t>(i % 8) - 4;
      if (i < 8 || a < (std::uint64_t{1} << 62)) a = (std::uint64_t{1} << 62) + static_cast<std::uint64_t>(i);
    }
    mpfr_set_ui_2exp(m, a, -62, MPFR_RNDN);
    const detail::RsqrtSeed seed = detail::kRsqrtSeed[(a >> 56) - 64];
    const std::uint64_t y0 = seed.value - ((seed.slope * ((a >> 40) & 0xffffu)) >> 6);
    mpfr_set_ui_2exp(e, y0, -32, MPFR_RNDN);
    mpfr_sqr(e, e, MPFR_RNDN);
    mpfr_mul(e, e, m, MPFR_RNDN);
    mpfr_ui_sub(e, 1, e, MPFR_RNDN);
    ASSERT_GT(mpfr_cmp_d(e, 0), 0) << a;
    ASSERT_LT(mpfr_cmp_d(e, 0x1p-14), 0) << a;
    mpfr_rec_sqrt(want, m, MPFR_RNDN);
    mpfr_mul_2ui(want, want, 64, MPFR_RNDN);
    mpfr_sub_ui(want, want, detail::rsqrt_q64(a), MPFR_RNDN);
    const double error = mpfr_get_d(want, MPFR_RNDN);
    worst.see(error < 0 ? -error : error);
  }
  EXPECT_LE(worst.ulp(), 1.0);
}

}  // namespace math_test
}  // namespace isostep
