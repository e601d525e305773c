// lower_bound over indices against the standard library's.
// SPDX-License-Identifier: MIT
#include "isostep/core/lower_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

namespace isostep {
namespace lower_bound_test {

TEST(LowerBound, EveryCountAndEveryPlaceOfTheFirst) {
  for (std::size_t count = 0; count < 70; ++count) {
    for (std::size_t first = 0; first <= count; ++first)
      EXPECT_EQ(lower_bound(count, [&](std::size_t i) { return i < first; }), first) << "of " << count;
  }
}

TEST(LowerBound, OfEqualOnesItIsTheFirst) {
  const std::vector<int> sorted = {1, 1, 3, 3, 3, 3, 7, 7, 8};
  for (int value = 0; value < 10; ++value) {
    const auto expected = std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    EXPECT_EQ(lower_bound(sorted.size(), [&](std::size_t i) { return sorted[i] < value; }),
              static_cast<std::size_t>(expected));
  }
}

TEST(LowerBound, AsksForIndicesBelowTheCountAloneAndFewOfThem) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 40}) {
    for (const std::size_t first : {std::size_t{0}, count / 3, count - 1, count}) {
      std::size_t asked = 0;
      const auto before = [&](std::size_t i) {
        EXPECT_LT(i, count);
        ++asked;
        return i < first;
      };
      EXPECT_EQ(lower_bound(count, before), first);
      EXPECT_LE(asked, std::bit_width(count));
    }
  }
}

}  // namespace lower_bound_test
}  // namespace isostep
