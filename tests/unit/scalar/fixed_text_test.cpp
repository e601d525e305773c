// Decimal text of fixed point: nearest, shortest, to the ends of the range.
// SPDX-License-Identifier: MIT

#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include "unit/scalar/text_oracle.hpp"

namespace isostep::test {
namespace fixed_text_test {

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

}  // namespace fixed_text_test
}  // namespace isostep::test
