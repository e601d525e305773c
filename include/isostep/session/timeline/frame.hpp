// What a session counts in: frames, microseconds, players, peers and the two channels a transport must offer.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/state/frame.hpp"

namespace isostep {

/// [us] since any moment that the caller chooses. It never runs backwards. Sessions have no clock of their own.
using Time = std::uint64_t;
inline constexpr Time kSecond = 1000000;  // [us]

/// A set of players is a word of 32 bits.
inline constexpr std::size_t kMaxPlayers = 32;

/// The transport's number of a connection, below SessionConfig::max_peers + max_strangers. It may be used again once
/// the connection is closed.
using PeerId = std::uint16_t;

enum class Channel : std::uint8_t {
  datagram,  // may be lost, doubled, late or out of order; at most kDatagramCap bytes
  reliable   // arrives whole and in order, or the connection ends; at most kReliableCap bytes
};
inline constexpr std::size_t kDatagramCap = 1180;      // [bytes] sealed it has 1200, below every path's MTU
inline constexpr std::size_t kReliableCap = 16 << 10;  // [bytes] of one message; snapshots are sent in pieces

}  // namespace isostep
