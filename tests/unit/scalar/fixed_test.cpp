// Fixed point against integers of twice its width: rounding, saturation, wrap, trap, literals, conversions.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/fixed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>

#include "isostep/scalar/scalar.hpp"
#include "random/splitmix64.hpp"

namespace fixed_test {

using isostep::Fixed;
using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::Unit;
using Trapping32 = Fixed<std::int32_t, 16, Overflow::trap>;
using Trapping64 = Fixed<std::int64_t, 32, Overflow::trap>;

// Literals round to nearest, ties away from zero, and know both ends of the format.
static_assert(Q16_16(0.5).raw() == 32768 && Q16_16(-0.5).raw() == -32768);
static_assert(Q16_16(0x1p-17).raw() == 1 && Q16_16(-0x1p-17).raw() == -1);
static_assert(Q16_16(0x1.fffffffffffffp-18).raw() == 0 && Q16_16(-0x1.fffffffffffffp-18).raw() == 0);
static_assert(Q16_16(-32768.0) == Q16_16::lowest() && Q16_16(32767.99999).raw() == 0x7fffffff);
static_assert(Q32_32(0.1).raw() == 429496730 && Q32_32(-2.75).raw() == -11811160064);
static_assert(Q32_32(0x1.0000000000001p20).raw() == (std::int64_t{1} << 52) + 1);
static_assert(Q32_32(-0x1p31) == Q32_32::lowest());
static_assert(Unit<Q32_32>(1.0).raw() == std::int64_t{1} << 62 && Unit<Q16_16>(-2.0) == Unit<Q16_16>::lowest());
static_assert(Q16_16(7).raw() == 7 << 16 && Q32_32(-3).raw() == -3 * (std::int64_t{1} << 32));
static_assert(Q16_16(1.5) * Q16_16(1.5) == Q16_16(2.25) && Q32_32(1) / Q32_32(-4) == Q32_32(-0.25));
static_assert(std::same_as<decltype(Q16_16{} * Unit<Q16_16>{}), Q16_16>);
static_assert(std::same_as<decltype(Unit<Q32_32>{} * Q32_32{}), Q32_32>);
static_assert(isostep::Scalar<float> && isostep::Scalar<double> && isostep::Scalar<Q16_16> && isostep::Scalar<Q32_32> &&
              isostep::Scalar<Fixed<std::int64_t, 40>> && isostep::Scalar<Trapping64>);

std::uint64_t random_state = 1;
std::uint64_t random_word() { return isostep::test::splitmix64(random_state); }
/// Raw values of every size; ends, small numbers and multiples of powers of two, where ties are, more often.
template <class S> S sample() {
  using Rep = typename S::Raw;
  const Rep ends[] = {0,
                      1,
                      -1,
                      2,
                      -2,
                      std::numeric_limits<Rep>::max(),
                      std::numeric_limits<Rep>::min(),
                      std::numeric_limits<Rep>::min() + 1,
                      Rep{1} << (S::kFracBits - 1),
                      Rep{3} << (S::kFracBits - 1)};
  const std::uint64_t word = random_word();
  const int shift = static_cast<int>(random_word() % S::kBits);
  switch (random_word() % 4) {
    case 0: return S::from_raw(ends[word % 10]);
    case 1: return S::from_raw(static_cast<Rep>(word) >> shift);
    case 2: return S::from_raw(static_cast<Rep>(word << shift));
    default: return S::from_raw(static_cast<Rep>(word));
  }
}

constexpr int kRounds = 100000;

template <class S> class FixedTest : public testing::Test {};
using Formats = testing::Types<Q16_16, Q32_32, Fixed<std::int32_t, 30>, Fixed<std::int64_t, 62>,
                               Fixed<std::int64_t, 40>, Fixed<std::int32_t, 8>>;
TYPED_TEST_SUITE(FixedTest, Formats);

#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 Wide;
__extension__ typedef unsigned __int128 UnsignedWide;

/// floor(n / 2^shift + 1/2) by division, without a shift of a negative number.
Wide nearest(Wide n, int shift) {
  const Wide unit = Wide(1) << shift;
  Wide quotient = n / unit;
  Wide remainder = n % unit;
  if (remainder < 0) {
    remainder += unit;
    quotient -= 1;
  }
  return remainder >= unit - remainder ? quotient + 1 : quotient;
}
bool is_tie(Wide n, int shift) {
  const Wide unit = Wide(1) << shift;
  const Wide remainder = n % unit;
  return remainder == unit / 2 || remainder == -(unit / 2);
}
template <class S> UnsignedWide size(S a) {
  return a.raw() < 0 ? static_cast<UnsignedWide>(-static_cast<Wide>(a.raw())) : static_cast<UnsignedWide>(a.raw());
}

TYPED_TEST(FixedTest, ProductsRoundToNearestTiesUpAndWrap) {
  using S = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const S a = sample<S>();
    const S b = sample<S>();
    const Unit<S> u = sample<Unit<S>>();
    const Wide exact = static_cast<Wide>(a.raw()) * b.raw();
    ASSERT_EQ((a * b).raw(), static_cast<typename S::Raw>(nearest(exact, S::kFracBits))) << a.raw() << " " << b.raw();
    const Wide turned = static_cast<Wide>(a.raw()) * u.raw();
    ASSERT_EQ((a * u).raw(), static_cast<typename S::Raw>(nearest(turned, Unit<S>::kFracBits)));
    ASSERT_EQ((u * a).raw(), (a * u).raw());
    S assigned = a;
    assigned *= u;
    ASSERT_EQ(assigned.raw(), static_cast<typename S::Raw>(nearest(turned, Unit<S>::kFracBits)));
  }
}

