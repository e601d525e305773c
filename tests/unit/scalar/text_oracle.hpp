// The reader of the tests of decimal text, and exact decimals.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "isostep/scalar/text.hpp"
#include "random/splitmix64.hpp"

namespace isostep::test {

class Bits {  // splitmix64
 public:
  explicit Bits(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() { return splitmix64(state_); }

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
inline std::string halved(const std::string& decimal) {  // of a decimal with a point
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
inline std::string doubled(std::string digits) {  // of whole digits
  int carry = 0;
  for (std::size_t i = digits.size(); i-- > 0;) {
    const int value = (digits[i] - '0') * 2 + carry;
    digits[i] = static_cast<char>('0' + value % 10);
    carry = value / 10;
  }
  return carry != 0 ? '1' + digits : digits;
}
/// odd / 2^places, exactly; every digit written.
inline std::string exact_decimal(std::uint64_t numerator, int places) {
  std::string text = std::to_string(numerator) + '.';
  for (int i = 0; i < places; ++i) text = halved(text);
  if (text.back() == '.') text += '0';
  const std::size_t start = text.find_first_not_of('0');
  return text[start] == '.' ? text.substr(start - 1) : text.substr(start);
}
/// The greatest decimal of that many digits below `decimal`, which ends in a digit that is not zero.
inline std::string just_below(std::string decimal) {
  --decimal.back();
  return decimal + std::string(40, '9');
}
inline std::string just_above(const std::string& decimal) { return decimal + std::string(40, '0') + '1'; }

}  // namespace isostep::test
