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

/// In: wishes and tokens of guests. Out: which seats they get, or why none. Sets of players are a bit each.
class Seats {
 public:
  /// `slack`: how early each player's inputs come, which says nothing any more once its seat is closed.
  Seats(const SessionConfig& config, std::uint32_t hosted, RecentLeast (&slack)[kMaxPlayers]);
  /// As they are in a match that was saved, or in one that its host has left.
  void resume(const SavedMatch& saved);
  void take_over(const Roster& roster);
  /// Who is here plays from the first frame on.
  void begin();

  Seat& operator[](int player) { return seats_[player]; }
  const Seat& operator[](int player) const { return seats_[player]; }
  std::uint32_t hosted() const { return hosted_; }
  bool is_local(int player) const { return player >= 0 && player < config_.players && (hosted_ >> player & 1) != 0; }
  /// A seat that clients may have.
  bool is_guests(int player) const { return player >= 0 && player < config_.players && !is_local(player); }
  /// Its players are in their seats, and their inputs are awaited.
  bool play(const Guest& guest) const { return guest.is_live() && guest.player >= 0 && seats_[guest.player].is_open; }
  /// Whose inputs are awaited.
  std::uint32_t open() const;
  /// Whose token this is: a machine's players have the same.
  std::uint32_t players_of(std::uint64_t token) const;
  /// All of the machine of a player who is away.
  std::uint32_t away_with(int player) const;

  /// As many as it asks for; 0: these are not to be had, for this reason.
  std::uint32_t find(const Application& wish, Refusal& why) const;
  /// What a guest takes its seats with. Who still sits on those, or on its own, has to leave before.
  struct Claim {
    std::uint32_t wanted = 0, own = 0;
    bool keeps_token = false;
    std::uint64_t token = 0, life = 0;
  };
  Claim claim(const Application& wish, std::uint32_t wanted, SecretNumbers& numbers) const;
  void take(Guest& guest, const Claim& claim);
  /// Players who act on the welcome have read the token in it.
  void keep(const Guest& guest);
  void free(int player);
  /// Nobody waits for its inputs any more.
  void close(const Guest& guest);
  /// Likewise, and its players watch for `exclusion`.
  void leave_out(const Guest& guest, Time now);
  /// Its players' seats are free for who comes next.
  void leave(Guest& guest);
  /// A turn took so long: for how long seats are not played on.
  void pass(Time time);

 private:
  /// Of a client's player that is neither there nor expected to come back.
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