TYPED_TEST(FixedTest, ProductsAreOddExceptOnTies) {
  using S = TypeParam;
  int ties = 0;
  for (int i = 0; i < kRounds; ++i) {
    const S a = sample<S>();
    const S b = sample<S>();
    if (a == S::lowest() || b == S::lowest()) continue;
    const bool tie = is_tie(static_cast<Wide>(a.raw()) * b.raw(), S::kFracBits);
    ties += tie ? 1 : 0;
    const S one_step = S::from_raw(1);
    ASSERT_EQ((-a) * b, tie ? one_step - a * b : -(a * b)) << a.raw() << " " << b.raw();
  }
  EXPECT_GT(ties, 0);
}

TYPED_TEST(FixedTest, QuotientsRoundToNearestTiesAwayAndSaturate) {
  using S = TypeParam;
  using Rep = typename S::Raw;
  constexpr auto highest = static_cast<UnsignedWide>(std::numeric_limits<Rep>::max());
  int saturated = 0;
  for (int i = 0; i < kRounds; ++i) {
    const S a = sample<S>();
    const S b = sample<S>();
    if (b.raw() == 0) continue;
    const UnsignedWide n = size(a) << S::kFracBits;
    const UnsignedWide d = size(b);
    const UnsignedWide quotient = n / d + (n % d >= d - n % d ? 1 : 0);
    const bool negative = (a.raw() < 0) != (b.raw() < 0);
    Rep expected;
    if (quotient > highest) {
      expected = negative ? std::numeric_limits<Rep>::min() : std::numeric_limits<Rep>::max();
      ++saturated;
    } else {
      expected = static_cast<Rep>(negative ? -static_cast<Wide>(quotient) : static_cast<Wide>(quotient));
    }
    ASSERT_EQ((a / b).raw(), expected) << a.raw() << " / " << b.raw();
  }
  EXPECT_GT(saturated, 0);
}

TYPED_TEST(FixedTest, SumsOfProductsRoundOnce) {
  using S = TypeParam;
  using U = Unit<S>;
  for (int i = 0; i < kRounds; ++i) {
    const S a = sample<S>();
    const S b = sample<S>();
    const U u = sample<U>();
    const U v = sample<U>();
    const auto first = static_cast<UnsignedWide>(static_cast<Wide>(a.raw()) * u.raw());
    const auto second = static_cast<UnsignedWide>(static_cast<Wide>(b.raw()) * v.raw());
    const auto whole = static_cast<UnsignedWide>(static_cast<Wide>(a.raw())) << U::kFracBits;
    // A sum of 32-bit products is 64 bits wide: its wrap is seen in the rounded 32 bits only through the sign.
    const auto fold = [](UnsignedWide x) {
      return sizeof(typename S::Raw) == 4 ? static_cast<Wide>(static_cast<std::int64_t>(x)) : static_cast<Wide>(x);
    };
    const UnsignedWide half = UnsignedWide(1) << (U::kFracBits - 1);
    const auto rounded = [&](UnsignedWide x) { return static_cast<typename S::Raw>(fold(x + half) >> U::kFracBits); };
    ASSERT_EQ(isostep::round_to<S>(product(a, u) + product(b, v)).raw(), rounded(first + second));
    ASSERT_EQ(isostep::round_to<S>(product(a, u) - product(b, v)).raw(), rounded(first - second));
    ASSERT_EQ(isostep::round_to<S>(-product(a, u)).raw(), rounded(0 - first));
    using SumType = isostep::SumOf<S, U>;
    ASSERT_EQ(isostep::round_to<S>(isostep::widen<SumType>(a) - product(b, v)).raw(), rounded(whole - second));
  }
}
#endif

