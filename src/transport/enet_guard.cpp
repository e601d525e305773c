// Walks the commands of one ENet packet.
// SPDX-License-Identifier: MIT
#include "transport/enet_guard.hpp"

#include <enet/enet.h>

#include <cstring>

#include "transport/endpoint.hpp"

namespace isostep::transport {
namespace {

constexpr std::size_t kSizes[ENET_PROTOCOL_COMMAND_COUNT] = {
    0,
    sizeof(ENetProtocolAcknowledge),
    sizeof(ENetProtocolConnect),
    sizeof(ENetProtocolVerifyConnect),
    sizeof(ENetProtocolDisconnect),
    sizeof(ENetProtocolPing),
    sizeof(ENetProtocolSendReliable),
    0,  // SEND_UNRELIABLE
    sizeof(ENetProtocolSendFragment),
    sizeof(ENetProtocolSendUnsequenced),
    sizeof(ENetProtocolBandwidthLimit),
    sizeof(ENetProtocolThrottleConfigure),
    0,  // SEND_UNRELIABLE_FRAGMENT
};

static_assert(kEnetPiece ==
              kEnetMtu - sizeof(ENetProtocolHeader) - sizeof(enet_uint32) - sizeof(ENetProtocolSendFragment));
static_assert(cap_of(Channel::datagram) + sizeof(ENetProtocolHeader) + sizeof(ENetProtocolSendUnsequenced) <= kEnetMtu);

template <class Command> Command read(Bytes at) {
  Command command;
  std::memcpy(&command, at.data(), sizeof command);
  return command;
}

bool is_plausible(const ENetProtocolConnect& connect) {
  return ENET_NET_TO_HOST_32(connect.mtu) == kEnetMtu && ENET_NET_TO_HOST_32(connect.channelCount) == kEnetChannels;
}
bool is_plausible(const ENetProtocolSendFragment& fragment) {
  const std::size_t total = ENET_NET_TO_HOST_32(fragment.totalLength);
  return total <= cap_of(Channel::reliable) &&
         ENET_NET_TO_HOST_32(fragment.fragmentCount) == (total + kEnetPiece - 1) / kEnetPiece;
}

/// Bytes of the command and its message; 0 when it is not plausible.
std::size_t length_of(Bytes at) {
  if (at.size() < sizeof(ENetProtocolCommandHeader)) return 0;
  const std::uint32_t number = at[0] & ENET_PROTOCOL_COMMAND_MASK;
  if (number >= ENET_PROTOCOL_COMMAND_COUNT || kSizes[number] == 0 || at.size() < kSizes[number]) return 0;
  std::size_t message = 0;
  if (number == ENET_PROTOCOL_COMMAND_CONNECT && !is_plausible(read<ENetProtocolConnect>(at))) return 0;
  if (number == ENET_PROTOCOL_COMMAND_SEND_RELIABLE) {
    message = ENET_NET_TO_HOST_16(read<ENetProtocolSendReliable>(at).dataLength);
  }
  if (number == ENET_PROTOCOL_COMMAND_SEND_UNSEQUENCED) {
    message = ENET_NET_TO_HOST_16(read<ENetProtocolSendUnsequenced>(at).dataLength);
  }
  if (number == ENET_PROTOCOL_COMMAND_SEND_FRAGMENT) {
    const auto fragment = read<ENetProtocolSendFragment>(at);
    if (!is_plausible(fragment)) return 0;
    message = ENET_NET_TO_HOST_16(fragment.dataLength);
  }
  const std::size_t length = kSizes[number] + message;
  return length <= at.size() ? length : 0;
}

}  // namespace

bool is_plausible_enet_packet(Bytes packet) {
  if (packet.size() < 2 || packet.size() > kEnetMtu) return false;
  const std::uint32_t flags = std::uint32_t{packet[0]} << 8 | packet[1];
  if ((flags & ENET_PROTOCOL_HEADER_FLAG_COMPRESSED) != 0) return false;
  const std::size_t header = (flags & ENET_PROTOCOL_HEADER_FLAG_SENT_TIME) != 0 ? 4 : 2;
  if (packet.size() < header) return false;
  Bytes left = packet.subspan(header);
  for (int commands = 0; !left.empty(); ++commands) {
    const std::size_t length = length_of(left);
    if (length == 0 || commands == ENET_PROTOCOL_MAXIMUM_PACKET_COMMANDS) return false;
    left = left.subspan(length);
  }
  return true;
}

}  // namespace isostep::transport
