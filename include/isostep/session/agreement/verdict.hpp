// Verdict: when machines differ, which of them are wrong: what each says of one state, and what most of them say.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/protocol/packet.hpp"

namespace isostep {

/// The machines of a match are numbered by their first player; the host's machine, with players or without, comes last.
inline constexpr std::size_t kHostMachine = kMaxPlayers;
inline constexpr std::size_t kMachines = kMaxPlayers + 1;

/// Holds what the machines of a match say of state `frame`.
struct Statements {
  struct One {
    bool is_asked = false;    // it is in the match
    bool has_spoken = false;  // and has said which hash chain it has
    std::uint64_t chain = 0;
  };
  Frame frame = kNoFrame;
  One of[kMachines];
};

struct Verdict {
  bool is_decided = false;     // more than half of all that were asked have the same chain
  std::uint64_t minority = 0;  // who has another, a bit for each machine; who said nothing is not in it
  std::uint64_t chain = 0;     // of the majority
};
/// Decides by a majority of all asked machines. Two that differ, or four in two pairs, give no verdict.
Verdict judge(const Statements& statements);

/// From the host, to all who are in the match: asks for the hash chain of a state.
void write_inquiry(Frame state, std::vector<std::uint8_t>& out);
Result<Frame> read_inquiry(Bytes message);

/// A client's answer to an inquiry.
struct Statement {
  Frame frame = kNoFrame;
  bool is_known = false;  // false: it came later than that state, or keeps its chain no more
  std::uint64_t chain = 0;
};
void write_statement(const Statement& statement, std::vector<std::uint8_t>& out);
Result<Statement> read_statement(Bytes message);

/// From the host, to all: what each machine said. Each judges it by itself, so all reach the same verdict.
void write_statements(const Statements& statements, std::vector<std::uint8_t>& out);
Result<Statements> read_statements(Bytes message);

}  // namespace isostep
