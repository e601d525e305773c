// Endpoints over ENet on 127.0.0.1: both channels, ends, hostile packets, and a bad line between them.
// SPDX-License-Identifier: MIT
#include "transport/enet_transport.hpp"

#include <gtest/gtest.h>

#include "isostep/core/random.hpp"
#include "unit/transport/enet_bench.hpp"

namespace isostep::transport {
namespace enet_transport_test {

constexpr std::size_t kMostDatagram = cap_of(Channel::datagram);
constexpr std::size_t kMostReliable = cap_of(Channel::reliable);
static_assert(Connector<EnetTransport>);

TEST(EnetTransport, CarriesBothChannelsBothWays) {
  Pair pair;
  const Bytevec datagram(kMostDatagram, 3), reliable(kMostReliable, 4);
  for (EnetTransport* endpoint : {&pair.host, &pair.client}) {
    ASSERT_TRUE(endpoint->send(0, Channel::datagram, datagram).ok());
    ASSERT_TRUE(endpoint->send(0, Channel::datagram, {}).ok());
    ASSERT_TRUE(endpoint->send(0, Channel::reliable, reliable).ok());
    ASSERT_TRUE(endpoint->send(0, Channel::reliable, {}).ok());
  }
  for (const std::size_t endpoint : {0u, 1u}) {
    ASSERT_TRUE(pair.bench.turn_until_heard(endpoint, ArrivalKind::message, 4));
    std::size_t found = 0;
    for (const Heard& heard : pair.bench.heard[endpoint]) {
      if (heard.kind != ArrivalKind::message) continue;
      EXPECT_EQ(heard.peer, 0u);
      EXPECT_TRUE(heard.bytes.empty() || heard.bytes == (heard.channel == Channel::datagram ? datagram : reliable));
      found += heard.bytes.size();
    }
    EXPECT_EQ(found, kMostDatagram + kMostReliable);
  }
}

/// 200 KB in pieces from the host, and datagrams both ways meanwhile.
template <class AnyPair> void exchange_blob(AnyPair& pair) {
  Bytevec blob(200 << 10);
  for (std::size_t i = 0; i < blob.size(); ++i) blob[i] = static_cast<std::uint8_t>(i * i >> 7);
  for (std::size_t at = 0; at < blob.size(); at += kMostReliable) {
    const std::size_t size = std::min(kMostReliable, blob.size() - at);
    ASSERT_TRUE(pair.host.send(0, Channel::reliable, Bytes(blob).subspan(at, size)).ok());
  }
  Bytevec got;
  const auto collect = [&] {
    for (EnetTransport* endpoint : {&pair.host, &pair.client}) {
      EXPECT_TRUE(endpoint->send(0, Channel::datagram, Bytevec(16, 9)).ok());
    }
    got.clear();
    for (const Heard& heard : pair.bench.heard[1]) {
      if (heard.channel == Channel::reliable) got.insert(got.end(), heard.bytes.begin(), heard.bytes.end());
    }
    return got.size() >= blob.size();
  };
  EXPECT_TRUE(pair.bench.turn_until(collect));
  EXPECT_EQ(got, blob);
  EXPECT_GT(pair.bench.count(0, ArrivalKind::message), 0u);
  EXPECT_EQ(pair.bench.count(1, ArrivalKind::disconnected), 0u);
}

TEST(EnetTransport, CarriesABlobInReliablePieces) {
  Pair pair;
  exchange_blob(pair);
}

/// A client that reaches its host through a relay.
struct RelayedPair {
  EnetTransport host;
  UdpRelay relay;
  EnetTransport client;
  Bench bench;

  explicit RelayedPair(const char* profile, const EnetSettings& settings = {.timeout = kPatience})
      : host(listen_here(settings)),
        relay(open(profile)),
        client(connect_to(relay.port(), settings)),
        bench{{&host, &client}, &relay} {
    EXPECT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
    EXPECT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected));
  }
  UdpRelay open(const char* profile) const {
    Result<UdpRelay> opened =
        UdpRelay::open({.target_port = host.port(), .profile = parse_profile(profile).value(), .seed = 4});
    EXPECT_TRUE(opened.ok());
    return std::move(opened.value());
  }
};

