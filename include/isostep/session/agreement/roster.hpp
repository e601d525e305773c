// Roster: the machines of a match, how the others reach them, and how each proves whose players it has.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/session/protocol/address.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Returns what a player shows to prove its token, from which nobody can compute the token. So a new host recognises
/// its players, and they cannot pass for each other.
std::uint64_t proof_of(std::uint64_t token);

/// The settings of a match, as its host configured them. A new host keeps these, whatever its own are.
struct MatchSettings {
  Frame deadline = 0;
  Time silence = 0, patience = 0, exclusion = 0, reservation = 0;  // [us]
  bool asks_admission = false, votes = false, players_set_tempo = false, repair = false;

  friend bool operator==(const MatchSettings&, const MatchSettings&) = default;
};
/// Copies the members of MatchSettings, which SessionConfig has by the same names.
template <class From, class To> void copy_match_settings(const From& from, To& to) {
  to.deadline = from.deadline;
  to.silence = from.silence;
  to.patience = from.patience;
  to.exclusion = from.exclusion;
  to.reservation = from.reservation;
  to.asks_admission = from.asks_admission;
  to.votes = from.votes;
  to.players_set_tempo = from.players_set_tempo;
  to.repair = from.repair;
}

/// The machines of a match. The host sends it to all, so that they find each other once it is gone. To go on without it
/// takes a majority of the machines in the match, and one of those in the roster before. So no two groups apart from
/// each other both have one while one roster replaces the other. Source: Ongaro, Ousterhout 2014, In search of an
/// understandable consensus algorithm, sec. 6 (joint consensus).
struct Roster {
  struct Machine {
    std::uint32_t players = 0;  // a bit each; none: a host without players
    std::uint64_t proof = 0;    // of their token
    /// The host's number of its process. A process that starts again with the same token remembers nothing of what it
    /// said, and is no voter of this roster.
    std::uint64_t life = 0;
    bool is_in = false, was_in = false;
    Address address;  // empty: it cannot be the host
    /// The host's seal of the whole roster, made with the players' token. With it this machine trusts the roster when
    /// another one passes it on. 0: the host does not know the token.
    std::uint64_t seal = 0;
  };
  std::uint32_t term = 0;     // of the host that says it
  std::uint32_t version = 0;  // 0: there is none yet
  MatchSettings settings;
  std::uint8_t host = 0;  // its place among the machines
  /// `casting`: the index of the host that made this roster; with its vote a half of the machines in it is a majority.
  /// `was_casting`: the same for the roster before. An elected host keeps both until its own roster.
  std::uint8_t casting = 0, was_casting = 0;
  static constexpr std::uint8_t kNoCasting = 0xff;  // was_casting: it is not among the machines any more
  std::uint8_t count = 0;
  Machine machines[kMaxPlayers + 1];

  /// Returns the machine with this token; -1: none has it.
  int machine_of(std::uint64_t token) const;
  /// Returns it only if its process has this life, so it remembers and has a vote; else -1.
  int voter_of(std::uint64_t token, std::uint64_t life) const;
  bool is_newer_than(const Roster& other) const {
    return term != other.term ? term > other.term : version > other.version;
  }
  /// All machines of this roster and of the one before, a bit each.
  std::uint64_t voters() const;
  int machine_of_proof(std::uint64_t proof) const;
  int machine_with(int player) const;
  /// Returns true if its machines have only players of a match of so many.
  bool is_of(int players) const;
  int count_in() const;
  /// Returns true for more than half of this roster and of the one before; the casting vote decides a tie.
  bool is_majority(std::uint64_t machines) const;
  /// Returns true for a majority, or if all other voters are `over`: known to remember nothing.
  bool is_quorum(std::uint64_t machines, std::uint64_t over) const;
};
/// Returns the seal of the roster for this token. Overwrites `scratch`.
std::uint64_t seal_of(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch);
bool is_sealed_for(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch);

void write_roster(const Roster& roster, std::vector<std::uint8_t>& out);
Result<Roster> read_roster(Bytes message);

}  // namespace isostep
