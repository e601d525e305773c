// A network in virtual time: one host, its clients, two channels between any two, and a seed for all that goes wrong.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "transport/endpoint.hpp"
#include "transport/impaired_direction.hpp"
#include "transport/network_profile.hpp"

namespace isostep::transport {

/// 0 is the host, clients follow in the order in which they were added. Not a PeerId: that is one connection's.
using EndpointId = std::uint32_t;

struct SimulationSettings {
  std::uint64_t seed = 1;
  PeerId max_peers = 64;        // of each endpoint; who comes later is disconnected
  Time timeout = 10 * kSecond;  // a connection ends when one direction lost all that it was given for this long
};

/// The traffic of one client's direction, over all its connections. Bytes are those of messages, without any header.
struct DirectionStatistics {
  std::uint64_t datagrams = 0, datagram_bytes = 0;  // given to send
  std::uint64_t reliable = 0, reliable_bytes = 0;   // given to send
  std::uint64_t packets = 0, packet_bytes = 0;      // on the line: datagrams, pieces of reliable messages
  std::uint64_t repeated = 0;                       // of those, pieces sent again
  std::uint64_t lost = 0, doubled = 0;              // of those
  std::uint64_t delivered = 0;                      // messages of both channels
  std::uint64_t unexpected = 0;                     // datagrams that met a side which is not connected (yet)
};

class SimulatedNetwork {
 public:
  explicit SimulatedNetwork(const SimulationSettings& settings = {});
  SimulatedNetwork(const SimulatedNetwork&) = delete;
  SimulatedNetwork& operator=(const SimulatedNetwork&) = delete;

  /// Models Endpoint. Valid as long as the network.
  class Port {
   public:
    Result<void> send(PeerId peer, Channel channel, Bytes bytes) { return network_->send(id_, peer, channel, bytes); }
    std::optional<Arrival> receive() { return network_->receive(id_); }
    void disconnect(PeerId peer) { network_->disconnect(id_, peer); }

   private:
    friend class SimulatedNetwork;
    Port(SimulatedNetwork* network, EndpointId id) : network_(network), id_(id) {}
    SimulatedNetwork* network_;
    EndpointId id_;
  };

  static constexpr EndpointId kHost = 0;
  /// A process that comes back with a new connection while the host still waits for the old one is a new client.
  EndpointId add_client(const NetworkProfile& profile);
  Port port(EndpointId endpoint) { return Port(this, endpoint); }

  /// Connects to the host, which hears `connected` one way later, the client after a round trip. False while the
  /// client's last connection is not over.
  bool connect(EndpointId client) { return connect(client, kHost); }
  /// Connects to any other, over the line that `from` has to the host, or that `to` has when it is the host that
  /// connects.
  bool connect(EndpointId from, EndpointId to);
  /// Both sides hear `disconnected` now; what was under way is gone.
  void cut(EndpointId client);
  /// Silences an endpoint as if the cable were pulled, or the process had died: every packet from now on is lost until
  /// it is put back.
  void set_silent(EndpointId endpoint, bool silent);
  /// Packets between endpoints of different sides are lost; all are on side 0 at first.
  void set_side(EndpointId endpoint, int side);
  void set_profile(EndpointId client, const NetworkProfile& profile);
  /// Delivers at once, for hostile tests, whatever the connection's state and the channel's cap.
  void inject(EndpointId to, PeerId from, Channel channel, Bytes bytes);

  Time now() const { return now_; }
  /// The time at which something will happen on its own; nothing when the network is idle.
  std::optional<Time> next_event_time() const;
  /// Lets everything due until then happen, in order of time and then of sending. Not before now(). What is due at
  /// once, as all of `loopback` is, happens without it.
  void advance_to(Time time);

  const DirectionStatistics& statistics(EndpointId client, Direction direction) const;
  /// Sends over their channel's cap: a bug of the sender.
  std::uint64_t oversized() const { return oversized_; }
  /// Sends to a peer that is not connected: the sender may not have read its `disconnected` yet.
  std::uint64_t unaddressed() const { return unaddressed_; }

