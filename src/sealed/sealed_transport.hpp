// SealedTransport: encrypts and authenticates what goes over any other transport, with keys of the game's lobby.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "sealed/sealed_link.hpp"
#include "transport/endpoint.hpp"

namespace isostep::sealed {

static_assert(SealedLink::kSeal <= transport::kSealRoom);

struct SealSettings {
  std::vector<LobbyKey> keys;    // that others may show, and we
  std::uint64_t own_key = 0;     // by its id: with which we connect
  Time handshake = 2 * kSecond;  // [us] until a connection is given up on which no handshake ends
};

/// The counts of what was refused, and changed nothing.
struct SealStatistics {
  std::uint64_t truncated = 0, forged = 0, replayed = 0;  // see Opened
  std::uint64_t early = 0;                                // datagrams before their connection's keys are agreed upon
  std::uint64_t handshakes = 0;  // connections that ended because the other side does not show a key, or not in time
  std::uint64_t displaced = 0;   // connections that ended because a reliable message was not the sender's next
};

/// Models Endpoint, and Connector over one. The caller drives `inner` as without: poll, flush, wait. PeerIds are those
/// of `inner`. A session's largest messages pass, for transports carry kSealRoom bytes more. Nothing is allocated for a
/// datagram or a message; each PeerId that ever was has a link of 0.5 KB.
template <transport::Endpoint Inner> class SealedTransport {
 public:
  /// `inner` outlives it.
  SealedTransport(Inner& inner, const SealSettings& settings) : inner_(inner), settings_(settings) {}
  SealedTransport(const SealedTransport&) = delete;
  SealedTransport& operator=(const SealedTransport&) = delete;

  Result<void> send(PeerId peer, Channel channel, Bytes bytes);
  std::optional<transport::Arrival> receive();
  void disconnect(PeerId peer) {
    forget(peer);
    inner_.disconnect(peer);
  }
  Result<void> connect_to(std::string_view address) requires transport::Connector<Inner> {
    return inner_.connect_to(address);
  }
  /// Sets the key of the connections that we ask for from now on: where each two machines have a key, before
  /// connecting.
  void set_own_key(std::uint64_t id) { settings_.own_key = id; }
  /// Ends handshakes that take too long; called once a turn, before receive(). transport::deliver does it.
  void tend(Time now);

  /// The key that the peer has shown. Where each player has a key of its own, it says who that is.
  std::optional<std::uint64_t> key_of(PeerId peer) const {
    if (peer >= links_.size() || links_[peer].seal.stage() != SealedLink::Stage::open) return std::nullopt;
    return links_[peer].seal.key_id();
  }
  const SealStatistics& statistics() const { return statistics_; }

 private:
  using Arrival = transport::Arrival;
  using ArrivalKind = transport::ArrivalKind;

  struct Link {
    SealedLink seal;
    bool is_connected = false;  // by `inner`
    bool incoming = false;
    Time since = 0;  // [us]
  };

  const LobbyKey* find_key(std::uint64_t id) const {
    for (const LobbyKey& key : settings_.keys) {
      if (key.id == id) return &key;
    }
    return nullptr;
  }
  void forget(PeerId peer);
  std::optional<Arrival> take(const Arrival& arrival);
  std::optional<Arrival> begin(const Arrival& arrival);
  std::optional<Arrival> take_handshake(Link& link, PeerId peer, Bytes bytes);
  std::optional<Arrival> open(Link& link, const Arrival& arrival);
  bool answer(Link& link, PeerId peer, Bytes hello);
  bool confirm(Link& link, PeerId peer, Bytes reply);
  /// Ends a connection of which the session knows, or that it asked for; others it never hears of.
  std::optional<Arrival> fail(Link& link, PeerId peer, std::uint64_t& count);

  Inner& inner_;
  SealSettings settings_;
  SealStatistics statistics_;
  std::vector<Link> links_;   // by PeerId
  std::deque<PeerId> ended_;  // of which receive() has yet to tell
  Time now_ = 0;
  std::uint8_t sealed_[kReliableCap + SealedLink::kSeal];
  std::uint8_t opened_[kReliableCap + SealedLink::kSeal];  // what the last receive() shows
};

template <transport::Endpoint Inner>
Result<void> SealedTransport<Inner>::send(PeerId peer, Channel channel, Bytes bytes) {
  if (bytes.size() > (channel == Channel::datagram ? kDatagramCap : kReliableCap)) {
    return Error{ErrorCode::limit, "the message is larger than its channel's cap", "send"};
  }
  if (!key_of(peer)) return Error{ErrorCode::invalid, "the peer is not connected", "send"};
  if (!links_[peer].seal.seal(channel, bytes, sealed_)) {
    disconnect(peer);
    ended_.push_back(peer);
    return Error{ErrorCode::limit, "2^32 messages were sealed: the connection ends", "send"};
  }
  return inner_.send(peer, channel, {sealed_, bytes.size() + SealedLink::kSeal});
}

template <transport::Endpoint Inner> std::optional<transport::Arrival> SealedTransport<Inner>::receive() {
  if (!ended_.empty()) {
    const PeerId peer = ended_.front();
    ended_.pop_front();
    return Arrival{ArrivalKind::disconnected, peer, Channel::reliable, {}};
  }
  while (const std::optional<Arrival> arrival = inner_.receive()) {
    if (const std::optional<Arrival> shown = take(*arrival)) return shown;
  }
  return std::nullopt;
}

template <transport::Endpoint Inner> void SealedTransport<Inner>::tend(Time now) {
  now_ = now;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& link = links_[i];
    const bool is_late = now - link.since > settings_.handshake && link.seal.stage() != SealedLink::Stage::open;
    if (!link.is_connected || !is_late) continue;
    const auto peer = static_cast<PeerId>(i);
    if (fail(link, peer, statistics_.handshakes)) ended_.push_back(peer);
  }
}

