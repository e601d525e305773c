// Repair: a client in the match takes a state of the host's again, and steps from there to where it was.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/packet.hpp"

namespace isostep {

/// From a client: it would have a state of the host's.
void write_resync(std::vector<std::uint8_t>& out);

/// The host's answer; pieces of the state follow.
struct RepairOffer {
  HashReport start;
  std::uint64_t hash = 0;           // of the state `start.frame`
  std::uint32_t snapshot_size = 0;  // [bytes] 0: the host's game has no portable form
};
void write_offer(const RepairOffer& offer, std::vector<std::uint8_t>& out);
Result<RepairOffer> read_offer(Bytes message);

/// From the client to the host, and from it to all: what `player` says of its states up to `after` was of before.
struct Repaired {
  std::uint8_t player = 0xff;  // from a client: its own, 0xff
  Frame after = kNoFrame;
};
void write_repaired(const Repaired& repaired, std::vector<std::uint8_t>& out);
Result<Repaired> read_repaired(Bytes message);

/// The client's part. It plays on in its own states until the whole of the host's has arrived. From then on it steps
/// the frames since as fast as it can, while its player's inputs go on at the pace of the match: nobody else notices.
struct Repair {
  enum class Stage : std::uint8_t {
    none,
    asks,      // must send the request
    waits,     // for the host's answer
    receives,  // the snapshot's pieces
    restores   // the game was given the state, and its hash is not known yet
  };
  Stage stage = Stage::none;
  RepairOffer offer;
  Frame after = kNoFrame;  // the newest state that was final before
  bool must_tell = false;  // that it is done
  Frame present = 0;       // the frame that would be next by now; above the current one frames are stepped again
};

}  // namespace isostep
