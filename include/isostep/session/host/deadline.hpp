// Deadline: the host's patience with late players: their inputs are replaced, and who is late too often watches.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// In: due frames, and guesses. Out: final inputs, and players who are left out. A player who holds the match up may
/// spend `patience` within a minute, at once or bit by bit; then it watches.
class Deadline {
 public:
  Deadline(const SessionConfig& config, Seats& seats, const Guests& guests, std::vector<InputStream>& streams,
           RecentLeast (&slack)[kMaxPlayers], const FrameClock& clock, SessionStats& stats)
      : config_(config),
        seats_(seats),
        guests_(guests),
        streams_(streams),
        slack_(slack),
        clock_(clock),
        stats_(stats) {}
  void begin(Time now) { began_ = now; }
  /// This machine paused: for a while nobody is late.
  void excuse(Time now) { due_from_ = now + static_cast<Time>(config_.deadline) * clock_.period(); }

  bool applies(Time now) const { return config_.deadline > 0 && now >= due_from_; }
  /// Returns true if the player's next input is too late when the frame `due` is. If the last one was replaced and
  /// nothing came since, it may be late by half a window, a rollback that every frame affords.
  bool is_over(int player, Frame due, Frame window) const;
  /// Replaces the player's next input by the guess, which is final.
  void replace(int player, Bytes guess, Frame due, Time now);
  /// Returns true, once, if the game must hear now that inputs of this player were replaced.
  bool must_tell(int player, Time now);

  /// Notes inputs before `end` that came after they were replaced. Returns false if that is known.
  bool is_news(int player, Frame end);
  /// Notes that the match stalls. Returns true if it has done so for `worth_telling` [us].
  bool stands(Time now, Time worth_telling);
  void charge(Frame current, bool may_leave_out, Time now);
  void goes_on() { blocked_since_ = 0; }

 private:
  const SessionConfig& config_;
  Seats& seats_;
  const Guests& guests_;
  std::vector<InputStream>& streams_;
  RecentLeast* slack_;
  const FrameClock& clock_;
  SessionStats& stats_;
  Time began_ = 0;                           // [us]
  Time due_from_ = 0;                        // [us] nobody is late before that
  Time blocked_since_ = 0, charged_at_ = 0;  // [us]
};

}  // namespace isostep
