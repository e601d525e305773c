// RemotePosition: which frame a peer is at, by its last datagrams, of which some may be old, forged or out of order.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The median of the last values. Values that are far off do not move it while they are fewer than true ones.
template <class T> class RecentMedian {
 public:
  void add(T value) {
    values_[next_] = value;
    next_ = (next_ + 1) % kValues;
    if (count_ < kValues) ++count_;
  }
  int count() const { return count_; }
  /// Returns the median by key(value), an unsigned number of 64 bits. Of an even number of values it is the upper one.
  /// count() must be above 0.
  template <class Key> T median(const Key& key) const {
    T sorted[kValues] = {};
    for (int n = 0; n < count_; ++n) sorted[n] = values_[n];
    insertion_sort(sorted, static_cast<std::uint32_t>(count_), key);
    return sorted[count_ / 2];
  }
  static constexpr int kValues = 9;  // a seventh of a second of datagrams at 60 Hz: four of them may be wrong

 private:
  T values_[kValues] = {};
  int next_ = 0, count_ = 0;
};

class RemotePosition {
 public:
  void heard(Frame frame, Time at, Time period) {
    said_.add({frame, at});
    // All that was said ages alike, so which one is in the middle changes only here.
    middle_ = said_.median([&](const Said& said) {
      constexpr std::uint64_t kAbove = std::uint64_t{1} << 62;  // of all times: what is subtracted leaves no sign
      return kAbove + static_cast<std::uint64_t>(said.frame) * period - said.at;
    });
  }
  bool is_known() const { return said_.count() > 0; }
  /// [1/256 frame] The peer's next frame, extrapolated by at most a second: a silent peer has probably stopped.
  std::int64_t at(Time now, Time period) const {
    if (!is_known()) return 0;
    const Time since = now > middle_.at ? now - middle_.at : 0;
    return std::int64_t{middle_.frame} * 256 +
           static_cast<std::int64_t>((since < kSecond ? since : kSecond) * 256 / period);
  }
  /// Returns true if a datagram of now may plausibly say `frame`; always, while little is known. A slow peer may be
  /// behind the extrapolated frame, but not behind the frame that it said.
  bool is_near(Frame frame, Time now, Time period) const {
    if (said_.count() < RecentMedian<Said>::kValues) return true;
    const std::int64_t off = std::int64_t{frame} * 256 - at(now, period);
    const auto most = static_cast<std::int64_t>(kNear * 256 / period);
    return off <= most && std::int64_t{middle_.frame - frame} * 256 <= most;
  }

 private:
  struct Said {
    Frame frame = 0;
    Time at = 0;  // [us]
  };
  static constexpr Time kNear = kSecond / 4;  // [us] jitter and lost datagrams move what is said by less

  RecentMedian<Said> said_;
  Said middle_;
};

}  // namespace isostep
