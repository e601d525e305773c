// Tempo: whether the match goes on, and how fast, from a frame on: the same on all machines, and none of its hashes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// A pause or speed. The host announces it in its datagrams, for a frame that nobody reaches without hearing of it.
struct Tempo {
  static constexpr int kNormal = 8, kSlowest = 4, kFastest = 16;  // [1/8 of the match's rate]

  std::uint32_t number = 0;  // of the change; 0: there was none
  Frame from = 0;
  std::uint8_t speed = kNormal;  // [1/8] kSlowest to kFastest
  bool is_paused = false;        // no frame is stepped; it goes on at that speed
  std::uint8_t by = 0xff;        // the player who asked for it; 0xff: the host's game

  bool same_as(const Tempo& other) const { return speed == other.speed && is_paused == other.is_paused; }
  static constexpr bool is_speed(int speed) { return speed >= kSlowest && speed <= kFastest; }
};

}  // namespace isostep