TYPED_TEST(FixedTest, DivisionByZeroIsTheEndOnTheNumeratorsSide) {
  using S = TypeParam;
  const S zero = S::from_raw(0);
  EXPECT_EQ(S::from_raw(1) / zero, S::highest());
  EXPECT_EQ(S::from_raw(-1) / zero, S::lowest());
  EXPECT_EQ(zero / zero, zero);
  EXPECT_EQ(S::lowest() / S::from_raw(-1), S::highest());
  EXPECT_EQ(S::lowest() / S::from_raw(1), S::lowest());
  EXPECT_EQ(S::highest() / S::highest(), S::from_raw(typename S::Raw{1} << S::kFracBits));
}

TYPED_TEST(FixedTest, SumsAndNegationsWrap) {
  using S = TypeParam;
  const S one_step = S::from_raw(1);
  EXPECT_EQ(S::highest() + one_step, S::lowest());
  EXPECT_EQ(S::lowest() - one_step, S::highest());
  EXPECT_EQ(-S::lowest(), S::lowest());
  EXPECT_EQ(isostep::abs(S::lowest()), S::lowest());
  EXPECT_EQ(S::lowest() + S::lowest(), S::from_raw(0));
  S a = S::highest();
  a += S::highest();
  EXPECT_EQ(a.raw(), -2);
  a -= one_step;
  EXPECT_EQ(a.raw(), -3);
}

TYPED_TEST(FixedTest, ATieOfHalfAStepGoesUp) {
  using S = TypeParam;
  const Unit<S> half = Unit<S>(0.5);
  EXPECT_EQ((S::from_raw(1) * half).raw(), 1);
  EXPECT_EQ((S::from_raw(-1) * half).raw(), 0);
  EXPECT_EQ((S::from_raw(3) * half).raw(), 2);
  EXPECT_EQ((S::from_raw(-3) * half).raw(), -1);
  EXPECT_EQ((S::from_raw(1) / S::from_raw(typename S::Raw{1} << S::kFracBits)).raw(), 1);
}

TYPED_TEST(FixedTest, ExactSumsCompareWithoutRounding) {
  using S = TypeParam;
  const S tiny = S::from_raw(1);
  const auto zero = decltype(product(tiny, tiny))::zero();
  const auto square = product(tiny, tiny);
  EXPECT_TRUE(zero < square && square > zero && zero <= square && square >= zero && !(square == zero));
  EXPECT_TRUE(-square < zero);
  auto sum = product(S::highest(), S::highest());
  sum += square;
  sum -= product(S::highest(), S::highest());
  EXPECT_TRUE(sum == square);
}

TYPED_TEST(FixedTest, OrderIsTheOrderOfRawValues) {
  using S = TypeParam;
  for (int i = 0; i < 1000; ++i) {
    const S a = sample<S>();
    const S b = sample<S>();
    EXPECT_EQ(a < b, a.raw() < b.raw());
    EXPECT_EQ(a > b, a.raw() > b.raw());
    EXPECT_EQ(a <= b, a.raw() <= b.raw());
    EXPECT_EQ(a >= b, a.raw() >= b.raw());
    EXPECT_EQ(a == b, a.raw() == b.raw());
    EXPECT_EQ(a != b, a.raw() != b.raw());
    EXPECT_EQ(isostep::min(a, b).raw(), std::min(a.raw(), b.raw()));
    EXPECT_EQ(isostep::max(a, b).raw(), std::max(a.raw(), b.raw()));
    EXPECT_EQ(isostep::from_bits<S>(isostep::to_bits(a)), a);
    EXPECT_TRUE(isostep::is_finite(a));
  }
}