TEST(EnetTransport, CarriesABlobThroughALossyRelay) {
  RelayedPair pair("latency=5,jitter=5,loss=5,duplication=2");
  exchange_blob(pair);
  EXPECT_GT(pair.relay.statistics().down.lost + pair.relay.statistics().up.lost, 0u);
}

TEST(EnetTransport, GoesOverIPv6ByARelayAtEachEnd) {
  EnetTransport host = listen_here();
  Result<UdpRelay> out = UdpRelay::open({.listen_address = "::1", .target_port = host.port()});
  if (!out) GTEST_SKIP() << "no IPv6";
  Result<UdpRelay> in = UdpRelay::open({.target_address = "::1", .target_port = out.value().port()});
  ASSERT_TRUE(in.ok());
  EnetTransport client = connect_to(in.value().port());
  Bench bench{{&host, &client}, &in.value()};
  const auto both = [&](std::size_t endpoint, ArrivalKind kind, std::size_t times) {
    return bench.turn_until([&] {
      EXPECT_TRUE(out.value().turn(0).ok());
      return bench.count(endpoint, kind) >= times;
    });
  };
  ASSERT_TRUE(both(0, ArrivalKind::connected, 1) && both(1, ArrivalKind::connected, 1));
  for (EnetTransport* endpoint : {&host, &client}) {
    EXPECT_TRUE(endpoint->send(0, Channel::datagram, Bytevec(kMostDatagram, 1)).ok());
    EXPECT_TRUE(endpoint->send(0, Channel::reliable, Bytevec(kMostReliable, 2)).ok());
  }
  EXPECT_TRUE(both(0, ArrivalKind::message, 2) && both(1, ArrivalKind::message, 2));
}

TEST(EnetTransport, DropsNoDatagramOnPurposeWhenRoundTripsGrow) {
  RelayedPair pair("latency=1");
  // Acknowledgements that come later and later are what makes ENet's throttle close.
  std::uint32_t sent = 0;
  const auto send_some = [&](int turns) {
    for (int i = 0; i < turns; ++i) {
      ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(8, 1)).ok());
      ASSERT_TRUE(pair.client.send(0, Channel::reliable, Bytevec(8, 2)).ok());
      ++sent;
      pair.bench.turn();
    }
  };
  send_some(100);
  const auto datagrams = [&] {
    return std::count_if(pair.bench.heard[0].begin(), pair.bench.heard[0].end(), [](const Heard& heard) {
      return heard.kind == ArrivalKind::message && heard.channel == Channel::datagram;
    });
  };
  for (int i = 0; i < 40; ++i) {
    // The relay stands still, longer each time.
    pair.bench.relay = nullptr;
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(10 + i);
    while (std::chrono::steady_clock::now() < until) send_some(1);
    pair.bench.relay = &pair.relay;
    send_some(5);
  }
  EXPECT_TRUE(pair.bench.turn_until([&] { return datagrams() == static_cast<std::ptrdiff_t>(sent); }))
      << datagrams() << " of " << sent;
}

TEST(EnetTransport, RefusesWhatIsAboveACapOrForNobody) {
  Pair pair;
  EXPECT_EQ(pair.client.send(0, Channel::datagram, Bytevec(kMostDatagram + 1)).error().code, ErrorCode::limit);
  EXPECT_EQ(pair.client.send(0, Channel::reliable, Bytevec(kMostReliable + 1)).error().code, ErrorCode::limit);
  EXPECT_FALSE(pair.client.send(1, Channel::datagram, Bytevec(1)).ok());
  EXPECT_FALSE(pair.host.send(1, Channel::datagram, Bytevec(1)).ok());
  EXPECT_FALSE(pair.host.send(65535, Channel::reliable, Bytevec(1)).ok());
  EXPECT_FALSE(pair.host.connect_again().ok());
}

