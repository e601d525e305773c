// The portable 128-bit integers give the answers of the compiler's own.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/wide_int.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "random/splitmix64.hpp"

namespace wide_int_test {

using isostep::divide;
using isostep::divide_portable;
using isostep::Division;
using isostep::multiply;
using isostep::multiply_portable;
using isostep::PortableInt128;
using isostep::UInt128Parts;

constexpr std::uint64_t kTop = std::uint64_t{1} << 63;
constexpr std::uint64_t kAllOnes = ~std::uint64_t{0};

static_assert(multiply_portable(kAllOnes, kAllOnes).high == kAllOnes - 1);
static_assert(multiply_portable(kAllOnes, kAllOnes).low == 1);
static_assert(multiply_portable(std::uint64_t{1} << 32, std::uint64_t{1} << 32).high == 1);
static_assert(divide_portable({1, 0}, 2).quotient == kTop);
static_assert(PortableInt128(-1).high() == kAllOnes && PortableInt128(-1).low() == kAllOnes);
static_assert((PortableInt128(-1) >> 127) == PortableInt128(-1));
static_assert((PortableInt128(1) << 127) < PortableInt128(0));
static_assert(PortableInt128(3) * PortableInt128(-5) == PortableInt128(-15));
static_assert(isostep::wrapping_add(std::numeric_limits<std::int64_t>::max(), std::int64_t{1}) ==
              std::numeric_limits<std::int64_t>::min());
static_assert(isostep::wrapping_subtract(std::numeric_limits<std::int64_t>::min(), std::int64_t{1}) ==
              std::numeric_limits<std::int64_t>::max());

TEST(WideInt, DivisionKeepsNumeratorEqualToQuotientTimesDivisorPlusRemainder) {
  const std::uint64_t words[] = {0, 1, 2, 3, 0xffffffffu, std::uint64_t{1} << 32, kTop - 1, kTop, kTop + 1, kAllOnes};
  for (std::uint64_t divisor : words) {
    for (std::uint64_t high : words) {
      if (high >= divisor) continue;
      for (std::uint64_t low : words) {
        const Division d = divide_portable({high, low}, divisor);
        EXPECT_LT(d.remainder, divisor);
        const UInt128Parts p = multiply_portable(d.quotient, divisor);
        EXPECT_EQ(PortableInt128(p.high, p.low) + PortableInt128(0, d.remainder), PortableInt128(high, low));
        const Division native = divide({high, low}, divisor);
        EXPECT_EQ(native.quotient, d.quotient);
        EXPECT_EQ(native.remainder, d.remainder);
      }
    }
  }
}

#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 Native;
__extension__ typedef unsigned __int128 UnsignedNative;

std::uint64_t random_state = 1;
std::uint64_t random_word() { return isostep::test::splitmix64(random_state); }
/// Words of every length, and those next to powers of two where carries are born.
std::uint64_t sample_word() {
  const std::uint64_t kind = random_word() % 4;
  const int shift = static_cast<int>(random_word() % 64);
  if (kind == 0) return (std::uint64_t{1} << shift) + random_word() % 3 - 1;
  if (kind == 1) return ~(std::uint64_t{1} << shift);
  return random_word() >> shift;
}

UnsignedNative native(std::uint64_t high, std::uint64_t low) { return (static_cast<UnsignedNative>(high) << 64) | low; }
UnsignedNative native(PortableInt128 a) { return native(a.high(), a.low()); }
UnsignedNative native(UInt128Parts a) { return native(a.high, a.low); }

constexpr int kRounds = 1000000;

TEST(WideInt, ProductsOfWordsAreExact) {
  for (int i = 0; i < kRounds; ++i) {
    const std::uint64_t a = sample_word();
    const std::uint64_t b = sample_word();
    const UnsignedNative expected = static_cast<UnsignedNative>(a) * b;
    ASSERT_TRUE(native(multiply_portable(a, b)) == expected) << a << " * " << b;
    ASSERT_TRUE(native(multiply(a, b)) == expected) << a << " * " << b;
  }
}

TEST(WideInt, QuotientsOfDoubleWordsAreExact) {
  for (int i = 0; i < kRounds; ++i) {
    const std::uint64_t divisor = sample_word() | (i % 2 == 0 ? kTop : 1u);
    const UInt128Parts numerator = {sample_word() % divisor, sample_word()};
    const auto quotient = static_cast<std::uint64_t>(native(numerator) / divisor);
    const auto remainder = static_cast<std::uint64_t>(native(numerator) % divisor);
    const Division portable = divide_portable(numerator, divisor);
    ASSERT_EQ(portable.quotient, quotient) << numerator.high << ", " << numerator.low << " / " << divisor;
    ASSERT_EQ(portable.remainder, remainder) << numerator.high << ", " << numerator.low << " / " << divisor;
    const Division fast = divide(numerator, divisor);
    ASSERT_EQ(fast.quotient, quotient) << numerator.high << ", " << numerator.low << " / " << divisor;
    ASSERT_EQ(fast.remainder, remainder) << numerator.high << ", " << numerator.low << " / " << divisor;
  }
}

TEST(WideInt, PortableArithmeticWrapsLikeTheCompilers) {
  for (int i = 0; i < kRounds; ++i) {
    const PortableInt128 a(sample_word(), sample_word());
    const PortableInt128 b(random_word() % 4 == 0 ? a.high() : sample_word(), sample_word());
    const UnsignedNative x = native(a);
    const UnsignedNative y = native(b);
    const int n = static_cast<int>(random_word() % 128);
    ASSERT_TRUE(native(a + b) == x + y);
    ASSERT_TRUE(native(a - b) == x - y);
    ASSERT_TRUE(native(-a) == 0 - x);
    ASSERT_TRUE(native(a * b) == x * y);
    ASSERT_TRUE(native(a << n) == x << n) << n;
    ASSERT_TRUE(native(a >> n) == static_cast<UnsignedNative>(static_cast<Native>(x) >> n)) << n;
    ASSERT_EQ(a == b, x == y);
    ASSERT_EQ(a < b, static_cast<Native>(x) < static_cast<Native>(y));
    ASSERT_EQ(a > b, static_cast<Native>(x) > static_cast<Native>(y));
    ASSERT_EQ(a <= b, static_cast<Native>(x) <= static_cast<Native>(y));
    ASSERT_EQ(a >= b, static_cast<Native>(x) >= static_cast<Native>(y));
    ASSERT_EQ(static_cast<std::int64_t>(a), static_cast<std::int64_t>(x));
    ASSERT_TRUE(native(PortableInt128(static_cast<std::int64_t>(a.low()))) ==
                static_cast<UnsignedNative>(static_cast<Native>(static_cast<std::int64_t>(a.low()))));
    ASSERT_TRUE(native(isostep::parts(isostep::int128_from({a.high(), a.low()}))) == x);
    const auto sum =
        isostep::wrapping_add(isostep::int128_from({a.high(), a.low()}), isostep::int128_from({b.high(), b.low()}));
    ASSERT_TRUE(native(isostep::parts(sum)) == x + y);
  }
}
#endif

}  // namespace wide_int_test
