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

/// What who knows the token of a player can show, and who knows only this cannot compute: a host that follows another
/// recognises its players, and they cannot pass for each other.
std::uint64_t proof_of(std::uint64_t token);

/// What a match is played by, as its host configures it: who follows it goes on with these, whatever its own are.
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

/// The host tells it to all, so that they find each other once it is gone. Who may go on without it is decided by
/// majorities, of the machines in the match now and of those before: while the one roster takes the place of the other
/// no two groups apart from each other can both have one. Source: Ongaro, Ousterhout 2014, In search of an
/// understandable consensus algorithm, sec. 6 (joint consensus).
struct Roster {
  struct Machine {
    std::uint32_t players = 0;  // a bit each; none: a host without players
    std::uint64_t proof = 0;    // of their token
    /// Of its process, as the host numbered it: who starts again with the same token remembers nothing of what it said,
    /// and is no voter of this roster.
    std::uint64_t life = 0;
    bool is_in = false, was_in = false;
    Address address;  // empty: it cannot be the host
    /// Of the whole roster, by the host, with the players' token: so this machine knows what the host has said when it
    /// hears it of another. 0: the host does not know the token.
    std::uint64_t seal = 0;
  };
  std::uint32_t term = 0;     // of the host that says it
  std::uint32_t version = 0;  // 0: there is none yet
  MatchSettings settings;
  std::uint8_t host = 0;  // its place among the machines
  /// The place of the host that made the roster: its vote makes a half of those that are in a majority; and that of the
  /// one before, among those that were. A host that is elected takes over both as they are, until its own roster.
  std::uint8_t casting = 0, was_casting = 0;
  static constexpr std::uint8_t kNoCasting = 0xff;  // was_casting: it is not among the machines any more
  std::uint8_t count = 0;
  Machine machines[kMaxPlayers + 1];

  /// Whose token this is; -1: nobody's.
  int machine_of(std::uint64_t token) const;
  /// Likewise, of a process that remembers: one that has a vote.
  int voter_of(std::uint64_t token, std::uint64_t life) const;
  bool is_newer_than(const Roster& other) const {
    return term != other.term ? term > other.term : version > other.version;
  }
  /// All that are in or were, a bit each.
  std::uint64_t voters() const;
  int machine_of_proof(std::uint64_t proof) const;
  int machine_with(int player) const;
  /// True if its machines have players of a match of so many.
  bool is_of(int players) const;
  int count_in() const;
  /// More than half of those that are in, and of those that were, a bit each, or half with the casting vote.
  bool is_majority(std::uint64_t machines) const;
  /// A majority; or all that remember anything, where of the others it is known that they do not: `over`.
  bool is_quorum(std::uint64_t machines, std::uint64_t over) const;
};
/// `scratch` is written over.
std::uint64_t seal_of(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch);
bool is_sealed_for(const Roster& roster, std::uint64_t token, std::vector<std::uint8_t>& scratch);

void write_roster(const Roster& roster, std::vector<std::uint8_t>& out);
Result<Roster> read_roster(Bytes message);

}  // namespace isostep
