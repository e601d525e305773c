// FrameClock: when the next frame is due, and how a client leans towards the host's frames.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/frame.hpp"

namespace isostep {

/// The host's clock runs free at the match's rate. A client's period is stretched or shortened until both step the same
/// frame at the same time: so neither sees the other's inputs later than the network makes it.
class FrameClock {
 public:
  explicit FrameClock(int hz) : period_(kSecond / static_cast<Time>(hz)), interval_(period_) {}

  void start(Time now) { due_ = now; }
  bool is_due(Time now) const { return now >= due_; }
  Time until_due(Time now) const { return now >= due_ ? 0 : due_ - now; }
  Time period() const { return period_; }

  /// A frame was stepped. A caller that comes a little late is not late twice; one that comes much later starts anew
  /// instead of running after the time.
  void stepped(Time now) {
    due_ += interval_;
    if (now > due_ + kForgiven * period_) due_ = now;
  }
  /// Frames that a caller in time would have stepped by now.
  Frame overdue(Time now) const { return now <= due_ ? 0 : static_cast<Frame>((now - due_) / period_); }

  /// `ahead`: by how much we are ahead of the host [1/256 frame], negative when behind.
  void lean(std::int32_t ahead) {
    smoothed_ += (ahead - smoothed_) / kSmoothing;
    const std::int32_t cap = 256 * kMostFrames;
    const std::int32_t clamped = smoothed_ > cap ? cap : smoothed_ < -cap ? -cap : smoothed_;
    const auto period = static_cast<std::int64_t>(period_);
    interval_ = static_cast<Time>(period + period * clamped / (256 * kGain));
  }
  void forget_lean() {
    smoothed_ = 0;
    interval_ = period_;
  }
  std::int32_t ahead() const { return smoothed_; }

 private:
  static constexpr Time kForgiven = 3;            // [frames] of lateness that are made up for
  static constexpr std::int32_t kSmoothing = 8;   // packets: jitter of two frames moves the lean by a quarter of one
  static constexpr std::int32_t kMostFrames = 2;  // beyond it the lean is at its most,
  static constexpr std::int32_t kGain = 20;       // a tenth of the period; one frame ahead is made up in 20

  Time period_, interval_;  // [us]
  Time due_ = 0;
  std::int32_t smoothed_ = 0;  // [1/256 frame]
};

}  // namespace isostep
