// TurnWatch: when this machine took its turns, and whether it paused between two of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/step_pace.hpp"

namespace isostep {

/// In: turns, and the frames that are stepped again in them. Out: whether there was a pause, and whether it is
/// forgiven. Keeps: the last turn, and when a pause was forgiven.
class TurnWatch {
 public:
  void begin(Time now) {
    has_turned_ = true;
    last_ = now;
    stepped_again_ = 0;
  }
  void step_again(Frame frames) { stepped_again_ = frames; }
  /// Returns true if there was a pause since the last turn. Then it is unknown when the bytes read now arrived.
  bool is_after_pause(const FrameClock& clock, const StepPace& pace, Time now) const {
    const Time periods = kPausePeriods * clock.nominal();
    const Time steps = pace.steps() > 1 ? static_cast<Time>(pace.steps()) : 1;  // a turn of many takes its time
    const Time again = static_cast<Time>(stepped_again_) * clock.period();      // and so does a rollback
    return has_turned_ && now - last_ > steps * (periods > kPause ? periods : kPause) + again;
  }
  /// Returns true if reports speak of our pause and not of the line; false if the last pause was a moment ago.
  bool forgives(Time now) {
    if (now < forgiven_until_) return false;
    forgiven_until_ = now + kForgiven;
    return true;
  }

 private:
  // Between turns: a display of 30 Hz takes 33 ms, and a game that misses one of its pictures is not a hitch yet.
  static constexpr Time kPause = 50000;           // [us]
  static constexpr Time kPausePeriods = 3;        // of slow matches: [frames]
  static constexpr Time kForgiven = 5 * kSecond;  // [us] who pauses more often has to cover it by its delay

  Frame stepped_again_ = 0;  // frames of the last turn
  Time last_ = 0;            // [us]
  Time forgiven_until_ = 0;  // [us]
  bool has_turned_ = false;
};

}  // namespace isostep
