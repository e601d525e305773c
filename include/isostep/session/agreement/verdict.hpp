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

/// What the machines of a match say of the state `frame`.
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
/// Of two machines that differ none is in the minority, and of four no two.
Verdict judge(const Statements& statements);

/// From the host, to all who are in the match: which hash chain has this state?
void write_inquiry(Frame state, std::vector<std::uint8_t>& out);
Result<Frame> read_inquiry(Bytes message);

/// From a client, as the answer.
struct Statement {
  Frame frame = kNoFrame;
  bool is_known = false;  // false: it came later than that state, or keeps its chain no more
  std::uint64_t chain = 0;
};
void write_statement(const Statement& statement, std::vector<std::uint8_t>& out);
Result<Statement> read_statement(Bytes message);

/// From the host, to everybody: who said what. Each judges by itself, so all come to the same verdict.
void write_statements(const Statements& statements, std::vector<std::uint8_t>& out);
Result<Statements> read_statements(Bytes message);

}  // namespace isostep
