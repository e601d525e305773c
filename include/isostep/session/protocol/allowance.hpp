// Allowance: how many words of one peer are read in a second; more are dropped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Allows `most` messages per second, in bursts of at most a quarter of that.
struct Allowance {
  std::int64_t credit = 0;  // [1/kSecond]
  Time since = 0;           // [us] when it was last added to

  void start(Time now) { *this = {kFirst, now}; }
  /// Returns true, and counts one more, if it is allowed.
  bool spend(std::uint32_t most, Time now) {
    constexpr auto kOne = static_cast<std::int64_t>(kSecond);
    const std::int64_t quarter = std::int64_t{most} * kOne / 4;
    const std::int64_t burst = quarter > kOne ? quarter : kOne;
    const Time passed = now - since < kSecond ? now - since : kSecond;
    credit += static_cast<std::int64_t>(passed) * most;
    since = now;
    if (credit > burst) credit = burst;
    if (credit < kOne) return false;
    credit -= kOne;
    return true;
  }

 private:
  static constexpr std::int64_t kFirst = 16 * static_cast<std::int64_t>(kSecond);
};

}  // namespace isostep