TYPED_TEST(FixedTest, DoublesComeBackExactlyWhileTheyHoldTheBits) {
  using S = TypeParam;
  using Rep = typename S::Raw;
  for (int i = 0; i < kRounds; ++i) {
    const Rep raw = static_cast<Rep>(static_cast<std::int64_t>(random_word()) >> (11 + random_word() % 50));
    const S a = S::from_raw(raw);
    ASSERT_EQ(isostep::from_double<S>(isostep::to_double(a)), a) << raw;
  }
  EXPECT_EQ(isostep::to_double(S::from_raw(typename S::Raw{1} << (S::kFracBits - 1))), 0.5);
}

TYPED_TEST(FixedTest, DoublesOutsideTheRangeSaturate) {
  using S = TypeParam;
  using Limits = std::numeric_limits<double>;
  EXPECT_EQ(isostep::from_double<S>(Limits::infinity()), S::highest());
  EXPECT_EQ(isostep::from_double<S>(-Limits::infinity()), S::lowest());
  EXPECT_EQ(isostep::from_double<S>(Limits::max()), S::highest());
  EXPECT_EQ(isostep::from_double<S>(-Limits::max()), S::lowest());
  EXPECT_EQ(isostep::from_double<S>(Limits::quiet_NaN()), S::from_raw(0));
  EXPECT_EQ(isostep::from_double<S>(Limits::denorm_min()), S::from_raw(0));
  EXPECT_EQ(isostep::from_double<S>(isostep::to_double(S::lowest())), S::lowest());
}

TYPED_TEST(FixedTest, DoublesRoundAsLiteralsDo) {
  using S = TypeParam;
  EXPECT_EQ(isostep::from_double<S>(0.1), S(0.1));
  EXPECT_EQ(isostep::from_double<S>(-1.0 / 3), S(-1.0 / 3));
  EXPECT_EQ(isostep::from_double<S>(1.9999999), S(1.9999999));
  const double step = isostep::to_double(S::from_raw(1));
  EXPECT_EQ(isostep::from_double<S>(1.5 * step).raw(), 2);
  EXPECT_EQ(isostep::from_double<S>(-1.5 * step).raw(), -2);
  EXPECT_EQ(isostep::from_double<S>(0x0.fffffffffffff8p-1 * step).raw(), 0);
}

/// Against as many halvings as there are fraction bits, each of which is exact.
TYPED_TEST(FixedTest, DoublesAreTheRawValueHalvedBitByBit) {
  using S = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const S a = sample<S>();
    double expected = static_cast<double>(a.raw());
    for (int bit = 0; bit < S::kFracBits; ++bit) expected *= 0.5;
    ASSERT_EQ(isostep::to_double(a), expected) << a.raw();
  }
}

/// Against as many doublings, and the library's rounding of ties away from zero.
TYPED_TEST(FixedTest, DoublesOfAnySizeRoundToTheNearestRawValue) {
  using S = TypeParam;
  const double end = S::kBits == 32 ? 0x1p31 : 0x1p63;
  for (int i = 0; i < kRounds; ++i) {
    const auto digits = static_cast<double>(static_cast<std::int64_t>(random_word()));
    const double value = std::ldexp(digits, -static_cast<int>(random_word() % 130));
    double scaled = value;
    for (int bit = 0; bit < S::kFracBits; ++bit) scaled *= 2;
    const S expected = scaled >= end - 0.5 ? S::highest()
                       : scaled <= -end    ? S::lowest()
                                           : S::from_raw(static_cast<typename S::Raw>(std::llround(scaled)));
    ASSERT_EQ(isostep::from_double<S>(value), expected) << value;
  }
}

TEST(FixedConversion, FinerFormatsHoldCoarserNumbersExactly) {
  EXPECT_EQ(isostep::convert<Unit<Q16_16>>(Q16_16(-1.25)), Unit<Q16_16>(-1.25));
  EXPECT_EQ(isostep::convert<Unit<Q32_32>>(Q32_32(0.75)), Unit<Q32_32>(0.75));
  EXPECT_EQ(isostep::convert<Q32_32>(Q32_32(0.3)), Q32_32(0.3));
}

