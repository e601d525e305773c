// PlayerStats: how well one player's machine keeps up, in whole numbers; the host measures it and tells all.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The figures of one player, which every machine knows. The host measures them and sends them once a second; `early`
/// is measured by each machine itself. The host's own players have no line: its figures are 0.
struct PlayerStats {
  Frame early = 0;             // [frames] by which the latest of a second came before it was needed; negative: late
  std::uint32_t replaced = 0;  // inputs that came after the deadline
  std::uint32_t waited = 0;    // [us] that the others waited for it within the last minute, as patience counts it
  // Of its machine's line, over the last minute; 0 while it has no connection.
  std::uint32_t round_trip = 0;  // [us] to the host and back, smoothed over a few datagrams
  std::uint32_t jitter = 0;  // [us] by which the way of one datagram to the host differs from that of the one before
  std::uint32_t loss = 0;    // [permille] of its datagrams that the host did not get
};

}  // namespace isostep