TEST(EnetTransport, AddressesThatAreNotAreErrors) {
  EXPECT_FALSE(EnetTransport::connect("127.0.0.1", 0).ok());
  EXPECT_FALSE(EnetTransport::listen(0, {.max_peers = 0}).ok());
  EXPECT_FALSE(EnetTransport::listen(0, {.max_peers = 5000}).ok());
  EXPECT_FALSE(EnetTransport::listen(0, {.bind_address = "203.0.113.1"}).ok());  // RFC 5737: nobody's
  const UdpSocket taken;
  EXPECT_FALSE(EnetTransport::listen(taken.port(), {.bind_address = "127.0.0.1"}).ok());
}

// ---- ends

TEST(EnetTransport, WhoDisconnectsIsDoneAtOnceAndThePeerFirstHearsWhatWasSaid) {
  Pair pair;
  for (std::uint8_t i = 0; i < 20; ++i) ASSERT_TRUE(pair.host.send(0, Channel::reliable, Bytevec(5000, i)).ok());
  pair.host.disconnect(0);
  EXPECT_FALSE(pair.host.send(0, Channel::reliable, Bytevec(1)).ok());
  ASSERT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::disconnected));
  EXPECT_EQ(pair.bench.count(1, ArrivalKind::message), 20u);
  EXPECT_EQ(pair.bench.heard[1].back().kind, ArrivalKind::disconnected);
  for (int i = 0; i < 20; ++i) pair.bench.turn();
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::disconnected), 0u);

  ASSERT_TRUE(pair.client.connect_again().ok());
  EXPECT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::connected, 2));
  EXPECT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::connected, 2));
}

TEST(EnetTransport, AClientThatEndsIsHeardAndItsNumberIsFreeAgain) {
  EnetTransport host = listen_here();
  auto client = std::make_unique<EnetTransport>(connect_to(host.port()));
  Bench bench{{&host, client.get()}};
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
  client.reset();
  bench.endpoints[1] = nullptr;
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::disconnected));
  client = std::make_unique<EnetTransport>(connect_to(host.port()));
  bench.endpoints[1] = client.get();
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected, 2));
  EXPECT_EQ(bench.heard[0].back().peer, 0u);
}

TEST(EnetTransport, ADeadLineEndsTheConnectionOnBothSides) {
  RelayedPair pair("latency=1", {.timeout = 2000 * kMs});
  pair.bench.relay = nullptr;
  EXPECT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::disconnected));
  EXPECT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::disconnected));
}

TEST(EnetTransport, AnAttemptThatNobodyAnswersEndsInDisconnected) {
  const UdpSocket silent;
  EnetTransport client = connect_to(silent.port(), {.timeout = 100 * kMs});
  Bench bench{{&client}};
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::disconnected));
  EXPECT_EQ(bench.count(0, ArrivalKind::connected), 0u);
}

TEST(EnetTransport, AHostThatIsFullLetsNobodyIn) {
  EnetTransport host = listen_here({.max_peers = 1, .timeout = kPatience});
  EnetTransport first = connect_to(host.port());
  Bench bench{{&host, &first}};
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
  EnetTransport second = connect_to(host.port(), {.timeout = 100 * kMs});
  bench.endpoints.push_back(&second);
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::disconnected));
  EXPECT_EQ(bench.count(2, ArrivalKind::connected), 0u);
  EXPECT_EQ(bench.count(0, ArrivalKind::connected), 1u);
}

TEST(EnetTransport, APeerThatAcknowledgesTooSlowlyIsGivenUpRatherThanHalfServed) {
  Pair pair({.timeout = kPatience, .unacknowledged_cap = 100000});
  Result<void> sent;
  int pieces = 0;
  while ((sent = pair.host.send(0, Channel::reliable, Bytevec(kMostReliable))).ok()) ASSERT_LT(++pieces, 7);
  EXPECT_EQ(pieces, 6);  // of 16404 bytes in 100000
  EXPECT_EQ(sent.error().code, ErrorCode::limit);
  EXPECT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::disconnected));
  EXPECT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::disconnected));
}

