// Deadline: the host's patience with late players: their inputs are replaced, and who is late too often watches.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// Frames that are due and guesses come in; final inputs go out, and who is left out. Who holds the match up spends its
/// patience of a minute, whether at once or bit by bit, and then watches.
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
  /// A pause of ours: for a while nobody is late.
  void excuse(Time now) { due_from_ = now + static_cast<Time>(config_.deadline) * clock_.period(); }

  bool applies(Time now) const { return config_.deadline > 0 && now >= due_from_; }
  /// The next input of this player is too late, while the frame `due` is. Of whom one input was replaced, and nothing
  /// came since, the next is waited for as long as nobody stands: what a rollback affords in every frame.
  bool is_over(int player, Frame due, Frame window) const;
  /// With what is guessed: that is final.
  void replace(int player, Bytes guess, Frame due, Time now);
  /// True once: the game hears now which inputs of this player were replaced.
  bool must_tell(int player, Time now);

  /// Inputs before `end` came after they were replaced: false, when that is known.
  bool is_news(int player, Frame end);
  /// The match stands, and for so long that it is worth telling.
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
