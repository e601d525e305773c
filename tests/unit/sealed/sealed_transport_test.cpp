// Sealed endpoints over the simulated network: who gets in, what is refused, and what it does not change.
// SPDX-License-Identifier: MIT
#include "sealed/sealed_transport.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "transport/enet_transport.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::sealed {
namespace sealed_transport_test {

using transport::Arrival;
using transport::ArrivalKind;
using transport::EndpointId;
using transport::SimulatedNetwork;
using Port = SimulatedNetwork::Port;
using Bytevec = std::vector<std::uint8_t>;
constexpr Time kMs = 1000;

static_assert(transport::Endpoint<SealedTransport<Port>> && !transport::Connector<SealedTransport<Port>>);
static_assert(transport::Connector<SealedTransport<transport::EnetTransport>>);

SealSettings settings_of(std::uint64_t id, std::uint8_t fill) {
  SealSettings settings{.keys = {{.id = id, .secret = {}}}, .own_key = id};
  settings.keys[0].secret.fill(fill);
  return settings;
}

struct Side {
  Side(SimulatedNetwork& network, EndpointId its_id, const SealSettings& settings)
      : id(its_id), port(network.port(its_id)), sealed(port, settings) {}

  void turn(Time now) {
    sealed.tend(now);
    while (const std::optional<Arrival> arrival = sealed.receive()) {
      ++counts[static_cast<std::size_t>(arrival->kind)];
      if (arrival->kind == ArrivalKind::connected) incoming = arrival->incoming;
      if (arrival->kind == ArrivalKind::message) heard.emplace_back(arrival->bytes.begin(), arrival->bytes.end());
    }
  }
  int count(ArrivalKind kind) const { return counts[static_cast<std::size_t>(kind)]; }