TEST(FixedConversion, CoarserFormatsRoundToNearest) {
  using U = Unit<Q16_16>;  // one step of Q16.16 is 2^14 steps of Q2.30
  EXPECT_EQ(isostep::convert<Q16_16>(U::from_raw((1 << 13) - 1)).raw(), 0);
  EXPECT_EQ(isostep::convert<Q16_16>(U::from_raw(1 << 13)).raw(), 1);
  EXPECT_EQ(isostep::convert<Q16_16>(U::from_raw(-(1 << 13))).raw(), 0);
  EXPECT_EQ(isostep::convert<Q16_16>(U::from_raw(-(1 << 13) - 1)).raw(), -1);
  EXPECT_EQ(isostep::convert<Q32_32>(Unit<Q32_32>::highest()), Q32_32(2));
}

TEST(FixedConversion, QuotientsOfTwoFormatsTakeTheFormatAskedFor) {
  EXPECT_EQ(isostep::divide_to<Unit<Q16_16>>(Q16_16(1), Q16_16(3)).raw(), 357913941);            // 2^30 / 3
  EXPECT_EQ(isostep::divide_to<Unit<Q32_32>>(Q32_32(2), Q32_32(3)).raw(), 3074457345618258603);  // 2^63 / 3
  EXPECT_EQ(isostep::divide_to<Q16_16>(Q16_16(1), Unit<Q16_16>(0.5)), Q16_16(2));
  EXPECT_EQ(isostep::divide_to<Unit<Q32_32>>(Q32_32(5), Q32_32(2)), Unit<Q32_32>::highest());
}

TEST(FixedNames, TellFormatsApart) {
  EXPECT_EQ(std::string(isostep::ScalarTraits<Q16_16>::kName), "q16.16");
  EXPECT_EQ(std::string(isostep::ScalarTraits<Q32_32>::kName), "q32.32");
  EXPECT_EQ(std::string(isostep::ScalarTraits<Fixed<std::int64_t, 62>>::kName), "q2.62");
  EXPECT_NE(isostep::ScalarTraits<Q16_16>::kId, isostep::ScalarTraits<Q32_32>::kId);
  EXPECT_NE(isostep::ScalarTraits<float>::kId, isostep::ScalarTraits<double>::kId);
  EXPECT_EQ(isostep::ScalarTraits<Q32_32>::kId, 0x024020u);
}

template <class S> class TrappingDeathTest : public testing::Test {};
using TrappingFormats = testing::Types<Trapping32, Trapping64>;
TYPED_TEST_SUITE(TrappingDeathTest, TrappingFormats);

template <class S> void use(S a) {
  volatile auto kept = a.raw();
  static_cast<void>(kept);
}

TYPED_TEST(TrappingDeathTest, WhatFitsIsTheOrdinaryAnswer) {
  using S = TypeParam;
  EXPECT_EQ(S::highest() + S::lowest(), S::from_raw(-1));
  EXPECT_EQ(S(3) * S(-5), S(-15));
  EXPECT_EQ(S(1) / S::from_raw(0), S::highest());
  EXPECT_EQ(isostep::round_to<S>(product(S(3), S(4)) - product(S(2), S(6))), S(0));
}

TYPED_TEST(TrappingDeathTest, WhatDoesNotFitStopsTheProgram) {
  using S = TypeParam;
  constexpr int kWholeBits = S::kBits - S::kFracBits;
  EXPECT_DEATH(use(S::highest() + S::from_raw(1)), "");
  EXPECT_DEATH(use(S::lowest() - S::from_raw(1)), "");
  EXPECT_DEATH(use(-S::lowest()), "");
  EXPECT_DEATH(use(S::highest() * S(2)), "");
  EXPECT_DEATH(use(S(std::int64_t{1} << (kWholeBits - 1))), "");
  EXPECT_DEATH(use(isostep::convert<Unit<S>>(S(2))), "");
}

TYPED_TEST(TrappingDeathTest, AnExactSumThatDoesNotFitStopsTheProgram) {
  using S = TypeParam;
  const auto square = product(S::lowest(), S::lowest());  // a quarter of the wide integer's range
  EXPECT_DEATH(use(isostep::round_to<S>(square + square - square - square)), "");
  EXPECT_DEATH(use(isostep::round_to<S>(-square - square - square)), "");
  EXPECT_EQ(isostep::round_to<S>(square - square), S(0));
}

}  // namespace fixed_test
