// Decimal text of scalars: round trips, shortest form, one correct rounding, and what is refused.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/text.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <clocale>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "random/splitmix64.hpp"

namespace isostep {
namespace {

class Bits {  // splitmix64
 public:
  explicit Bits(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() { return test::splitmix64(state_); }

 private:
  std::uint64_t state_;
};

template <class S> S read(std::string_view text) {
  S value = S(77);
  TextError error = TextError::none;
  EXPECT_TRUE(from_text(text, value, error)) << text << ": " << describe(error);
  return value;
}
template <class S> TextError error_of(std::string_view text) {
  S value = S(77);
  TextError error = TextError::none;
  const bool read = from_text(text, value, error);
  EXPECT_EQ(read, error == TextError::none) << text;
  if (error != TextError::none) {
    EXPECT_EQ(to_bits(value), to_bits(S(77))) << "out must keep its value: " << text;
  }
  return error;
}

// Decimals as text, by schoolbook: the oracle shares nothing with the code under test.
std::string halved(const std::string& decimal) {  // of a decimal with a point
  std::string result;
  int remainder = 0;
  for (const char c : decimal) {
    if (c == '.') {
      result += '.';
      continue;
    }
    const int value = remainder * 10 + (c - '0');
    result += static_cast<char>('0' + value / 2);
    remainder = value % 2;
  }
  if (remainder != 0) result += '5';
  return result;
}
std::string doubled(std::string digits) {  // of whole digits
  int carry = 0;
  for (std::size_t i = digits.size(); i-- > 0;) {
    const int value = (digits[i] - '0') * 2 + carry;
    digits[i] = static_cast<char>('0' + value % 10);
    carry = value / 10;
  }
  return carry != 0 ? '1' + digits : digits;
}
/// odd / 2^places, exactly; every digit written.
std::string exact_decimal(std::uint64_t numerator, int places) {
  std::string text = std::to_string(numerator) + '.';
  for (int i = 0; i < places; ++i) text = halved(text);
  if (text.back() == '.') text += '0';
  const std::size_t start = text.find_first_not_of('0');
  return text[start] == '.' ? text.substr(start - 1) : text.substr(start);
}
/// The greatest decimal of that many digits below `decimal`, which ends in a digit that is not zero.
std::string just_below(std::string decimal) {
  --decimal.back();
  return decimal + std::string(40, '9');
}
std::string just_above(const std::string& decimal) { return decimal + std::string(40, '0') + '1'; }

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

template <class S> class FixedText : public testing::Test {};
using FixedScalars = testing::Types<Q16_16, Q32_32, Unit<Q16_16>, Unit<Q32_32>, Step<Q16_16>, Step<Q32_32>,
                                    Fixed<std::int32_t, 1>, Fixed<std::int64_t, 1>, Fixed<std::int64_t, 40>>;
TYPED_TEST_SUITE(FixedText, FixedScalars);

TYPED_TEST(FixedText, RoundsToNearestWithTiesAwayFromZero) {
  using S = TypeParam;
  using Raw = typename S::Raw;
  Bits random(3);
  for (int i = 0; i < 3000; ++i) {
    // raw + 1/2 for a raw whose successor still fits
    const std::uint64_t raw = (random.next() >> 1 >> (64 - S::kBits) >> (i % (S::kBits - 2))) & ~std::uint64_t{1};
    const std::string tie = exact_decimal(2 * raw + 1, S::kFracBits + 1);
    const auto low = static_cast<Raw>(raw), high = static_cast<Raw>(raw + 1);
    ASSERT_EQ(read<S>(tie).raw(), high) << tie;
    ASSERT_EQ(read<S>('-' + tie).raw(), -high) << tie;
    ASSERT_EQ(read<S>(just_below(tie)).raw(), low) << tie;
    ASSERT_EQ(read<S>('-' + just_below(tie)).raw(), -low) << tie;
    ASSERT_EQ(read<S>(just_above(tie)).raw(), high) << tie;
    const std::string exact = exact_decimal(raw, S::kFracBits);
    ASSERT_EQ(read<S>(exact).raw(), low) << exact;
  }
}

TYPED_TEST(FixedText, TheEndsOfTheRangeAreExact) {
  using S = TypeParam;
  const std::uint64_t top = detail::magnitude(S::highest().raw());
  const std::string highest = exact_decimal(top, S::kFracBits);
  const std::string tie = exact_decimal(2 * top + 1, S::kFracBits + 1);  // nearest would be one past the end
  const std::string end = exact_decimal(top + 1, S::kFracBits);
  EXPECT_EQ(read<S>(highest), S::highest());
  EXPECT_EQ(read<S>(just_below(tie)), S::highest());
  EXPECT_EQ(error_of<S>(tie), TextError::out_of_range);
  EXPECT_EQ(error_of<S>(end), TextError::out_of_range);
  EXPECT_EQ(read<S>('-' + end), S::lowest());
  const std::string beyond = end + (end.find('.') == std::string::npos ? ".0" : "") + std::string(80, '0') + "1";
  EXPECT_EQ(read<S>('-' + beyond), S::lowest());
  EXPECT_EQ(read<S>(to_text(S::highest())), S::highest());
  EXPECT_EQ(read<S>(to_text(S::lowest())), S::lowest());
}

TYPED_TEST(FixedText, WritesTheNearestOfTheShortest) {
  // The digits after the point are the fewest, and no decimal of as many lies nearer: within half of the last place
  // unless the nearer one reads back as a neighbour.
  using S = TypeParam;
  Bits random(4);
  for (int i = 0; i < 4000; ++i) {
    const std::uint64_t raw = random.next() >> 1 >> (64 - S::kBits) >> (i % (S::kBits - 2));
    const S value = S::from_raw(static_cast<typename S::Raw>(raw));
    const std::string text = to_text(value);
    const std::size_t point = text.find('.');
    if (point == std::string::npos) continue;
    const std::string exact = exact_decimal(raw, S::kFracBits);
    const std::size_t exact_point = exact.find('.');
    ASSERT_NE(exact_point, std::string::npos) << text;
    const std::size_t places = text.size() - point - 1;
    const std::string cut = exact.substr(0, exact_point + 1 + places);  // exact >= cut
    const char next = exact.size() > cut.size() ? exact[cut.size()] : '0';
    const bool down = text == cut;
    const bool nearer_down = next < '5' || (next == '5' && exact.size() == cut.size() + 1);
    if (down != nearer_down && exact.size() != cut.size() + 1) {
      if (!down) {
        ASSERT_NE(read<S>(cut), value) << exact;
      } else {
        // The decimal above, by adding one last place to cut.
        const S above = read<S>(cut + std::string(1, '9') + "99999999999999999999999");
        ASSERT_NE(above, value) << exact;
      }
    }
  }
}

TEST(FixedText, LiteralsAndTextAgree) {
#define CHECK_LITERAL(S, number)                            \
  EXPECT_EQ(read<S>(#number), S(number)) << #S " " #number; \
  EXPECT_EQ(read<S>("-" #number), S(-number)) << #S " -" #number
#define CHECK_ALL(number)        \
  CHECK_LITERAL(Q16_16, number); \
  CHECK_LITERAL(Q32_32, number); \
  CHECK_LITERAL(Unit<Q16_16>, number)
  CHECK_ALL(0.1);
  CHECK_ALL(0.2);
  CHECK_ALL(0.3);
  CHECK_ALL(0.7);
  CHECK_ALL(0.9);
  CHECK_ALL(0.01);
  CHECK_ALL(0.02);
  CHECK_ALL(0.005);
  CHECK_ALL(0.001);
  CHECK_ALL(0.0001);
  CHECK_ALL(0.00001);
  CHECK_ALL(0.05);
  CHECK_ALL(0.25);
  CHECK_ALL(0.5);
  CHECK_ALL(0.75);
  CHECK_ALL(0.125);
  CHECK_ALL(0.33333333);
  CHECK_ALL(0.66666667);
  CHECK_ALL(1.1);
  CHECK_ALL(1.5);
  CHECK_ALL(1.9);
  CHECK_ALL(1.41421356);
  CHECK_ALL(1.0);
  CHECK_ALL(0.70710678);
  CHECK_ALL(0.57735027);
  CHECK_ALL(1.61803398);
  CHECK_ALL(0.000030517578125);
  CHECK_ALL(0.0000152587890625);
  CHECK_ALL(1e-3);
  CHECK_ALL(0.00000762939453125);  // half a raw unit of Q16.16: a tie
  CHECK_LITERAL(Q16_16, 9.81);
  CHECK_LITERAL(Q32_32, 9.81);
  CHECK_LITERAL(Q16_16, 3.14159265);
  CHECK_LITERAL(Q32_32, 3.14159265);
  CHECK_LITERAL(Q16_16, 1000.3);
  CHECK_LITERAL(Q32_32, 1000.3);
  CHECK_LITERAL(Q16_16, 32767.9);
  CHECK_LITERAL(Q32_32, 32767.9);
  CHECK_LITERAL(Q32_32, 1e6);
  CHECK_LITERAL(Q32_32, 123456.789);
  CHECK_LITERAL(Q16_16, 6.67e-5);
  CHECK_LITERAL(Q32_32, 6.67e-5);
#undef CHECK_ALL
#undef CHECK_LITERAL
}

TEST(FixedText, WritesWhatPeopleWrite) {
  EXPECT_EQ(to_text(Q16_16(0)), "0");
  EXPECT_EQ(to_text(Q16_16(-3)), "-3");
  EXPECT_EQ(to_text(Q16_16(0.1)), "0.1");
  EXPECT_EQ(to_text(Q16_16(-9.81)), "-9.81");
  EXPECT_EQ(to_text(Q32_32(9.81)), "9.81");
  EXPECT_EQ(to_text(Q32_32(0.0001)), "0.0001");
  EXPECT_EQ(to_text(Q16_16::from_raw(1)), "0.00002");  // 1.5e-5; half a unit either way
  EXPECT_EQ(to_text(Q16_16::from_raw(-1)), "-0.00002");
  EXPECT_EQ(to_text(Q16_16::lowest()), "-32768");
  EXPECT_EQ(to_text(Fixed<std::int32_t, 1>(0.5)), "0.5");
  EXPECT_EQ(to_text(Unit<Q32_32>::from_raw(1)), "0.0000000000000000002");
}

TEST(FixedText, StreamsObeyWidth) {
  std::ostringstream out;
  out.width(8);
  out << Q16_16(0.25) << ' ' << Q32_32(-1);
  EXPECT_EQ(out.str(), "    0.25 -1");
}

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

}  // namespace
}  // namespace isostep
