// MatchControl: what the players of a machine ask for while they play.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/ballot.hpp"

namespace isostep {

/// See Session, where the functions have the same names.
class MatchControl {
 public:
  virtual ~MatchControl() = default;
  virtual bool pause(bool on) = 0;
  virtual bool set_speed(int speed) = 0;
  virtual bool propose(int player, const Proposal& proposal) = 0;
  virtual bool vote(int player, bool yes) = 0;
};

}  // namespace isostep
