// TurnRate: how many frames a second a loop can step, by how often it comes round. The times of turns go in.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Measures a loop that turns too seldom to make up for it with more steps per turn: a browser tab in the background,
/// an overloaded server. (StepPace measures a machine whose steps are dear.) One long turn is a hitch and does not
/// count.
class TurnRate {
 public:
  /// Begins a turn, in which at most `most_steps` frames of `period` [us] are stepped.
  void turn(Time now, int most_steps, Time period) {
    const Time gap = now - last_;
    last_ = now;
    if (!has_turned_) {
      has_turned_ = true;
      begin_window(now);
      return;
    }
    const Time worth = period * static_cast<Time>(most_steps);
    time_ += gap;
    frames_worth_ += worth;
    late_ += gap > worth ? 1 : 0;
    if (gap > longest_) {
      longest_ = gap;
      longests_worth_ = worth;
    }
    ++turns_;
    if (time_ < kWindow || turns_ <= kLeastTurns) return;
    const Time time = time_ - longest_, worth_of_it = frames_worth_ - longests_worth_;
    const Time parts = worth_of_it == 0 ? 0 : time * 256 / worth_of_it;
    const bool is_slow = late_ > kLeastTurns && parts >= 256 + kWorthIt;
    stretch_ = !is_slow ? 0 : parts - 256 < kLargest ? static_cast<int>(parts - 256) : kLargest;
    if (!is_slow) slow_since_ = now;
    begin_window(now);
  }
  /// [1/256 period] by which frames last longer here, at the least; 0: it keeps up.
  int stretch() const { return stretch_; }
  /// [us] The time since which the loop is slow.
  Time slow_since() const { return slow_since_; }

 private:
  void begin_window(Time now) {
    if (stretch_ == 0) slow_since_ = now;
    time_ = frames_worth_ = longest_ = longests_worth_ = 0;
    late_ = turns_ = 0;
  }

  static constexpr Time kWindow = kSecond * 4 / 10;  // [us] so that a slow loop is named within a second
  static constexpr int kLeastTurns = 2;              // beside the longest: each of them late
  static constexpr Time kWorthIt = 12;               // [1/256 period] a twentieth: what a caller's waits amount to
  static constexpr int kLargest = 255;               // [1/256 period]

  bool has_turned_ = false;
  Time last_ = 0;                                                        // [us] of the last turn
  Time time_ = 0, frames_worth_ = 0, longest_ = 0, longests_worth_ = 0;  // [us] of this window
  int late_ = 0, turns_ = 0;                                             // likewise
  int stretch_ = 0;
  Time slow_since_ = 0;  // [us]
};

}  // namespace isostep
