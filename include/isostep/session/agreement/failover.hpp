// What passes between the parts that a machine plays when a match goes on without its host.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "isostep/session/agreement/election.hpp"
#include "isostep/session/protocol/allowance.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// A machine that connected to a client. It lost the host, and asks for the next one: this client, or its address.
struct Caller {
  bool is_connected = false;
  Time since = 0;                   // [us] when it connected
  std::vector<std::uint8_t> hello;  // empty: not yet
  int machine = -1;                 // its place in our roster; -1: none, a spectator
  int voter = -1;                   // likewise, if its process remembers the match
  Outbox<MessageKind> due;
  Allowance messages;
};

/// Holds what a host takes over from the client that it was.
struct Succession {
  Roster roster;
  int machine = -1;  // our place in it
  std::uint64_t token = 0, life = 0;
  Election election;
  std::vector<Caller> callers;
  std::optional<PeerId> asked{};  // whom we asked to be our host since we called; its connection ends
};

/// Holds what a client takes over from the host that it was.
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
