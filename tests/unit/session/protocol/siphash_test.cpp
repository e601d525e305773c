// SipHash-2-4 against the vectors of its authors.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/siphash.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace isostep {
namespace siphash_test {

/// The key of the paper: the bytes 0, 1, ... 15.
constexpr SipKey kKey = {0x0706050403020100u, 0x0f0e0d0c0b0a0908u};
constexpr std::uint64_t of_first_bytes(std::size_t size) {
  std::uint8_t message[64] = {};
  for (std::size_t i = 0; i < size; ++i) message[i] = static_cast<std::uint8_t>(i);
  return siphash_2_4(kKey, {message, size});
}
static_assert(of_first_bytes(15) == 0xa129ca6149be45e5u, "appendix A");

TEST(SipHash, GivesTheValuesOfItsReferenceImplementation) {
  // vectors_sip64 of https://github.com/veorq/SipHash: of no byte, of an unfinished, a whole and a begun second word.
  const struct {
    std::size_t size;
    std::uint64_t value;
  } vectors[] = {{0, 0x726fdb47dd0e0e31u},  {1, 0x74f839c593dc67fdu}, {7, 0xab0200f58b01d137u},
                 {8, 0x93f5f5799a932462u},  {9, 0x9e0082df0ba9e4b0u}, {15, 0xa129ca6149be45e5u},
                 {16, 0x3f2acc7f57c29bdbu}, {63, 0x958a324ceb064572u}};
  for (const auto& vector : vectors) EXPECT_EQ(of_first_bytes(vector.size), vector.value) << vector.size;
}

TEST(SipHash, ChangesInHalfOfItsBitsWithEveryBitOfTheKey) {
  const std::uint8_t message[16] = {1};
  for (int bit = 0; bit < 128; ++bit) {
    SipKey other = kKey;
    (bit < 64 ? other.low : other.high) ^= std::uint64_t{1} << bit % 64;
    const int changed = std::popcount(siphash_2_4(kKey, message) ^ siphash_2_4(other, message));
    EXPECT_GE(changed, 14) << bit;  // 32 and 4.5 of 4 standard deviations
    EXPECT_LE(changed, 50) << bit;
  }
}

}  // namespace siphash_test
}  // namespace isostep
