// RollbackThrift: by how many frames the rollbacks of a machine have to be shorter, for it has no time to step them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// In: how many frames were stepped, and whether the machine is too slow. Out: by how many frames the others' inputs
/// have to come earlier. It asks for the most at once, because the whole match is slow meanwhile. Then it asks for a
/// frame less at a time, and where that was too little, it waits longer before the next attempt.
class RollbackThrift {
 public:
  /// `most`: [frames] that it may ask for; with 0 it asks for nothing.
  explicit RollbackThrift(Frame most) : most_(most) {}

  /// [frames] by which rollbacks have to be shorter now.
  Frame frames() const { return frames_; }
  /// Call it once per frame of time. `steps`: frames stepped so far. `fresh`: those stepped for the first time.
  void observe(std::uint64_t steps, std::uint64_t fresh, bool is_too_slow, Time now) {
    was_slow_ = was_slow_ || is_too_slow;
    if (++observed_ < kPeriod) return;
    const std::uint64_t stepped = steps - steps_, first = fresh - fresh_;
    rolls_back_ = (stepped - first) * kShare > first;
    steps_ = steps;
    fresh_ = fresh;
    observed_ = 0;
    decide(was_slow_ && rolls_back_, was_slow_, now);
    was_slow_ = false;
  }

 private:
  void decide(bool needs_more, bool is_slow, Time now) {
    if (!is_slow) {
      is_vain_ = false;
      slow_since_ = now;
    } else if (rolls_back_ && !is_vain_) {
      slow_since_ = now;
    } else if (frames_ > 0 && now - slow_since_ >= kVain) {
      is_vain_ = true;
      frames_ = 0;
    }
    if (needs_more && !is_vain_ && now >= settles_at_ && frames_ < most_) {
      if (is_tried_) hold_ = hold_ * 2 < kLongestHold ? hold_ * 2 : kLongestHold;
      frames_ = is_tried_ ? frames_ + 1 : most_;
      is_tried_ = false;
      settles_at_ = now + kSettling;
    }
    if (is_slow) less_at_ = now + hold_;
    if (now < less_at_) return;
    less_at_ = now + hold_;
    if (frames_ == 0) {
      hold_ = kHold;
      is_tried_ = false;
      return;
    }
    --frames_;
    is_tried_ = true;
  }

  static constexpr int kPeriod = 30;                      // [frames] of time for one decision
  static constexpr std::uint64_t kShare = 8;              // an eighth of all steps is what is felt
  static constexpr Time kSettling = 3 * kSecond;          // [us] in which delays follow
  static constexpr Time kVain = 12 * kSecond;             // [us] in which a pace that is no longer needed is given up
  static constexpr Time kHold = 10 * kSecond;             // [us] before a frame less is tried
  static constexpr Time kLongestHold = 5 * 60 * kSecond;  // [us]

  Frame most_;
  Frame frames_ = 0;
  std::uint64_t steps_ = 0, fresh_ = 0;  // when it was decided last
  int observed_ = 0;
  bool was_slow_ = false;    // since then
  bool rolls_back_ = false;  // before
  bool is_vain_ = false;     // it is slow without rollbacks as well
  bool is_tried_ = false;    // with a frame less
  Time slow_since_ = 0;      // [us] without rollbacks
  Time settles_at_ = 0, less_at_ = 0, hold_ = kHold;
};

}  // namespace isostep
