// LineJudge: whose line is worse than the others', and how early each player's inputs reach all of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/rollback_thrift.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// Round trips and what guests report come in; by how much inputs are early goes out, as far as that is the affair of
/// their players' delays.
class LineJudge {
 public:
  /// `slack`: by which inputs were early here. `delay`, `thrift`: our own.
  LineJudge(const SessionConfig& config, const Seats& seats, Guests& guests, const FrameClock& clock,
            const RecentLeast (&slack)[kMaxPlayers], const InputDelay& delay, const RollbackThrift& thrift)
      : config_(config), seats_(seats), guests_(guests), clock_(clock), slack_(slack), delay_(delay), thrift_(thrift) {}
  /// A pause of ours: what passed through us was late for everybody, whoever said it.
  void excuse(Time now) { reports_from_ = now + InputDelay::kSettling * clock_.period(); }
  void begin_turn(Time now) { reports_count_ = now >= reports_from_; }
  void judge();
  /// True, once: it is farther than any delay covers.
  static bool loses(Guest& guest, bool is_covered, Time now);
  /// How early `player`'s inputs reach all others. `is_slow`: machines are at their limit.
  Frame slack_of(int player, Frame current, bool is_slow) const;
  /// The same, as its own guest should know it.
  Frame told_slack(const Guest& guest, int player, Frame current, bool is_slow) const;
  /// [us] of the guest in the match that is farthest away.
  Time longest_round_trip() const;

 private:
  const SessionConfig& config_;
  const Seats& seats_;
  Guests& guests_;
  const FrameClock& clock_;
  const RecentLeast* slack_;
  const InputDelay& delay_;
  const RollbackThrift& thrift_;
  /// [us] round trips beyond this are their players' own affair: who has a worse line runs later, and nobody waits.
  Time farthest_ = 0;
  Time reports_from_ = 0;       // [us]
  bool reports_count_ = false;  // in this turn
};

}  // namespace isostep
