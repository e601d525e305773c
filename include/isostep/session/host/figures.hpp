// Figures: the host's figures of every player: measured here, and told to all once a second.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/input_flow.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// In: the guests' lines, and what seats cost. Out: stats.players, and which guests are due to hear them.
class Figures {
 public:
  Figures(Seats& seats, Guests& guests, const InputFlow& flow, SessionStats& stats)
      : seats_(seats), guests_(guests), flow_(flow), stats_(stats) {}
  void keep(int players, Time now);

 private:
  Seats& seats_;
  Guests& guests_;
  const InputFlow& flow_;
  SessionStats& stats_;
  Time told_again_at_ = 0;  // [us]
};

}  // namespace isostep
