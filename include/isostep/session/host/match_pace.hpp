// MatchPace: how fast all go, which is as fast as the slowest machine can, and whether that may stay the host's.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/input_flow.hpp"
#include "isostep/session/pace/step_pace.hpp"
#include "isostep/session/pace/turn_rate.hpp"

namespace isostep {

/// Turns of ours and what guests need come in; the pace goes out, and who is to be the host instead.
class MatchPace {
 public:
  struct Choice {
    int player;   // whose machine is the slowest
    int stretch;  // [1/256 period] by which frames last longer
  };

  /// `most`: [1/256 period] who needs more does not play.
  MatchPace(Seats& seats, Guests& guests, const StepPace& steps, int most)
      : seats_(seats), guests_(guests), steps_(steps), most_(most) {}
  void turn(Time now, int most_steps, Time period) { turns_.turn(now, most_steps, period); }
  /// `present`: as it is. Who is too slow for long leaves its seats.
  Choice choose(const Choice& present, Time now);
  /// We are too slow to be a guest, and so to be the host, where another can be.
  bool is_too_slow(Time now);
  /// Whose machines are no better, or not there, a bit each.
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
