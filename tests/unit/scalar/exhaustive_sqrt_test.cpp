// Every square root of Q16.16, all 2^31 of them, by the definition of "nearest". About ten seconds.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include "isostep/scalar/math.hpp"

namespace isostep {
namespace exhaustive_sqrt_test {

TEST(ExhaustiveSqrt, IsTheNearestForEveryNonNegativeQ16_16) {
  std::uint64_t wrong = 0;
  std::uint32_t first_wrong = 0;
  for (std::uint32_t raw = 0; raw <= 0x7fffffffu; ++raw) {
    const auto s = static_cast<std::int64_t>(isostep::sqrt(Q16_16::from_raw(static_cast<std::int32_t>(raw))).raw());
    const std::int64_t n = static_cast<std::int64_t>(raw) << 16;
    // (s - 1/2)^2 < n < (s + 1/2)^2 for integers; s = 0 has no left neighbour.
    const bool nearest = n <= s * s + s && (s == 0 || n > s * s - s);
    if (!nearest) {
      if (wrong == 0) first_wrong = raw;
      ++wrong;
    }
  }
  EXPECT_EQ(wrong, 0u) << "first at raw " << first_wrong;
}

}  // namespace exhaustive_sqrt_test
}  // namespace isostep
