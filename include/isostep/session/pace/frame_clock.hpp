// FrameClock: when the next frame is due, and how a client leans towards the host's frames.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The host's clock runs freely at the match's rate. A client's period is stretched or shortened until both step the
/// same frame at the same time. Then no input is seen later than the network makes it.
class FrameClock {
 public:
  explicit FrameClock(int hz)
      : hz_(static_cast<Time>(hz)), nominal_(kSecond / hz_), period_(nominal_), interval_(nominal_) {}

  void start(Time now) { due_ = now; }
  bool is_due(Time now) const { return now >= due_; }
  Time until_due(Time now) const { return now >= due_ ? 0 : due_ - now; }
  Time period() const { return period_; }
  /// [us] The length of a frame at the match's speed, without stretch.
  Time nominal() const { return nominal_; }
  /// Sets the speed [1/8 of the match's rate].
  void set_speed(int eighths) {
    nominal_ = kSecond * 8 / (hz_ * static_cast<Time>(eighths));
    stretch(parts_);
  }
  /// Lengthens frames by `parts` [1/256 of the match's period]: the match runs at the pace of its slowest machine.
  void stretch(int parts) {
    parts_ = parts;
    period_ = nominal_ + nominal_ * static_cast<Time>(parts) / 256;
    set_interval();
  }

  /// Notes that a frame was stepped. Small delays of the caller do not add up. A caller that is late by more than
  /// kForgiven frames starts anew and does not catch up.
  void stepped(Time now) {
    due_ += interval_;
    if (now > due_ + kForgiven * period_) due_ = now;
    // Who caught up by stepping before it was due does not wait for that afterwards.
    if (due_ > now + interval_) due_ = now + interval_;
  }
  /// Returns how many frames a punctual caller would have stepped in the meantime.
  Frame overdue(Time now) const { return now <= due_ ? 0 : static_cast<Frame>((now - due_) / period_); }

  /// `ahead`: how far this machine is ahead of the host [1/256 frame], negative if behind.
  void lean(std::int32_t ahead) {
    smoothed_ += (ahead - smoothed_) / kSmoothing;
    set_interval();
  }
  void forget_lean() {
    smoothed_ = 0;
    set_interval();
  }
  std::int32_t ahead() const { return smoothed_; }

 private:
  static constexpr Time kForgiven = 3;            // [frames] of lateness that are made up for
  static constexpr std::int32_t kSmoothing = 8;   // packets: jitter of two frames moves the lean by a quarter of one
  static constexpr std::int32_t kMostFrames = 2;  // beyond it the lean is at its most,
  static constexpr std::int32_t kGain = 20;       // a tenth of the period; one frame ahead is made up in 20

  void set_interval() {
    const std::int32_t cap = 256 * kMostFrames;
    const std::int32_t clamped = smoothed_ > cap ? cap : smoothed_ < -cap ? -cap : smoothed_;
    const auto period = static_cast<std::int64_t>(period_);
    interval_ = static_cast<Time>(period + period * clamped / (256 * kGain));
  }

  Time hz_;                           // [1/s]
  int parts_ = 0;                     // [1/256 period] of stretch
  Time nominal_, period_, interval_;  // [us] the match's; stretched; and leaning
  Time due_ = 0;
  std::int32_t smoothed_ = 0;  // [1/256 frame]
};

}  // namespace isostep
