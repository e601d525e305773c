// StallBudget: how long one player made the others wait within the last minute.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Sums stalls over the last minute, in twelve parts; old parts are forgotten one by one. Many short stalls cost a
/// player as much as a long one.
class StallBudget {
 public:
  void spend(Time time, Time now) {
    forget(now);
    parts_[newest_ % kParts] += time;
  }
  /// [us] The stalls of the last 55 to 60 s.
  Time spent(Time now) {
    forget(now);
    Time sum = 0;
    for (const Time part : parts_) sum += part;
    return sum;
  }

 private:
  static constexpr std::uint64_t kParts = 12;
  static constexpr Time kPart = 60 * kSecond / kParts;  // [us]

  void forget(Time now) {
    const std::uint64_t part = now / kPart;
    for (std::uint64_t n = 0; n < kParts && newest_ < part; ++n) parts_[++newest_ % kParts] = 0;
    if (newest_ < part) newest_ = part;
  }

  Time parts_[kParts] = {};
  std::uint64_t newest_ = 0;  // number of the part that time is in
};

}  // namespace isostep
