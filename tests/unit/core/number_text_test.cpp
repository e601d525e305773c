// Whole numbers in words: digits and nothing else.
// SPDX-License-Identifier: MIT
#include "isostep/core/number_text.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace number_text_test {

TEST(NumberText, ReadsDigits) {
  const struct {
    const char* text;
    std::uint64_t number;
  } rows[] = {{"0", 0}, {"7", 7}, {"0042", 42}, {"18446744073709551609", 18446744073709551609u}};
  for (const auto& row : rows) {
    std::uint64_t number = 1;
    EXPECT_TRUE(read_number(row.text, number)) << row.text;
    EXPECT_EQ(number, row.number);
  }
}
TEST(NumberText, RefusesAnythingElse) {
  std::uint64_t number = 0;
  for (const char* text : {"", "-1", "+1", " 1", "1 ", "1x", "0x1", "1.0", "18446744073709551616",
                           "99999999999999999999", "184467440737095516100"})
    EXPECT_FALSE(read_number(text, number)) << text;
}

}  // namespace number_text_test
}  // namespace isostep
