// Decimal text of scalars: round trips, shortest form, one correct rounding, and what is refused.
// SPDX-License-Identifier: MIT
#include <clocale>
#include <string>

#include "unit/scalar/text_oracle.hpp"

namespace isostep::test {
namespace text_test {

template <class S> class Text : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32, Unit<Q16_16>, Unit<Q32_32>, Step<Q16_16>, Step<Q32_32>,
                               Fixed<std::int32_t, 1>, Fixed<std::int64_t, 40, Overflow::trap>>;
TYPED_TEST_SUITE(Text, Scalars);

TYPED_TEST(Text, WrittenNumbersReadBackBitForBit) {
  using S = TypeParam;
  Bits random(1);
  for (int i = 0; i < 40000; ++i) {
    const std::uint64_t word = random.next() >> (i % static_cast<int>(sizeof(S) * 8));
    const S value = from_bits<S>(static_cast<RawBits<S>>(word));
    if (!is_finite(value)) continue;
    const std::string text = to_text(value);
    ASSERT_EQ(to_bits(read<S>(text)), to_bits(value)) << text;
  }
}

TYPED_TEST(Text, NoShorterDecimalReadsBack) {
  using S = TypeParam;
  Bits random(2);
  for (int i = 0; i < 4000; ++i) {
    const std::uint64_t word = random.next() >> (i % static_cast<int>(sizeof(S) * 8));
    const S value = from_bits<S>(static_cast<RawBits<S>>(word));
    const std::string text = to_text(value);
    const std::size_t point = text.find('.');
    if (!is_finite(value) || point == std::string::npos) continue;
    // Both decimals with one digit less behind the point that enclose the text.
    const std::size_t end = std::min(text.find('e'), text.size());
    const std::string tail = text.substr(end);
    std::string low = text.substr(0, end - 1);
    if (low.back() == '.') low.pop_back();
    ASSERT_NE(to_bits(read<S>(low + tail)), to_bits(value)) << text;
    std::string high = low;
    std::size_t at = high.size();
    for (bool carry = true; carry && at > 0;) {
      char& c = high[--at];
      if (c < '0' || c > '9') continue;
      carry = c == '9';
      c = carry ? '0' : static_cast<char>(c + 1);
      if (carry && (at == 0 || high[at - 1] == '-')) {
        high.insert(at, "1");
        carry = false;
      }
    }
    S other = S(0);
    TextError error = TextError::none;
    if (from_text(high + tail, other, error)) {
      ASSERT_NE(to_bits(other), to_bits(value)) << text;
    }
  }
}

TYPED_TEST(Text, RefusesWhatIsNotOneJsonNumber) {
  using S = TypeParam;
  for (const char* text : {"",     " ",     "-",     "+1",    "01",           "-01", "00",  ".5",   "1.",   "1.e1",
                           "1e",   "1e+",   "1e-",   "e1",    " 1",           "1 ",  "1x",  "0x10", "--1",  "1-",
                           "1..0", "1.0.0", "1,0",   "1e1.0", "1e5e5",        "nan", "NaN", "inf",  "-inf", "Infinity",
                           "true", "\"1\"", "1_000", "1'0",   "\xef\xbc\x91", "-.5", "1e 5"}) {
    EXPECT_EQ(error_of<S>(text), TextError::not_a_number) << text;
  }
  EXPECT_EQ(error_of<S>(std::string_view("1\0", 2)), TextError::not_a_number);
}

TYPED_TEST(Text, AcceptsEveryFormOfTheGrammar) {
  using S = TypeParam;
  const RawBits<S> half = to_bits(S(0.5));
  for (const char* text :
       {"0.5", "5e-1", "5E-1", "0.5e0", "0.5e+0", "0.5e-0", "0.05e1", "500e-3", "0.500000", "50.0E-2",
        "0.0000000000000000000000000000000000000000000000000000000000000000000000000000005e78",
        "5000000000000000000000000000000000000000000000000000000000000000000000000000000e-79",
        "0.5e-00000000000000000000000000000000000"}) {
    EXPECT_EQ(to_bits(read<S>(text)), half) << text;
  }
  for (const char* text : {"0", "0.0", "0e0", "0e99999999999999999999", "0.000e-99999999999999999999", "1e-99999999999",
                           "1e-400", "123456789e-99999999999999999999999999"}) {
    EXPECT_EQ(to_bits(read<S>(text)), RawBits<S>{0}) << text;
  }
}

TYPED_TEST(Text, RefusesWhatDoesNotFit) {
  using S = TypeParam;
  for (const char* text : {"1e400", "-1e400", "1e99999999999999999999999", "1e309", "2e308", "123456789e999999999"}) {
    EXPECT_EQ(error_of<S>(text), TextError::out_of_range) << text;
  }
  EXPECT_EQ(error_of<S>(std::string(400, '9')), TextError::out_of_range);
}

TYPED_TEST(Text, DoesNotSeeTheLocale) {
  using S = TypeParam;
  // A locale with a decimal comma may not be installed; then this is the plain case once more.
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(to_text(S(0.5)), "0.5");
  EXPECT_EQ(to_bits(read<S>("0.5")), to_bits(S(0.5)));
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace text_test
}  // namespace isostep::test
