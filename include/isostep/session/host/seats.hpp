// Seats: who sits where in the host's match, for whom seats are kept, and which may be had.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/roster.hpp"
#include "isostep/session/config.hpp"
#include "isostep/session/host/guest.hpp"
#include "isostep/session/host/seat.hpp"
#include "isostep/session/host/secret_numbers.hpp"
#include "isostep/session/pace/input_delay.hpp"
#include "isostep/session/protocol/saved_match.hpp"
#include "isostep/session/timeline/player_set.hpp"

namespace isostep {

/// In: wishes and tokens of guests. Out: the seats that they get, or why they get none. Sets of players are a bit each.
class Seats {
 public:
  /// `slack`: how early each player's inputs come. It is reset when the player's seat is closed.
  Seats(const SessionConfig& config, std::uint32_t hosted, RecentLeast (&slack)[kMaxPlayers]);
  /// Takes the seats of a saved match (resume), or of a match that its host has left (take_over).
  void resume(const SavedMatch& saved);
  void take_over(const Roster& roster);
  /// Opens the seats of players who are here: they play from the first frame on.
  void begin();

  Seat& operator[](int player) { return seats_[player]; }
  const Seat& operator[](int player) const { return seats_[player]; }
  std::uint32_t hosted() const { return hosted_; }
  bool is_local(int player) const { return player >= 0 && player < config_.players && (hosted_ >> player & 1) != 0; }
  /// Returns true for a seat that clients may have.
  bool is_guests(int player) const { return player >= 0 && player < config_.players && !is_local(player); }
  /// Returns true if its players are in their seats, and their inputs are awaited.
  bool play(const Guest& guest) const { return guest.is_live() && guest.player >= 0 && seats_[guest.player].is_open; }
  /// The players whose inputs are awaited.
  std::uint32_t open() const;
  /// The players with this token, which all players of a machine share.
  std::uint32_t players_of(std::uint64_t token) const;
  /// All players of the machine of a player who is away.
  std::uint32_t away_with(int player) const;

  /// Finds as many seats as it asks for. Returns 0, and sets `why`, if they are not to be had.
  std::uint32_t find(const Application& wish, Refusal& why) const;
  /// The seats and the token that a guest gets. Whoever still sits on those, or on its own, has to leave before.
  struct Claim {
    std::uint32_t wanted = 0, own = 0;
    bool keeps_token = false;
    std::uint64_t token = 0, life = 0;
  };
  Claim claim(const Application& wish, std::uint32_t wanted, SecretNumbers& numbers) const;
  void take(Guest& guest, const Claim& claim);
  /// Keeps the guest's open seats for it: its players act on the welcome, so they have read the token in it.
  void keep(const Guest& guest);
  void free(int player);
  /// Closes the guest's seats: nobody waits for its inputs any more.
  void close(const Guest& guest);
  /// Closes the guest's seats, and its players watch for `exclusion`.
  void leave_out(const Guest& guest, Time now);
  /// Takes the guest out of its seats. Those that are not kept are free for the next one.
  void leave(Guest& guest);
  /// Adds the time of a turn to how long seats are not played on.
  void pass(Time time);

 private:
  /// Returns true for a client's seat whose player is neither there nor expected to come back.
  bool is_free(int player) const;
  bool is_away(int player) const { return is_guests(player) && seats_[player].is_taken && seats_[player].link < 0; }
  std::uint32_t find_wanted(const Application& wish, std::uint32_t own, Refusal& why) const;
  std::uint32_t find_any(const Application& wish, std::uint32_t own, Refusal& why) const;

  const SessionConfig& config_;
  std::uint32_t hosted_;  // players of this machine
  RecentLeast* slack_;
  bool has_begun_ = false;
  Seat seats_[kMaxPlayers];
};

}  // namespace isostep
