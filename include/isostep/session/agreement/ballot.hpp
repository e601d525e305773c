// Ballot: what the players of a match vote on, and how that stands. One at a time, counted by the host.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

struct Proposal {
  /// The host carries out a proposal that passes; `other` is the game's.
  enum class Kind : std::uint8_t { pause = 1, unpause, speed, kick, other };
  Kind kind = Kind::other;
  std::uint32_t subject = 0;  // speed: [1/8 of the rate]; kick: the player; other: what the game likes

  bool is_sound() const;
};

struct Ballot {
  enum class Outcome : std::uint8_t { open, passed, failed };
  std::uint32_t number = 0;  // of the vote at this host; 0: none
  Proposal proposal{};
  std::uint8_t by = 0;                        // the player who proposed it, and votes for it
  std::uint32_t voters = 0, yes = 0, no = 0;  // players, a bit each
  Outcome outcome = Outcome::open;

  /// Returns true if its players are of a match of so many.
  bool is_of(int players) const { return by < players && std::uint64_t{voters | yes | no} >> players == 0; }
  bool is_open() const { return number != 0 && outcome == Outcome::open; }
  /// Returns true if more than half of the voters are for it.
  bool has_passed() const { return 2 * std::popcount(yes) > std::popcount(voters); }
  /// Returns true if half of the voters are against it: more than half cannot be for it.
  bool has_failed() const { return 2 * std::popcount(no) >= std::popcount(voters); }
};

/// The votes of players of one machine, a bit each, in the ballot of that number.
struct Votes {
  std::uint32_t number = 0, yes = 0, no = 0;
};
struct PlayersProposal {
  std::uint8_t player = 0;
  Proposal proposal;
};

/// These functions replace the content of `out`.
void write_proposal(const PlayersProposal& proposal, std::vector<std::uint8_t>& out);
void write_votes(const Votes& votes, std::vector<std::uint8_t>& out);
void write_ballot(const Ballot& ballot, std::vector<std::uint8_t>& out);
Result<PlayersProposal> read_proposal(Bytes message);
Result<Votes> read_votes(Bytes message);
Result<Ballot> read_ballot(Bytes message);

}  // namespace isostep
