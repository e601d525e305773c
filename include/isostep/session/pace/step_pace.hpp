// StepPace: how fast this machine can step, by nothing but the times of its turns.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// If every turn with a step makes the next turn late, the machine is at its limit. But if two steps in a turn take no
/// longer than one, the loop is slow and not the step: then the machine takes two steps per turn.
class StepPace {
 public:
  explicit StepPace(Time period) : period_(period) {}

  /// Begins a turn. `is_due`: a frame is due by now. `is_interrupted`: there was a pause, or a wait for others.
  void begin(Time now, bool is_due, bool is_interrupted) {
    if (has_turned_ && !is_interrupted) note_turn(now);
    has_turned_ = true;
    steps_ = 0;
    if (cost_ == Cost::dear && stretch_ == 0 && now - dear_since_ >= kHold) cost_ = Cost::unknown;
    began_ = now;
    if (!is_due || is_interrupted) {
      run_since_ = now;
      run_steps_ = 0;
      is_measured_ = probes_ = false;
    } else if (run_steps_ >= kLeastSteps && now - run_since_ >= kRun) {
      finish_run(now);
    }
    relax(now);
  }
  /// Ends the turn after so many steps.
  void end(int steps) {
    steps_ = steps;
    run_steps_ += steps;
    if (steps >= 2) probes_ = false;
  }

  /// Returns the most steps of one turn. If each step is dear, a second one only makes the gap longer.
  int most_steps(int wanted) const {
    const int most = cost_ == Cost::dear ? 1 : cost_ == Cost::unknown ? 2 : wanted;
    return most < wanted ? most : wanted;
  }
  /// The number of steps of the last turn.
  int steps() const { return steps_; }
  /// Returns true if the next turn should step twice, to find out what that costs.
  bool probes() const { return probes_; }
  /// Returns true if a step takes most of a period.
  bool is_dear() const { return cost_ == Cost::dear; }
  /// [1/256 period] by which a frame takes this machine longer than a period; 0: it keeps up.
  int stretch() const { return stretch_; }

  static constexpr int kLargest = 255;  // [1/256 period]

 private:
  enum class Cost : std::uint8_t { unknown, cheap, dear };

  void note_turn(Time now) {
    const Time took = now - began_;
    if (steps_ == 0) {
      none_ = none_ == 0 ? took : (none_ * 3 + took) / 4;
    } else if (steps_ == 1) {
      one_ = one_ == 0 ? took : (one_ + took) / 2;
      const bool is_long = one_ * 4 >= period_ * 3;
      if (!is_long && cost_ == Cost::dear) cost_ = Cost::unknown;
      if (one_ * 2 < period_) stretch_ = 0;
      // A loop that comes round quickly when there is nothing to do is not what takes the time.
      if (is_long && none_ > 0 && one_ >= 2 * none_) be_dear(now);
    } else if (const Time less = one_ > 0 ? one_ : none_; less > 0) {
      // Dear: twice the work takes half as long again, and more than there is time for.
      const bool is_longer = took * 4 >= less * 3 * static_cast<Time>(steps_);
      const bool is_long = took * 4 >= period_ * 3 * static_cast<Time>(steps_);
      cost_ = Cost::cheap;
      if (is_longer && is_long) be_dear(now);
      is_measured_ = true;
    }
  }
  void be_dear(Time now) {
    cost_ = Cost::dear;
    dear_since_ = now;
  }
  void finish_run(Time now) {
    if (stretch_ == 0 && !is_measured_ && cost_ != Cost::dear) {
      probes_ = true;  // the run goes on until it is known
      return;
    }
    const Time steps = static_cast<Time>(run_steps_), took = now - run_since_;
    const Time parts = (took * 256 + period_ * steps - 1) / (period_ * steps);
    const int needed = parts <= 256 ? 0 : parts - 256 < kLargest ? static_cast<int>(parts - 256) : kLargest;
    if (cost_ == Cost::dear && needed >= kWorthIt) {
      stretch_ = needed;
      relaxes_at_ = now + kHold;
      relaxes_by_ = 1;
    }
    run_since_ = now;
    run_steps_ = 0;
    is_measured_ = false;
  }
  /// Lowers the stretch a little, to see if the machine keeps up. If it does, lowers it more and more.
  void relax(Time now) {
    if (stretch_ == 0 || now < relaxes_at_) return;
    stretch_ -= relaxes_by_;
    if (stretch_ < kWorthIt) stretch_ = 0;
    relaxes_by_ *= 2;
    relaxes_at_ = now + kSecond;
  }

  static constexpr Time kRun = 2 * kSecond / 5;  // [us] of turns that all begin late
  static constexpr int kLeastSteps = 8;          // of a run
  static constexpr int kWorthIt = 3;             // [1/256 period] displays of "60 Hz" differ by less
  static constexpr Time kHold = 2 * kSecond;     // [us] before it is tried whether less will do

  Time period_;     // [us]
  Time began_ = 0;  // [us] this turn
  bool has_turned_ = false;
  int steps_ = 0;              // of the last turn
  Time none_ = 0, one_ = 0;    // [us] a turn without a step, and with one, smoothed; 0: unknown
  Cost cost_ = Cost::unknown;  // of a second step in a turn
  Time dear_since_ = 0;        // [us] when that was found out
  bool is_measured_ = false;   // in this run
  bool probes_ = false;
  Time run_since_ = 0;
  int run_steps_ = 0;
  int stretch_ = 0, relaxes_by_ = 1;
  Time relaxes_at_ = 0;
};

}  // namespace isostep
