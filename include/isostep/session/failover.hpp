// Failover: what a client keeps to go on without its host, and what passes between the parts that it then plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/session/election.hpp"
#include "isostep/session/message.hpp"
#include "isostep/session/peer_link.hpp"

namespace isostep {

/// A machine that connected to a client: it has lost the host, and would have us as the next or be told where that is.
struct Caller {
  bool is_connected = false;
  Time since = 0;                   // [us] when it connected
  std::vector<std::uint8_t> hello;  // empty: not yet
  int machine = -1;                 // its place in our roster; -1: none, a spectator
  int voter = -1;                   // likewise, if its process remembers the match
  bool must_tell_roster = false, must_ask = false, must_redirect = false;
  Allowance messages;
};

/// A client looks for the host that follows the one it lost: the Election says whom it asks, and whether it is the one.
struct Failover {
  Roster roster;
  Election election;
  std::uint64_t life = 0;  // of our process, as the host numbered it; 0: it knows no host yet
  bool must_enroll = false;
  bool is_elected = false;
  // Candidate: where the inputs end that we have of the host, and those that the players' own machines told us since.
  Frame ends[kMaxPlayers] = {}, told[kMaxPlayers] = {};
  bool has_asked = false;  // so what follows these ends is no host's word yet
  bool must_connect = false;
  Address target;
  std::vector<Caller> callers;  // by PeerId

  // To the candidate that we are connected to, once it has asked.
  bool must_support = false, must_tell_roster = false;
  bool must_call_here = false;  // its log is of an earlier host than ours: it comes to us instead
  Candidate candidate;
  Address better;  // where a candidate sends its callers: to the one that said so
  void answer_nothing() { must_support = must_tell_roster = must_call_here = false; }

  bool seeks() const { return election.is_under_way(); }
};

/// What a host takes over from the client that it was.
struct Succession {
  Roster roster;
  int machine = -1;  // our place in it
  std::uint64_t token = 0, life = 0;
  Election election;
  std::vector<Caller> callers;
};

/// What a client takes over from the host that it was.
struct Retreat {
  Roster roster;
  std::uint32_t players = 0;  // ours, a bit each
  std::uint64_t token = 0, life = 0;
  Election election;
  std::uint64_t over = 0;      // machines that left, a bit each
  std::vector<PeerId> guests;  // whose connections end
  bool is_outvoted = false;    // our states are wrong: we need those of who follows us
};

}  // namespace isostep
