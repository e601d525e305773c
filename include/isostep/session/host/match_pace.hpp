// MatchPace: how fast all go, which is as fast as the slowest machine can, and whether that may stay the host's.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/input_flow.hpp"
#include "isostep/session/pace/step_pace.hpp"
#include "isostep/session/pace/turn_rate.hpp"

namespace isostep {

/// In: our turns, and the pace that guests need. Out: the pace of all, and who is to be the host instead.
class MatchPace {
 public:
  struct Choice {
    int player;   // whose machine is the slowest
    int stretch;  // [1/256 period] by which frames last longer
  };

  /// `most`: [1/256 period] A machine that needs more does not play.
  MatchPace(Seats& seats, Guests& guests, const StepPace& steps, int most)
      : seats_(seats), guests_(guests), steps_(steps), most_(most) {}
  void turn(Time now, int most_steps, Time period) { turns_.turn(now, most_steps, period); }
  /// `present`: the choice in force. A guest that is too slow for long leaves its seats.
  Choice choose(const Choice& present, Time now);
  /// Returns true if we are too slow to be a guest, and so to be the host where another can be.
  bool is_too_slow(Time now);
  /// Players, a bit each, whose machines are no better than ours, or not there.
  std::uint64_t unfit(const InputFlow& flow, Time now) const;

 private:
  /// [1/256 period] by which frames last longer here.
  int own() const { return turns_.stretch() > steps_.stretch() ? turns_.stretch() : steps_.stretch(); }

  Seats& seats_;
  Guests& guests_;
  const StepPace& steps_;
  int most_;
  TurnRate turns_;
  Time dear_since_ = 0;  // [us] our steps are too dear
};

}  // namespace isostep
