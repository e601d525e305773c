// SavedMatch: a match that its host put away, with the seats of its players, for another process to go on with.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/session/protocol/packet.hpp"
#include "isostep/state/replay_header.hpp"

namespace isostep {

/// The version of the format. A match of another version is refused by name.
inline constexpr std::uint16_t kSavedMatchVersion = 3;

struct SavedMatch {
  ReplayHeader identity;     // of the match, as SessionConfig's
  HashReport start;          // the state with which it goes on, and the chain of all before
  std::uint64_t hash = 0;    // of that state
  std::uint32_t hosted = 0;  // players of the host's machine, a bit each
  std::uint8_t speed = 0;    // [1/8 of the match's rate]
  std::uint32_t term = 0;    // of its host: see AGREEMENT.md. Who goes on with it has the next
  std::uint8_t players = 0;
  /// The proof of each seat's player, see proof_of: it does not reveal the token. 0: a free seat, or the host's.
  std::uint64_t proofs[kMaxPlayers] = {};
  std::vector<std::uint8_t> state;  // portable
};

/// Writes little-endian, with a hash of all bytes at the end. Replaces the content of `out`.
void write_saved_match(const SavedMatch& match, std::vector<std::uint8_t>& out);
/// Reads a saved match. If the bytes are damaged, the error names what does not fit.
Result<SavedMatch> read_saved_match(Bytes bytes);

}  // namespace isostep
