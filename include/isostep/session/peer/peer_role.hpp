// PeerRole: what a host and a client do differently in a turn.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// PeerCore calls it, in the order in which a turn goes on.
class PeerRole {
 public:
  virtual ~PeerRole() = default;

  virtual bool running() const = 0;
  /// Is it a player of ours, in the match?
  virtual bool is_local(int player) const = 0;
  /// How many frames may be stepped on guesses.
  virtual Frame window() const = 0;
  /// No turn was taken for so long that what happened meanwhile says nothing of the others.
  virtual void paused(Time) {}
  /// The state with which all begins is made, and saved.
  virtual void ask_start() = 0;
  virtual void before_steps(Time) {}
  /// Once a frame of time: tells the delay how early our inputs reach the others.
  virtual void observe_delay() = 0;
  /// [frames] by which this player's inputs come before they are needed; 0 where nothing is known of it.
  virtual Frame early(int player) const = 0;
  /// Far behind: frames are stepped as fast as calls of advance come, not when they are due.
  virtual bool hurries(Time) const { return false; }
  virtual void before_frame(Time) {}
  virtual void blocked(Time) {}
  virtual void unblocked(Time) {}
  virtual void after_steps() {}
  /// States up to this one cannot change any more.
  virtual Frame final_limit() const = 0;
};

}  // namespace isostep