  EndpointId id;
  Port port;
  SealedTransport<Port> sealed;
  int counts[3] = {};
  bool incoming = false;
  std::vector<Bytevec> heard;
};

/// A host, and a client that tries to connect.
struct Pair {
  explicit Pair(const SealSettings& client_settings = settings_of(7, 1), const char* line = "latency=20")
      : client_id(network.add_client(transport::parse_profile(line).value())),
        host(network, SimulatedNetwork::kHost, settings_of(7, 1)),
        client(network, client_id, client_settings) {
    network.connect(client_id);
    pass(kSecond);
  }
  void pass(Time time) {
    for (const Time end = network.now() + time; network.now() < end;) {
      network.advance_to(network.now() + kMs);
      host.turn(network.now());
      client.turn(network.now());
    }
  }
  SimulatedNetwork network;
  EndpointId client_id;
  Side host, client;
};

TEST(SealedTransport, CarriesASessionsLargestMessagesBothWays) {
  Pair pair;
  EXPECT_EQ(pair.host.count(ArrivalKind::connected), 1);
  EXPECT_EQ(pair.client.count(ArrivalKind::connected), 1);
  EXPECT_TRUE(pair.host.incoming);
  EXPECT_FALSE(pair.client.incoming);
  EXPECT_EQ(pair.host.sealed.key_of(0), 7u);
  for (Side* side : {&pair.host, &pair.client}) {
    EXPECT_TRUE(side->sealed.send(0, Channel::datagram, Bytevec(kDatagramCap, 1)).ok());
    EXPECT_TRUE(side->sealed.send(0, Channel::reliable, Bytevec(kReliableCap, 2)).ok());
    EXPECT_TRUE(side->sealed.send(0, Channel::reliable, {}).ok());
    EXPECT_EQ(side->sealed.send(0, Channel::datagram, Bytevec(kDatagramCap + 1)).error().code, ErrorCode::limit);
    EXPECT_EQ(side->sealed.send(0, Channel::reliable, Bytevec(kReliableCap + 1)).error().code, ErrorCode::limit);
    EXPECT_FALSE(side->sealed.send(1, Channel::reliable, {}).ok());
  }
  EXPECT_EQ(pair.network.oversized(), 0u);
  pair.pass(kSecond);
  for (Side* side : {&pair.host, &pair.client}) {
    const std::vector<Bytevec> said = {Bytevec(kDatagramCap, 1), Bytevec(kReliableCap, 2), {}};
    EXPECT_EQ(side->heard, said);
  }
}

TEST(SealedTransport, NobodyWithoutTheKeyIsHeardOf) {
  for (const SealSettings& settings : {settings_of(7, 2), settings_of(8, 1), SealSettings{}}) {
    Pair pair(settings);
    EXPECT_EQ(pair.client.count(ArrivalKind::disconnected), 1);
    EXPECT_EQ(pair.client.count(ArrivalKind::connected), 0);
    for (const int count : pair.host.counts) EXPECT_EQ(count, 0);
    EXPECT_EQ(pair.host.sealed.statistics().handshakes + pair.client.sealed.statistics().handshakes, 1u);
  }
}

TEST(SealedTransport, TheKeyThatAPeerHasShownSaysWhoItIs) {
  SealSettings all = settings_of(1, 1);
  all.keys.push_back({.id = 2, .secret = {}});
  all.keys[1].secret.fill(2);
  SimulatedNetwork network;
  Side host(network, SimulatedNetwork::kHost, all);
  std::vector<std::unique_ptr<Side>> clients;
  for (const std::uint64_t id : {2u, 1u}) {
    const EndpointId endpoint = network.add_client({});
    clients.push_back(std::make_unique<Side>(network, endpoint, all));
    clients.back()->sealed.set_own_key(id);
    network.connect(endpoint);
    for (int i = 0; i < 3; ++i) {
      host.turn(0);
      clients.back()->turn(0);
    }
  }
  EXPECT_EQ(host.sealed.key_of(0), 2u);
  EXPECT_EQ(host.sealed.key_of(1), 1u);
  EXPECT_EQ(host.sealed.key_of(2), std::nullopt);
}

TEST(SealedTransport, StrangersWhoSaySomethingElseOrNothingAreDisconnected) {
  SimulatedNetwork network;
  Side host(network, SimulatedNetwork::kHost, settings_of(7, 1));
  const EndpointId silent = network.add_client({}), loud = network.add_client({});
  Port silent_port = network.port(silent), loud_port = network.port(loud);
  network.connect(silent);
  network.connect(loud);
  ASSERT_TRUE(loud_port.receive().has_value());
  EXPECT_TRUE(loud_port.send(0, Channel::datagram, Bytevec(100)).ok());
  EXPECT_TRUE(loud_port.send(0, Channel::reliable, Bytevec(100)).ok());
  host.turn(kMs);
  EXPECT_EQ(host.sealed.statistics().handshakes, 1u);
  EXPECT_EQ(host.sealed.statistics().early, 1u);
  EXPECT_EQ(loud_port.receive()->kind, ArrivalKind::disconnected);
  host.turn(2 * kSecond);
  EXPECT_EQ(silent_port.receive()->kind, ArrivalKind::connected);
  EXPECT_FALSE(silent_port.receive().has_value());
  host.turn(3 * kSecond);
  EXPECT_EQ(silent_port.receive()->kind, ArrivalKind::disconnected);
  EXPECT_EQ(host.sealed.statistics().handshakes, 2u);
  for (const int count : host.counts) EXPECT_EQ(count, 0);
}

TEST(SealedTransport, AHostThatDoesNotAnswerIsGivenUp) {
  SimulatedNetwork network;
  const EndpointId id = network.add_client({});
  Side client(network, id, settings_of(7, 1));
  network.connect(id);
  client.turn(kMs);
  client.turn(3 * kSecond);
  EXPECT_EQ(client.count(ArrivalKind::disconnected), 1);
  EXPECT_EQ(client.count(ArrivalKind::connected), 0);
}

/// What a listener on the line could put there: everything that was ever said, in any place.
TEST(SealedTransport, WhatIsForgedReplayedOrCutIsCountedAndTheLiveConnectionGoesOn) {
  Pair pair;
  SealedLink stranger;  // has the key, and is nobody in this connection
  Bytevec hello(SealedLink::kHello);
  ASSERT_TRUE(stranger.begin(settings_of(7, 1).keys[0], std::span<std::uint8_t, SealedLink::kHello>(hello)));
  for (const Channel channel : {Channel::datagram, Channel::reliable}) {
    for (const Bytevec& bytes : {hello,
                                 Bytevec(SealedLink::kReply, 2),
                                 Bytevec(SealedLink::kSeal),
                                 Bytevec(19),
                                 {},
                                 Bytevec(40, 0xff),
                                 Bytevec(30000)}) {
      pair.network.inject(SimulatedNetwork::kHost, 0, channel, bytes);
      pair.network.inject(pair.client_id, 0, channel, bytes);
    }
  }
  pair.pass(kSecond);
  EXPECT_TRUE(pair.client.sealed.send(0, Channel::reliable, Bytevec{1}).ok());
  EXPECT_TRUE(pair.host.sealed.send(0, Channel::reliable, Bytevec{1}).ok());
  pair.pass(kSecond);
  for (Side* side : {&pair.host, &pair.client}) {
    const SealStatistics& statistics = side->sealed.statistics();
    EXPECT_EQ(statistics.truncated, 4u);
    EXPECT_EQ(statistics.truncated + statistics.forged + statistics.replayed, 14u);
    EXPECT_EQ(statistics.handshakes + statistics.displaced, 0u);
    EXPECT_EQ(side->count(ArrivalKind::disconnected), 0);
    EXPECT_EQ(side->heard, std::vector<Bytevec>{{1}});
  }
}

TEST(SealedTransport, DoubledAndLateDatagramsAreHeardOnce) {
  Pair pair(settings_of(7, 1), "latency=40,jitter=30,duplication=50,loss=10");
  for (std::uint8_t i = 0; i < 200; ++i) {
    EXPECT_TRUE(pair.client.sealed.send(0, Channel::datagram, Bytevec{i}).ok());
    pair.pass(kMs);
  }
  pair.pass(kSecond);
  std::vector<int> times(200);
  for (const Bytevec& bytes : pair.host.heard) ++times[bytes.at(0)];
  EXPECT_GT(pair.host.heard.size(), 150u);
  for (const int heard : times) EXPECT_LE(heard, 1);
  EXPECT_GT(pair.host.sealed.statistics().replayed, 50u);
  EXPECT_FALSE(std::is_sorted(pair.host.heard.begin(), pair.host.heard.end()));
}

/// An inner endpoint that shows everything that passes.
struct Tapped {
  Port port;
  std::vector<std::pair<Channel, Bytevec>> sent = {};
  Result<void> send(PeerId peer, Channel channel, Bytes bytes) {
    sent.emplace_back(channel, Bytevec(bytes.begin(), bytes.end()));
    return port.send(peer, channel, bytes);
  }
  std::optional<Arrival> receive() { return port.receive(); }
  void disconnect(PeerId peer) { port.disconnect(peer); }
};

TEST(SealedTransport, AnOlderConnectionsWordsAreNothingInTheNext) {
  SimulatedNetwork network;
  const EndpointId id = network.add_client({});
  Side host(network, SimulatedNetwork::kHost, settings_of(7, 1));
  Tapped tap{network.port(id)};
  SealedTransport<Tapped> client(tap, settings_of(7, 1));
  const auto turns = [&] {
    for (int i = 0; i < 4; ++i) {
      network.advance_to(network.now() + kMs);
      host.turn(network.now());
      while (client.receive().has_value()) {}
    }
  };
  network.connect(id);
  turns();
  EXPECT_TRUE(client.send(0, Channel::datagram, Bytevec(30, 1)).ok());
  EXPECT_TRUE(client.send(0, Channel::reliable, Bytevec(30, 2)).ok());
  turns();
  ASSERT_EQ(host.heard.size(), 2u);
  network.cut(id);
  turns();
  const auto before = tap.sent;
  ASSERT_EQ(before.size(), 4u);  // hello, confirm, datagram, message
  network.connect(id);
  turns();
  ASSERT_EQ(host.count(ArrivalKind::connected), 2);
  for (const auto& [channel, bytes] : before) network.inject(SimulatedNetwork::kHost, 0, channel, bytes);
  turns();
  EXPECT_EQ(host.heard.size(), 2u);
  EXPECT_EQ(host.sealed.statistics().forged + host.sealed.statistics().replayed, 4u);
  // A whole former connection, said again: the hello is good, the host draws another key, and the confirm is none.
  network.cut(id);
  turns();
  Port port = network.port(id);
  network.connect(id);
  network.advance_to(network.now() + kMs);
  for (const auto& [channel, bytes] : before) static_cast<void>(port.send(0, channel, bytes).ok());
  for (int i = 0; i < 3; ++i) host.turn(network.now());
  EXPECT_EQ(host.count(ArrivalKind::connected), 2);
  EXPECT_EQ(host.sealed.statistics().handshakes, 1u);
  EXPECT_EQ(host.heard.size(), 2u);
}

TEST(SealedTransport, AMessageThatIsMissingEndsTheConnection) {
  SimulatedNetwork network;
  const EndpointId id = network.add_client({});
  Side host(network, SimulatedNetwork::kHost, settings_of(7, 1));
  struct Dropping {  // a transport that breaks its word
    Port port;
    int kept = 2;
    Result<void> send(PeerId peer, Channel channel, Bytes bytes) {
      if (kept-- == 0) return {};
      return port.send(peer, channel, bytes);
    }
    std::optional<Arrival> receive() { return port.receive(); }
    void disconnect(PeerId peer) { port.disconnect(peer); }
  } inner{network.port(id)};
  SealedTransport<Dropping> client(inner, settings_of(7, 1));
  network.connect(id);
  for (int i = 0; i < 4; ++i) {
    host.turn(0);
    while (client.receive().has_value()) {}
  }
  EXPECT_TRUE(client.send(0, Channel::reliable, Bytevec{1}).ok());
  EXPECT_TRUE(client.send(0, Channel::reliable, Bytevec{2}).ok());
  host.turn(0);
  EXPECT_TRUE(host.heard.empty());
  EXPECT_EQ(host.count(ArrivalKind::disconnected), 1);
  EXPECT_EQ(host.sealed.statistics().displaced, 1u);
}

TEST(SealedTransport, WhoIsLedToItselfDoesNotAnswer) {
  SimulatedNetwork network;
  const EndpointId relay = network.add_client({}), machine_id = network.add_client({});
  Side machine(network, machine_id, settings_of(7, 1));
  Port other = network.port(relay);
  ASSERT_TRUE(network.connect(machine_id, relay));
  ASSERT_TRUE(network.connect(relay, machine_id));
  machine.turn(0);
  // The relay sends back on its own connection what it hears on the machine's.
  Bytevec hello;
  PeerId heard_from = 0;
  for (std::optional<Arrival> arrival; (arrival = other.receive());) {
    if (arrival->kind != ArrivalKind::message) continue;
    hello.assign(arrival->bytes.begin(), arrival->bytes.end());
    heard_from = arrival->peer;
  }
  ASSERT_EQ(hello.size(), SealedLink::kHello);
  for (const PeerId peer : {PeerId{0}, PeerId{1}, PeerId{2}}) {
    if (peer != heard_from) static_cast<void>(other.send(peer, Channel::reliable, hello).ok());
  }
  machine.turn(0);
  EXPECT_EQ(machine.sealed.statistics().handshakes, 1u);
  EXPECT_EQ(machine.count(ArrivalKind::connected), 0);
}

}  // namespace sealed_transport_test
}  // namespace isostep::sealed
