// PeerRole: what a host and a client do differently in a turn.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The parts of a turn that differ between host and client. PeerCore calls them in this order.
class PeerRole {
 public:
  virtual ~PeerRole() = default;

  virtual bool running() const = 0;
  /// Returns true if it is a local player in the match.
  virtual bool is_local(int player) const = 0;
  /// The number of frames that may be stepped on guesses.
  virtual Frame window() const = 0;
  /// This machine took no turn for so long that its observations of that time say nothing of the others.
  virtual void paused(Time) {}
  /// Requests the first state, and its save.
  virtual void ask_start() = 0;
  virtual void before_steps(Time) {}
  /// Tells the delay how early our inputs reach the others. Called once per frame of time.
  virtual void observe_delay() = 0;
  /// [frames] by which this player's inputs come before they are needed; 0: unknown.
  virtual Frame early(int player) const = 0;
  /// Returns true if far behind: frames are then stepped as fast as advance is called, not when they are due.
  virtual bool hurries(Time) const { return false; }
  virtual void before_frame(Time) {}
  virtual void blocked(Time) {}
  virtual void unblocked(Time) {}
  virtual void after_steps() {}
  /// States up to this one are final.
  virtual Frame final_limit() const = 0;
};

}  // namespace isostep
