// A client in the match takes a state of the host's again: what it and the host say of that.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/protocol/packet.hpp"

namespace isostep {

/// From a client: it asks for a state of the host's.
void write_resync(std::vector<std::uint8_t>& out);

/// The host's answer. The pieces of the state follow.
struct RepairOffer {
  HashReport start;
  std::uint64_t hash = 0;           // of the state `start.frame`
  std::uint32_t snapshot_size = 0;  // [bytes] 0: the host's game has no portable form
};
void write_offer(const RepairOffer& offer, std::vector<std::uint8_t>& out);
Result<RepairOffer> read_offer(Bytes message);

/// From the client to the host, and from it to all: reports of `player` on states up to `after` predate its repair.
struct Repaired {
  std::uint8_t player = 0xff;  // from a client: its own, 0xff
  Frame after = kNoFrame;
};
void write_repaired(const Repaired& repaired, std::vector<std::uint8_t>& out);
Result<Repaired> read_repaired(Bytes message);

}  // namespace isostep
