// Endpoints over ENet 1.3.17, the reference for sessions across UDP: no exceptions, no printing, no threads.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "transport/endpoint.hpp"
#include "transport/line_guard.hpp"

namespace isostep::transport {

struct EnetSettings {
  // These are for an endpoint that listens.
  PeerId max_peers = 64;             // those connecting included: the session's max_peers + max_strangers
  PeerId max_peers_an_address = 16;  // of those that others asked for: players behind one router share its address
  std::string bind_address = {};     // empty: every interface
  /// [us] A peer that acknowledges nothing is given up after this, at the next repetition due: at the latest after
  /// twice as long.
  Time timeout = 10 * kSecond;
  std::uint32_t events_per_poll = 1024;       // the rest waits for the next poll
  std::uint32_t datagrams_per_peer = 256;     // in one poll; more are dropped, so that a flood costs only the flooder
  std::size_t unacknowledged_cap = 4u << 20;  // [bytes] sent reliably to one peer; above that its connection ends
  /// That all machines of the match have and nobody else, as sealed::packet_key gives it: who lacks it is no peer, and
  /// whoever is on the line can forge nothing. All zeros: there is none, and peers are who speaks as we do.
  PacketKey key = {};
};

/// Bytes and packets are those of UDP's payload.
struct EnetStatistics {
  std::uint64_t packets_sent = 0, bytes_sent = 0, packets_received = 0, bytes_received = 0;
  std::uint64_t implausible = 0;  // packets thrown away before ENet saw them: forged, sent again, or of no peer's kind
  std::uint64_t refused = 0;      // messages on the wrong channel or above its cap
  std::uint64_t flooded = 0;      // datagrams above datagrams_per_peer
  std::uint64_t socket_errors = 0;  // a network that is down comes back, or the timeout ends its connections
};

/// Models Connector. PeerId is ENet's index of the peer: the lowest free one, 0 on who only connects.
/// A frame: poll(), receive() until it has nothing, the session, send(), flush(); then wait() instead of sleeping.
/// Who does not hear what is sent to an address can say nothing in its name: README. Not secret; see SealedTransport.
/// IPv4 only; see UdpRelay. Time is ENet's: the system's clock, whose jumps count as silence.
class EnetTransport {
 public:
  /// Accepts connections: a host, or a machine that may follow one. Port 0 lets the system choose one.
  static Result<EnetTransport> listen(std::uint16_t port, const EnetSettings& settings = {});
  /// Accepts none, and connects to one host at a time.
  static Result<EnetTransport> connect(const std::string& address, std::uint16_t port,
                                       const EnetSettings& settings = {});
  EnetTransport(EnetTransport&&) noexcept;
  EnetTransport& operator=(EnetTransport&&) noexcept;
  /// Tells connected peers so, without waiting for what is unacknowledged.
  ~EnetTransport();

  /// One more connection: `connected` or `disconnected` follows. An earlier attempt that is under way is given up
  /// without an event. A name is looked up at once, which may block.
  Result<void> connect_to(const std::string& address, std::uint16_t port);
  /// "192.0.2.7:4000", as the others of a match tell. Nothing is looked up: who names it may be hostile.
  Result<void> connect_to(std::string_view address);
  /// Leaves the connection asked for last, without another event of it, and tries the same address again.
  Result<void> connect_again();

  /// The port of who listens.
  std::uint16_t port() const;

  /// Takes what has arrived from the socket, and sends what is due.
  void poll();
  /// Blocks until a packet arrives or this time is over, rounded down to whole milliseconds; not while something is
  /// already there for receive() or poll().
  void wait(Time longest);

  /// Sends in a message's own packet or with others of the same flush.
  Result<void> send(PeerId peer, Channel channel, Bytes bytes);
  void flush();
  std::optional<Arrival> receive();
  void disconnect(PeerId peer);

  const EnetStatistics& statistics() const;

 private:
  struct State;
  explicit EnetTransport(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace isostep::transport
