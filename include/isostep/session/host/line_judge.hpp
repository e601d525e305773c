// LineJudge: whose line is worse than the others', and how early each player's inputs reach all of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/rollback_thrift.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// In: round trips, and the guests' reports. Out: how early inputs are, as far as the delays of their players are to
/// cover it.
class LineJudge {
 public:
  /// `slack`: how early inputs came here. `delay`, `thrift`: our own.
  LineJudge(const SessionConfig& config, const Seats& seats, Guests& guests, const FrameClock& clock,
            const RecentLeast (&slack)[kMaxPlayers], const InputDelay& delay, const RollbackThrift& thrift)
      : config_(config), seats_(seats), guests_(guests), clock_(clock), slack_(slack), delay_(delay), thrift_(thrift) {}
  /// This machine paused: all inputs passed through us late, so reports on them do not count for a while.
  void excuse(Time now) { reports_from_ = now + InputDelay::kSettling * clock_.period(); }
  void begin_turn(Time now) { reports_count_ = now >= reports_from_; }
  void judge();
  /// Returns true, once, if no delay covers the guest's line.
  static bool loses(Guest& guest, bool is_covered, Time now);
  /// [frames] Returns how early `player`'s inputs reach all others. `is_slow`: machines are at their limit.
  Frame slack_of(int player, Frame current, bool is_slow) const;
  /// [frames] Returns that slack as the player's own guest is told it.
  Frame told_slack(const Guest& guest, int player, Frame current, bool is_slow) const;
  /// [us] The round trip of the guest in the match that is farthest away.
  Time longest_round_trip() const;

 private:
  const SessionConfig& config_;
  const Seats& seats_;
  Guests& guests_;
  const FrameClock& clock_;
  const RecentLeast* slack_;
  const InputDelay& delay_;
  const RollbackThrift& thrift_;
  /// [us] Nobody waits for a line with a longer round trip: its player runs later.
  Time farthest_ = 0;
  Time reports_from_ = 0;       // [us]
  bool reports_count_ = false;  // in this turn
};

}  // namespace isostep
