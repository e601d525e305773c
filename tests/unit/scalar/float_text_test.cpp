// Decimal text of floats: nearest even, to the ends of the range, as the standard library has it.
// SPDX-License-Identifier: MIT

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

#include "unit/scalar/text_oracle.hpp"

namespace isostep::test {
namespace float_text_test {

template <class S> class FloatText : public testing::Test {};
using FloatScalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FloatText, FloatScalars);

TYPED_TEST(FloatText, TiesGoToEven) {
  using S = TypeParam;
  constexpr int stored = std::numeric_limits<S>::digits - 1;
  Bits random(5);
  for (int i = 0; i < 2000; ++i) {
    // significand s with the hidden bit, times 2^(shift - stored); halfway to the next is (2 s + 1) / 2
    const std::uint64_t s = (std::uint64_t{1} << stored) | (random.next() & ((std::uint64_t{1} << stored) - 1));
    const int places = stored - 8 + i % 90;
    const std::string tie = exact_decimal(2 * s + 1, places + 1);
    if (tie.find('.') == std::string::npos) continue;
    S low = static_cast<S>(s);
    for (int k = 0; k < places; ++k) low *= S(0.5);
    const RawBits<S> bits = to_bits(low);
    ASSERT_EQ(to_bits(read<S>(tie)), bits + (bits & 1u)) << tie;
    ASSERT_EQ(to_bits(read<S>(just_below(tie))), bits) << tie;
    ASSERT_EQ(to_bits(read<S>(just_above(tie))), bits + 1) << tie;
    ASSERT_EQ(to_bits(read<S>(tie + std::string(2000, '0') + '1')), bits + 1) << "a digit beyond every buffer counts";
  }
}

TYPED_TEST(FloatText, TheSmallestSubnormalEndsAtItsTie) {
  using S = TypeParam;
  const int places = std::numeric_limits<S>::digits - std::numeric_limits<S>::min_exponent;
  const std::string tie = exact_decimal(1, places + 1);
  EXPECT_EQ(to_bits(read<S>(tie)), 0u);
  EXPECT_EQ(to_bits(read<S>(just_below(tie))), 0u);
  EXPECT_EQ(to_bits(read<S>(just_above(tie))), 1u);
  const std::string odd = exact_decimal(3, places + 1);  // between the first and the second
  EXPECT_EQ(to_bits(read<S>(odd)), 2u);
  EXPECT_EQ(to_bits(read<S>(just_below(odd))), 1u);
}

TYPED_TEST(FloatText, TheLargestNumberEndsAtItsTie) {
  using S = TypeParam;
  // 2^max_exponent - 2^(max_exponent - digits - 1): what first rounds to infinity
  std::string power = "1", gap = "1";
  for (int i = 0; i < std::numeric_limits<S>::max_exponent; ++i) power = doubled(power);
  const int last = std::numeric_limits<S>::max_exponent - std::numeric_limits<S>::digits - 1;
  for (int i = 0; i < last; ++i) gap = doubled(gap);
  gap.insert(0, power.size() - gap.size(), '0');
  int borrow = 0;
  for (std::size_t i = power.size(); i-- > 0;) {
    const int value = power[i] - gap[i] - borrow;
    borrow = value < 0 ? 1 : 0;
    power[i] = static_cast<char>('0' + value + 10 * borrow);
  }
  EXPECT_EQ(error_of<S>(power), TextError::out_of_range);
  ASSERT_NE(power.back(), '0');
  --power.back();
  EXPECT_EQ(to_bits(read<S>(power + '.' + std::string(60, '9'))), to_bits(std::numeric_limits<S>::max()));
}

TYPED_TEST(FloatText, SpecialValuesAreNamedAndRefused) {
  using S = TypeParam;
  EXPECT_EQ(to_text(std::numeric_limits<S>::infinity()), "inf");
  EXPECT_EQ(to_text(-std::numeric_limits<S>::infinity()), "-inf");
  EXPECT_EQ(to_text(std::numeric_limits<S>::quiet_NaN()), "nan");
  EXPECT_EQ(to_text(S(-0.0)), "-0");
  EXPECT_EQ(to_bits(read<S>("-0")), to_bits(S(-0.0)));
  EXPECT_EQ(to_bits(read<S>("-1e-400")), to_bits(S(-0.0)));
}

TEST(FloatText, WritesWhatPeopleWrite) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(0.1f), "0.1");
  EXPECT_EQ(to_text(1e21), "1e21");
  EXPECT_EQ(to_text(123456789012345680000.0), "123456789012345680000");
  EXPECT_EQ(to_text(1e-7), "1e-7");
  EXPECT_EQ(to_text(0.000001), "0.000001");
  EXPECT_EQ(to_text(5e-324), "5e-324");
  EXPECT_EQ(to_text(-1.7976931348623157e308), "-1.7976931348623157e308");
  EXPECT_EQ(to_text(9007199254740993.0), "9007199254740992");
  EXPECT_EQ(to_text(16777216.0f), "16777216");
}

#if defined(__cpp_lib_to_chars)
TYPED_TEST(FloatText, AgreesWithTheStandardLibrary) {
  using S = TypeParam;
  Bits random(6);
  for (int i = 0; i < 100000; ++i) {
    // Every exponent, and significands of few bits as well: powers of two have a narrow gap below.
    std::uint64_t word = random.next();
    if (i % 4 == 0) word &= ~std::uint64_t{0} << (sizeof(S) == 4 ? 23 : 52);
    const S value = from_bits<S>(static_cast<RawBits<S>>(word));
    if (!is_finite(value)) continue;
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + 64, value, std::chars_format::scientific).ptr;
    const std::string expected(buffer, end);
    const std::string text = to_text(value);
    const auto digits = [](const std::string& t) {
      std::string d;
      for (const char c : t.substr(0, t.find('e'))) {
        if (c >= '1' || (c == '0' && !d.empty())) d += c;
      }
      while (!d.empty() && d.back() == '0') d.pop_back();
      return d;
    };
    ASSERT_EQ(digits(text), digits(expected)) << text << ' ' << expected;
    ASSERT_EQ(to_bits(read<S>(expected)), to_bits(value)) << expected;

    // A random decimal that nobody's printing chose.
    const std::string fraction = std::to_string(random.next());
    std::string decimal = std::to_string(random.next()) + '.' + fraction;
    decimal += 'e' + std::to_string(static_cast<int>(random.next() % 720) - 360);
    S ours = S(0), theirs = S(0);
    TextError error = TextError::none;
    const bool fits = from_text(decimal, ours, error);
    const auto parsed = std::from_chars(decimal.data(), decimal.data() + decimal.size(), theirs);
    if (parsed.ec == std::errc{}) {
      ASSERT_TRUE(fits) << decimal;
      ASSERT_EQ(to_bits(ours), to_bits(theirs)) << decimal;
    } else if (fits) {
      ASSERT_EQ(ours, S(0)) << "the standard library calls underflow an error: " << decimal;
    }
  }
}
#endif

}  // namespace float_text_test
}  // namespace isostep::test
