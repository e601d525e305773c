// Failover: what a client keeps to go on without its host, and what passes between the parts that it then plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/session/message.hpp"
#include "isostep/session/peer_link.hpp"

namespace isostep {

/// A machine that connected to a client: it has lost the host, and would have us as the next or be told where that is.
struct Caller {
  bool is_connected = false;
  Time since = 0;                   // [us] when it connected
  std::vector<std::uint8_t> hello;  // empty: not yet
  int machine = -1;                 // its place in our roster; -1: none, a spectator
  bool must_tell_roster = false, must_ask = false, must_redirect = false;
  bool supports = false;
  Allowance messages;
};

/// A client looks for the host that follows the one it lost. All have the same roster, so they ask the same machines in
/// the same order, each for a while, beginning with the lowest player. Who is asked first and has lost the host as well
/// is a candidate; with the support of a majority it becomes the host. Everybody supports one candidate at a time, and
/// only as long as it is connected to it.
struct Failover {
  Roster roster;
  bool is_roster_old = false;  // of the host that we had before
  bool must_enroll = false;

  bool seeks = false;  // what follows is of this time
  Time since = 0;      // [us]
  Time until = 0;      // [us] of this attempt
  std::uint32_t attempt = 0;
  bool is_candidate = false;
  Time elected_at = 0;  // [us] when we had a majority; 0: not yet
  bool is_elected = false;
  // Candidate: where the inputs end that we have of the host, and those that the players' own machines told us since.
  Frame ends[kMaxPlayers] = {}, told[kMaxPlayers] = {};
  bool must_connect = false;
  Address target;
  std::vector<Caller> callers;  // by PeerId

  // To the candidate that we are connected to, once it has asked.
  bool must_support = false, must_tell_roster = false;
  Candidate candidate;

  /// The n-th to be asked; -1: there is none.
  int candidate_at(std::uint32_t n) const {
    std::uint32_t count = 0;
    for (int m = 0; m < roster.count; ++m) count += is_eligible(m) ? 1 : 0;
    if (count == 0) return -1;
    n %= count;
    for (int m = 0;; ++m) {
      if (is_eligible(m) && n-- == 0) return m;
    }
  }
  bool is_eligible(int machine) const {
    const Roster::Machine& its = roster.machines[machine];
    return machine != roster.host && its.is_in && its.players != 0 && !its.address.view().empty();
  }
};

/// What a host takes over from the client that it was.
struct Succession {
  Roster roster;
  int machine = -1;  // our place in it
  std::uint64_t token = 0;
  std::vector<Caller> callers;
};

/// What a client takes over from the host that it was.
struct Retreat {
  Roster roster;
  std::uint32_t players = 0;  // ours, a bit each
  std::uint64_t token = 0;
  std::vector<PeerId> guests;  // whose connections end
  bool is_outvoted = false;    // our states are wrong: we need those of who follows us
};

}  // namespace isostep
