// Guards of ENet: it reads only what our peers put on the wire, so that a hostile peer cannot fill its memory.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/core/bytes.hpp"
#include "transport/line_guard.hpp"

namespace isostep::transport {

/// [bytes] The largest UDP payload that every IPv6 path carries whole (1280 - 40 - 8).
inline constexpr std::size_t kPacketCap = 1232;
/// [bytes] The part of it that is ENet's, beside a tag. It holds a datagram of ours with ENet's 12 bytes around it.
inline constexpr std::uint32_t kEnetMtu = kPacketCap - LineTags::kSize;
/// [bytes] Reliable messages that are larger go in fragments: beside a header, its checksum and a fragment's command.
inline constexpr std::size_t kEnetPiece = kEnetMtu - 4 - 4 - 24;
inline constexpr std::size_t kEnetChannels = 2;

/// Refuses what ENet 1.3.17 would accept and no peer of ours sends: packets above the MTU or of more commands than ENet
/// writes, compressed ones, unreliable sequenced messages (those that are skipped stay counted as waiting until the
/// peer is stuck), messages above their channel's cap, fragments that announce more pieces than there can be (a bit
/// each, 128 KiB a command), connections with another MTU or number of channels; and what is not whole.
bool is_plausible_enet_packet(Bytes packet);

}  // namespace isostep::transport
