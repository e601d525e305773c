// LEB128: each number has one form, the shortest; what is cut, longer or too large is told apart.
// SPDX-License-Identifier: MIT
#include "isostep/core/bytes.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "random/splitmix64.hpp"

namespace isostep {
namespace bytes_test {

constexpr std::uint64_t kMost = ~std::uint64_t{0};

std::vector<std::uint8_t> stored(std::uint64_t value) {
  std::uint8_t bytes[kLongestLeb128];
  return {bytes, store_leb128(bytes, value)};
}
Leb128Flaw flaw_of(const std::vector<std::uint8_t>& bytes, std::uint64_t most) {
  const Leb128 read = load_leb128(bytes, most);
  EXPECT_TRUE(read.flaw == Leb128Flaw::none || (read.value == 0 && read.size == 0));
  return read.flaw;
}

TEST(Leb128, numbers_of_every_width_come_back_and_their_beginnings_are_cut) {
  std::uint64_t state = 3;
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t word = test::splitmix64(state), value = word >> (i % 64);
    const std::vector<std::uint8_t> bytes = stored(value);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      ASSERT_EQ(flaw_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}, kMost), Leb128Flaw::cut);
    const Leb128 read = load_leb128(bytes, kMost);
    ASSERT_EQ(read.flaw, Leb128Flaw::none);
    ASSERT_EQ(read.value, value);
    ASSERT_EQ(read.size, bytes.size());
    ASSERT_EQ(load_leb128(bytes, value).value, value);
    if (value > 0) {
      ASSERT_EQ(flaw_of(bytes, value - 1), Leb128Flaw::too_large);
    }
  }
  EXPECT_EQ(stored(kMost).size(), kLongestLeb128);
  EXPECT_EQ(stored(127).size(), 1u);
  EXPECT_EQ(stored(128).size(), 2u);
}

TEST(Leb128, what_is_longer_than_it_needs_is_overlong_and_what_64_bits_do_not_hold_too_large) {
  std::uint64_t state = 5;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes = stored(test::splitmix64(state) >> (8 + i % 56));
    for (bytes.back() |= 128u; bytes.size() + 1 < kLongestLeb128; bytes.push_back(128)) {
      std::vector<std::uint8_t> padded = bytes;
      padded.push_back(0);
      ASSERT_EQ(flaw_of(padded, kMost), Leb128Flaw::overlong);
    }
  }
  std::vector<std::uint8_t> bytes(kLongestLeb128 - 1, 0xff);
  bytes.push_back(1);
  EXPECT_EQ(flaw_of(bytes, kMost), Leb128Flaw::none);
  bytes.back() = 2;
  EXPECT_EQ(flaw_of(bytes, kMost), Leb128Flaw::too_large);
  bytes.back() = 0x81;
  EXPECT_EQ(flaw_of(bytes, kMost), Leb128Flaw::too_large);
  bytes.push_back(0);
  EXPECT_EQ(flaw_of(bytes, kMost), Leb128Flaw::too_large);
}

}  // namespace bytes_test
}  // namespace isostep