TEST(EnetTransport, WhatIsAcknowledgedCountsNoLonger) {
  Pair pair({.timeout = kPatience, .unacknowledged_cap = 2 * kMostReliable});
  for (std::size_t i = 1; i <= 20; ++i) {
    ASSERT_TRUE(pair.host.send(0, Channel::reliable, Bytevec(2 * kMostReliable / 2)).ok());
    ASSERT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::message, i));
    // The acknowledgement has a way of its own back.
    for (int turn = 0; turn < 20; ++turn) pair.bench.turn();
  }
}

// ---- hostile packets

TEST(EnetTransport, GarbageOfStrangersIsCountedAndNothingElse) {
  Pair pair;
  const UdpSocket stranger;
  Pcg32 random = Pcg32::seeded(1);
  for (int i = 0; i < 300; ++i) {
    Bytevec bytes(random_below(random, 100));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    stranger.send(pair.host.port(), bytes);
    stranger.send(pair.host.port(), Bytevec(5000));  // more than ENet's own buffer: an error of its socket
    if (i % 50 == 0) pair.bench.turn();
  }
  ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(10, 1)).ok());
  ASSERT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::message));
  EXPECT_EQ(pair.bench.heard[0].size(), 2u);
  EXPECT_GT(pair.host.statistics().implausible, 0u);
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::disconnected), 0u);
}

TEST(EnetTransport, AFloodCostsOnlyTheFlooder) {
  EnetTransport host = listen_here({.timeout = kPatience, .datagrams_per_peer = 20});
  EnetTransport flooder = connect_to(host.port()), honest = connect_to(host.port());
  Bench bench{{&host, &flooder, &honest}};
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected, 2));
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::connected));
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(flooder.send(0, Channel::datagram, Bytevec(1, 66)).ok());
  flooder.flush();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(honest.send(0, Channel::datagram, Bytevec(1, 33)).ok());
  honest.flush();
  const auto honest_messages = [&] {
    return std::count_if(bench.heard[0].begin(), bench.heard[0].end(),
                         [](const Heard& heard) { return heard.bytes == Bytevec(1, 33); });
  };
  EXPECT_TRUE(bench.turn_until([&] { return honest_messages() == 10; }));
  EXPECT_TRUE(bench.turn_until([&] { return host.statistics().flooded > 300; }));
}

TEST(EnetTransport, APollHandlesNoMoreEventsThanItMay) {
  Pair pair({.timeout = kPatience, .events_per_poll = 8});
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(1)).ok());
  pair.client.flush();
  std::size_t got = 0;
  for (const Deadline deadline; !deadline.over() && got < 100;) {
    pair.host.poll();
    std::size_t now = 0;
    while (pair.host.receive().has_value()) ++now;
    ASSERT_LE(now, 8u);
    got += now;
  }
  EXPECT_EQ(got, 100u);
}

// ---- what it costs

TEST(EnetTransport, ADatagramAloneTakesEighteenBytesMore) {
  Pair pair;
  for (int i = 0; i < 50; ++i) pair.bench.turn();  // what the connection itself still says
  std::uint64_t least = ~std::uint64_t{0};         // of a datagram with its packet; a ping may go in one
  for (int i = 0; i < 100; ++i) {
    const EnetStatistics before = pair.client.statistics();
    ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(16)).ok());
    pair.client.flush();
    const EnetStatistics& after = pair.client.statistics();
    ASSERT_EQ(after.packets_sent - before.packets_sent, 1u);
    least = std::min(least, after.bytes_sent - before.bytes_sent);
  }
  EXPECT_EQ(least, 34u);
}

}  // namespace enet_transport_test
}  // namespace isostep::transport
