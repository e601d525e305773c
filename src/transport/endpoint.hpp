// The concept of an endpoint, the same for every way from session to session: send, receive, end a connection.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep::transport {

/// `connected` is followed by messages, `disconnected` by nothing until the id is connected again. An attempt to
/// connect that fails is a `disconnected` without a `connected`.
enum class ArrivalKind : std::uint8_t { connected, disconnected, message };

struct Arrival {
  ArrivalKind kind;
  PeerId peer;
  Channel channel;        // of a message
  Bytes bytes;            // of a message; until the next call of the endpoint
  bool incoming = false;  // of a connection: the other side asked for it
};

/// `send` refuses what is larger than the channel's cap and peers that are not connected. `disconnect` is for this side
/// at once: the peer still gets what was sent reliably before, then its `disconnected`; here nothing more arrives.
template <class E>
concept Endpoint = requires(E& endpoint, PeerId peer, Channel channel, Bytes bytes) {
  { endpoint.send(peer, channel, bytes) } -> std::same_as<Result<void>>;
  { endpoint.receive() } -> std::same_as<std::optional<Arrival>>;
  { endpoint.disconnect(peer) } -> std::same_as<void>;
};

/// An endpoint that also connects to the machines whose addresses a session names when its host is gone: text as this
/// transport writes it, which each machine gives its session as SessionConfig::address. `connected` or `disconnected`
/// follows.
template <class E>
concept Connector = Endpoint<E> && requires(E& endpoint, std::string_view address) {
  { endpoint.connect_to(address) } -> std::same_as<Result<void>>;
};

/// [bytes] that transports carry beside a session's largest message, for an adapter that seals it.
inline constexpr std::size_t kSealRoom = 20;

inline constexpr std::size_t cap_of(Channel channel) {
  return (channel == Channel::datagram ? kDatagramCap : kReliableCap) + kSealRoom;
}

}  // namespace isostep::transport