template <transport::Endpoint Inner> void SealedTransport<Inner>::forget(PeerId peer) {
  std::erase(ended_, peer);
  if (peer >= links_.size()) return;
  links_[peer].seal.close();
  links_[peer].is_connected = false;
}

template <transport::Endpoint Inner>
std::optional<transport::Arrival> SealedTransport<Inner>::fail(Link& link, PeerId peer, std::uint64_t& count) {
  ++count;
  const bool is_known = !link.incoming || link.seal.stage() == SealedLink::Stage::open;
  disconnect(peer);
  if (!is_known) return std::nullopt;
  return Arrival{ArrivalKind::disconnected, peer, Channel::reliable, {}};
}

template <transport::Endpoint Inner>
std::optional<transport::Arrival> SealedTransport<Inner>::take(const Arrival& arrival) {
  if (arrival.kind == ArrivalKind::connected) return begin(arrival);
  Link* link = arrival.peer < links_.size() && links_[arrival.peer].is_connected ? &links_[arrival.peer] : nullptr;
  if (arrival.kind == ArrivalKind::disconnected) {
    const bool is_unknown = link != nullptr && link->incoming && link->seal.stage() != SealedLink::Stage::open;
    forget(arrival.peer);
    if (is_unknown) return std::nullopt;
    return arrival;
  }
  if (link == nullptr) return std::nullopt;  // it has ended here
  if (link->seal.stage() == SealedLink::Stage::open) return open(*link, arrival);
  if (arrival.channel == Channel::reliable) return take_handshake(*link, arrival.peer, arrival.bytes);
  ++statistics_.early;
  return std::nullopt;
}

template <transport::Endpoint Inner>
std::optional<transport::Arrival> SealedTransport<Inner>::begin(const Arrival& arrival) {
  if (arrival.peer >= links_.size()) links_.resize(std::size_t{arrival.peer} + 1);
  Link& link = links_[arrival.peer];
  link.seal.close();
  link.is_connected = true;
  link.incoming = arrival.incoming;
  link.since = now_;
  if (link.incoming) return std::nullopt;
  std::uint8_t hello[SealedLink::kHello];
  const LobbyKey* key = find_key(settings_.own_key);
  if (key == nullptr || !link.seal.begin(*key, hello) || !inner_.send(arrival.peer, Channel::reliable, hello).ok()) {
    return fail(link, arrival.peer, statistics_.handshakes);
  }
  return std::nullopt;
}

template <transport::Endpoint Inner> bool SealedTransport<Inner>::answer(Link& link, PeerId peer, Bytes hello) {
  std::uint64_t id = 0;
  if (!SealedLink::read_key_id(hello, id)) return false;
  const LobbyKey* key = find_key(id);
  for (const Link& other : links_) {
    if (other.seal.has_drawn(hello)) return false;
  }
  std::uint8_t reply[SealedLink::kReply];
  return key != nullptr && link.seal.answer(*key, hello, reply) && inner_.send(peer, Channel::reliable, reply).ok();
}

template <transport::Endpoint Inner> bool SealedTransport<Inner>::confirm(Link& link, PeerId peer, Bytes reply) {
  const LobbyKey* key = find_key(link.seal.key_id());
  std::uint8_t nothing[SealedLink::kSeal];
  return key != nullptr && link.seal.take_reply(*key, reply) && link.seal.seal(Channel::reliable, {}, nothing) &&
         inner_.send(peer, Channel::reliable, nothing).ok();
}

template <transport::Endpoint Inner>
std::optional<transport::Arrival> SealedTransport<Inner>::take_handshake(Link& link, PeerId peer, Bytes bytes) {
  bool good = false;
  switch (link.seal.stage()) {
    case SealedLink::Stage::none: good = link.incoming && answer(link, peer, bytes); break;
    case SealedLink::Stage::greeted: good = confirm(link, peer, bytes); break;
    case SealedLink::Stage::answered: good = link.seal.take_confirm(bytes); break;
    case SealedLink::Stage::open: break;
  }
  if (!good) return fail(link, peer, statistics_.handshakes);
  if (link.seal.stage() != SealedLink::Stage::open) return std::nullopt;
  return Arrival{ArrivalKind::connected, peer, Channel::reliable, {}, link.incoming};
}

template <transport::Endpoint Inner>
std::optional<transport::Arrival> SealedTransport<Inner>::open(Link& link, const Arrival& arrival) {
  const std::size_t cap = arrival.channel == Channel::datagram ? kDatagramCap : kReliableCap;
  const std::size_t size = arrival.bytes.size() - std::min(arrival.bytes.size(), SealedLink::kSeal);
  const Opened opened = size > cap ? Opened::forged : link.seal.open(arrival.channel, arrival.bytes, opened_);
  switch (opened) {
    case Opened::good: return Arrival{ArrivalKind::message, arrival.peer, arrival.channel, {opened_, size}};
    case Opened::truncated: ++statistics_.truncated; break;
    case Opened::forged: ++statistics_.forged; break;
    case Opened::replayed: ++statistics_.replayed; break;
    case Opened::displaced: return fail(link, arrival.peer, statistics_.displaced);
  }
  return std::nullopt;
}

}  // namespace isostep::sealed