 private:
  using Payload = std::shared_ptr<const std::vector<std::uint8_t>>;

  enum class Content : std::uint8_t { message, hello, welcome, goodbye };
  /// A message on the reliable channel, from its sending to its delivery.
  struct Message {
    Content content;
    std::uint32_t pieces_left;
    Payload payload;
  };
  struct Line {
    ImpairedDirection direction;
    DirectionStatistics statistics;
    std::map<std::uint64_t, Message> messages;  // by number: sent, not delivered
    std::uint64_t next_number = 0;
    std::optional<Time> losing_since;  // [us] first of the losses since something came through
  };
  /// The knowledge of a direction's receiver: the client's of its attempt, either side's that it is connected.
  enum class Ear : std::uint8_t { closed, waiting, open };
  /// A link from an endpoint that connects, up to the one that is connected to.
  struct Link {
    std::size_t number;
    EndpointId ends[2];  // that a direction leads to
    Line lines[2];       // by Direction
    Ear ears[2] = {Ear::closed, Ear::closed};
    std::uint64_t connection = 0;  // counts them: what is under way of an older one is nobody's
    bool active = false;           // from connect() until neither side has to hear anything more
    bool numbered[2] = {};         // the end that a direction leads to has a peer number for the other,
    PeerId peers[2] = {};          // this one
  };
  struct Waiting {
    ArrivalKind kind;
    bool incoming;
    PeerId peer;
    Channel channel;
    Payload payload;
  };
  struct Station {
    NetworkProfile profile;
    std::size_t home = 0;  // of a client: the number of its link to the host
    bool silent = false;
    int side = 0;
    std::vector<Link*> peers;  // by PeerId; null: free
    std::deque<Waiting> inbox;
    Payload handed_out;  // what its last receive() shows
  };

  enum class What : std::uint8_t { datagram_arrives, try_piece, piece_arrives };
  struct Event {
    What what;
    Direction direction;
    std::size_t link;
    std::uint64_t connection;
    Payload payload;           // of a datagram
    std::uint64_t number = 0;  // of a reliable message
    std::uint32_t bytes = 0;   // of its piece
    std::uint32_t attempt = 0;
  };
  Result<void> send(EndpointId from, PeerId peer, Channel channel, Bytes bytes);
  std::optional<Arrival> receive(EndpointId endpoint);
  void disconnect(EndpointId from, PeerId peer);

  /// A client's link to the host, which it has from the beginning.
  Link& home_of(EndpointId client) { return *links_[stations_[client].home]; }
  const Link& home_of(EndpointId client) const { return *links_[stations_[client].home]; }
  Link& link_between(EndpointId from, EndpointId to);
  Link& add_link(EndpointId from, EndpointId to, const NetworkProfile& profile, std::uint64_t stream);
  /// The link on which `from` speaks to `peer`; null when that is not, or no longer, part of a connection.
  Link* link_of(EndpointId from, PeerId peer, Direction& direction);
  bool take_number(Link& link, Direction direction);
  void send_datagram(Link& link, Direction direction, Payload payload);
  void send_reliable(Link& link, Direction direction, Content content, Payload payload);
  Fate put_on_line(Link& link, Direction direction, std::size_t bytes);
  void try_piece(Link& link, Event event);
  void schedule(Time time, Event event);
  void run(const Event& event);
  void piece_arrived(Link& link, const Event& event);
  void deliver(Link& link, Direction direction, const Message& message);
  void answer(Link& link);
  void close(Link& link);
  void finish(Link& link);
  void hang_up(Link& link, Direction direction);
  void arrive(Link& link, Direction direction, ArrivalKind kind, Channel channel, Payload payload);

  SimulationSettings settings_;
  Time now_ = 0;
  std::uint64_t scheduled_ = 0;  // orders what is due at one time
  std::uint64_t oversized_ = 0, unaddressed_ = 0;
  std::map<std::pair<Time, std::uint64_t>, Event> events_;
  std::vector<Station> stations_;             // by endpoint
  std::vector<std::unique_ptr<Link>> links_;  // clients' to the host, and others once they are needed
};

}  // namespace isostep::transport
