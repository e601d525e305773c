// Bitset against a std::set of the same numbers.
// SPDX-License-Identifier: MIT
#include "isostep/core/bitset.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "isostep/core/random.hpp"

namespace isostep {
namespace bitset_test {

std::vector<std::uint32_t> members(const Bitset& bits) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = bits.find_next(0); i != Bitset::kNone; i = bits.find_next(i + 1)) list.push_back(i);
  return list;
}

TEST(Bitset, RandomChangesLeaveTheMembersOfASet) {
  Bitset bits;
  std::set<std::uint32_t> expected;
  Pcg32 random = Pcg32::seeded(7);
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t at = random_below(random, 500);
    switch (random_below(random, 3)) {
      case 0:
        bits.set(at);
        expected.insert(at);
        break;
      case 1:
        bits.reset(at);
        expected.erase(at);
        break;
      default: EXPECT_EQ(bits.insert(at), expected.insert(at).second);
    }
    EXPECT_EQ(bits.test(at), expected.count(at) == 1);
    EXPECT_EQ(bits.count(), expected.size());
    EXPECT_EQ(bits.any(), !expected.empty());
  }
  EXPECT_EQ(members(bits), std::vector<std::uint32_t>(expected.begin(), expected.end()));
}

TEST(Bitset, FindsMembersAtTheEdgesOfWords) {
  Bitset bits;
  const std::vector<std::uint32_t> edges = {0, 63, 64, 127, 128, 1000};
  for (const std::uint32_t i : edges) bits.set(i);
  EXPECT_EQ(members(bits), edges);
  EXPECT_EQ(bits.find_next(129), 1000u);
  EXPECT_EQ(bits.find_next(1001), Bitset::kNone);
  EXPECT_EQ(bits.find_next(1u << 30), Bitset::kNone);
}

TEST(Bitset, NumbersNeverSetAreNotMembersAndMayBeReset) {
  Bitset bits;
  EXPECT_FALSE(bits.test(12345));
  bits.reset(12345);
  EXPECT_EQ(bits.find_next(0), Bitset::kNone);
  bits.set(70);
  bits.clear();
  EXPECT_FALSE(bits.test(70));
  EXPECT_FALSE(bits.any());
}

}  // namespace bitset_test
}  // namespace isostep
