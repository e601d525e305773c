// Forgeries of strangers and machines on the line against EnetTransports: they cut nobody off, keep nobody out, and get
// no more bytes than they bring.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"
#include "transport/enet_guard.hpp"
#include "unit/transport/enet_bench.hpp"
#include "unit/transport/middle.hpp"

namespace isostep::transport {
namespace enet_forgery_test {

/// A packet as ENet 1.3.17 itself sends it, without our tags: to a peer of this number and session.
Bytevec bare_disconnect(std::uint32_t peer, std::uint32_t session) {
  const std::uint32_t header = peer | session << 12;
  return {static_cast<std::uint8_t>(header >> 8), static_cast<std::uint8_t>(header), 0x44, 0xff, 0, 1, 0, 0, 0, 0};
}
Bytevec bare_connect(std::uint32_t connect_id) {
  Bytevec packet(52, 0);
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
      packet[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  };
  put(0, 0x8fff1234);
  put(4, 0x82ff0001);
  put(8, 0x0000ffff);
  put(12, kEnetMtu);
  put(16, 65536);
  put(20, kEnetChannels);
  put(32, 5000);
  put(36, 32);
  put(44, connect_id);
  return packet;
}

/// A client that reaches its host over a machine in the middle.
struct Watched {
  EnetTransport host;
  Middle middle;
  EnetTransport client;
  Bench bench;

  explicit Watched(const EnetSettings& settings = {.timeout = kPatience})
      : host(listen_here(settings)), middle(host.port()), client(connect_to(middle.port(), settings)) {
    bench.endpoints = {&host, &client};
    meet(1);
  }
  void turn() {
    middle.turn();
    bench.turn();
  }
  bool until(std::size_t endpoint, ArrivalKind kind, std::size_t times) {
    for (const Deadline deadline; !deadline.over(); turn()) {
      if (bench.count(endpoint, kind) >= times) return true;
    }
    return false;
  }
  void meet(std::size_t times) {
    ASSERT_TRUE(until(1, ArrivalKind::connected, times));
    ASSERT_TRUE(until(0, ArrivalKind::connected, times));
  }
  /// Both ways, both channels.
  void expect_alive() {
    const std::size_t here = bench.count(0, ArrivalKind::message), there = bench.count(1, ArrivalKind::message);
    for (EnetTransport* endpoint : bench.endpoints) {
      ASSERT_TRUE(endpoint->send(0, Channel::reliable, Bytevec(3000, 1)).ok());
      ASSERT_TRUE(endpoint->send(0, Channel::datagram, Bytevec(30, 2)).ok());
    }
    EXPECT_TRUE(until(0, ArrivalKind::message, here + 2));
    EXPECT_TRUE(until(1, ArrivalKind::message, there + 2));
    EXPECT_EQ(bench.count(0, ArrivalKind::disconnected) + bench.count(1, ArrivalKind::disconnected), 0u);
    EXPECT_EQ(bench.count(0, ArrivalKind::message), here + 2);
    EXPECT_EQ(bench.count(1, ArrivalKind::message), there + 2);
  }
};

TEST(EnetForgery, ADisconnectInThePeersNameCutsNobodyOff) {
  Watched pair;
  const std::uint64_t before = pair.host.statistics().implausible;
  for (std::uint32_t peer = 0; peer < 4; ++peer) {
    for (std::uint32_t session = 0; session < 4; ++session) {
      Bytevec bare = bare_disconnect(peer, session);
      pair.middle.say_to_host(bare);
      pair.middle.say_to_client(bare);
      bare.insert(bare.begin(), LineTags::kSize, 0);  // where our tag is
      pair.middle.say_to_host(bare);
      pair.middle.say_to_client(bare);
    }
  }
  for (int i = 0; i < 20; ++i) pair.turn();
  EXPECT_EQ(pair.host.statistics().implausible, before + 32);
  pair.expect_alive();
}

TEST(EnetForgery, WhatWentOverTheLineSaysNothingASecondTime) {
  Watched pair({.timeout = kPatience, .key = {1, 2, 3}});
  pair.expect_alive();
  const std::vector<Bytevec> up = pair.middle.up, down = pair.middle.down;
  for (int round = 0; round < 3; ++round) {
    for (const Bytevec& packet : up) {
      pair.middle.say_to_host(packet);
      pair.middle.say_to_client(packet);
    }
    for (const Bytevec& packet : down) {
      pair.middle.say_to_host(packet);
      pair.middle.say_to_client(packet);
    }
    for (int i = 0; i < 10; ++i) pair.turn();
    pair.expect_alive();
  }
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::connected), 1u);
}

TEST(EnetForgery, AnEarlierConnectionsPacketsAreNothingInTheNext) {
  Watched pair;
  pair.expect_alive();
  const std::vector<Bytevec> earlier = pair.middle.up;  // also its open, whose cookie still holds
  ASSERT_TRUE(pair.client.connect_again().ok());
  pair.meet(2);
  const std::uint64_t refused = pair.host.statistics().implausible;
  for (const Bytevec& packet : earlier) pair.middle.say_to_host(packet);
  for (int i = 0; i < 20; ++i) pair.turn();
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::connected), 2u);
  EXPECT_EQ(pair.host.statistics().implausible, refused + earlier.size() - 1) << "an ask may be answered again";
  const std::size_t heard = pair.bench.count(0, ArrivalKind::message);
  ASSERT_TRUE(pair.client.send(0, Channel::reliable, Bytevec(9, 1)).ok());
  EXPECT_TRUE(pair.until(0, ArrivalKind::message, heard + 1));
  EXPECT_EQ(pair.bench.count(1, ArrivalKind::disconnected), 0u);
}

TEST(EnetForgery, APacketThatIsAlteredIsNoPacket) {
  Watched pair;
  pair.expect_alive();
  std::vector<Bytevec> seen = pair.middle.up;
  seen.insert(seen.end(), pair.middle.down.begin(), pair.middle.down.end());
  Pcg32 random = Pcg32::seeded(8);
  for (int i = 0; i < 30000; ++i) {
    Bytevec bytes = seen[random_below(random, static_cast<std::uint32_t>(seen.size()))];
    const std::uint32_t size = static_cast<std::uint32_t>(bytes.size());
    bytes[random_below(random, size)] ^= static_cast<std::uint8_t>(1 + random_below(random, 255));
    if (random_below(random, 4) == 0) bytes.resize(random_below(random, size + 1));
    if (random_below(random, 8) == 0) bytes.resize(bytes.size() + random_below(random, 30));
    i % 2 == 0 ? pair.middle.say_to_host(bytes) : pair.middle.say_to_client(bytes);
    if (i % 100 == 0) pair.turn();
  }
  pair.expect_alive();
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::connected), 1u);
}

TEST(EnetForgery, AWordToWhoAskedForNothingIsNothing) {
  Pair pair({.timeout = kPatience}, {.timeout = kPatience});
  const UdpSocket stranger;
  const auto say_words = [&] {
    for (const std::uint8_t kind : {0x80, 0x81, 0x82, 0x83, 0x84, 0xff}) {
      for (std::size_t size = 1; size < 90; ++size) stranger.send(pair.host.port(), Bytevec(size, kind));
    }
    pair.bench.turn();
  };
  say_words();
  pair.client.disconnect(0);
  ASSERT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::disconnected));
  say_words();
  // The end was acknowledged, so the only place is free again: nobody's time is over.
  ASSERT_TRUE(pair.bench.turn_until([&] { return pair.client.connect_to("127.0.0.1", pair.host.port()).ok(); }));
  say_words();
  EXPECT_TRUE(pair.bench.turn_until_heard(0, ArrivalKind::connected, 2));
  EXPECT_TRUE(pair.bench.turn_until_heard(1, ArrivalKind::connected, 2));
}

// ---- addresses

TEST(EnetForgery, AnAddressThatChangesIsAnotherPeersAndTheOldOneGoesOn) {
  Watched pair;
  const std::size_t before = pair.middle.up.size();
  pair.middle.is_whole = false;
  ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(30, 5)).ok());
  for (const Deadline deadline; pair.middle.up.size() == before && !deadline.over();) pair.turn();
  const UdpSocket elsewhere;
  for (std::size_t i = before; i < pair.middle.up.size(); ++i) elsewhere.send(pair.host.port(), pair.middle.up[i]);
  for (int i = 0; i < 20; ++i) pair.turn();
  EXPECT_EQ(pair.bench.count(0, ArrivalKind::message), 0u) << "a good tag from another address";
  EXPECT_FALSE(elsewhere.receive().has_value());
  pair.middle.is_whole = true;
  pair.expect_alive();
}

TEST(EnetForgery, ACookieOpensForNoOtherAddress) {
  EnetTransport host = listen_here();
  Middle middle(host.port());
  middle.is_whole = false;
  EnetTransport client = connect_to(middle.port());
  Bench bench{{&host, &client}};
  const auto turn_until = [&](const std::vector<Bytevec>& list, std::size_t size) {
    for (const Deadline deadline; list.size() < size && !deadline.over(); bench.turn()) middle.turn();
  };
  turn_until(middle.up, 1);
  middle.say_to_host(middle.up[0]);  // ask
  turn_until(middle.down, 1);
  middle.say_to_client(middle.down[0]);  // challenge
  for (const Deadline deadline; middle.up.back()[0] != 0x83 && !deadline.over(); bench.turn()) middle.turn();
  const Bytevec open = middle.up.back();
  ASSERT_EQ(open.size(), 81u);
  const UdpSocket elsewhere;
  for (int i = 0; i < 3; ++i) elsewhere.send(host.port(), open);
  for (int i = 0; i < 20; ++i) bench.turn();
  EXPECT_FALSE(elsewhere.receive().has_value());
  EXPECT_EQ(host.statistics().implausible, 3u);
  middle.say_to_host(open);
  middle.is_whole = true;
  for (const Deadline deadline; bench.count(0, ArrivalKind::connected) == 0 && !deadline.over(); bench.turn()) {
    middle.turn();
  }
  EXPECT_EQ(bench.count(0, ArrivalKind::connected), 1u);
}

// ---- bytes, and places

TEST(EnetForgery, AnUnprovedAddressGetsNoMoreBytesThanItBrings) {
  EnetTransport host = listen_here();
  std::vector<Bytevec> words;  // of a real handshake
  {
    Middle middle(host.port());
    EnetTransport client = connect_to(middle.port());
    Bench bench{{&host, &client}};
    for (const Deadline deadline; bench.count(1, ArrivalKind::connected) == 0 && !deadline.over(); bench.turn()) {
      middle.turn();
    }
    words = middle.up;
    words.insert(words.end(), middle.down.begin(), middle.down.end());
  }
  for (std::uint32_t id = 1; id < 20; ++id) words.push_back(bare_connect(id));
  words.push_back(bare_disconnect(0, 0));
  const UdpSocket stranger;
  Pcg32 random = Pcg32::seeded(2);
  std::uint64_t brought = 0, got = 0, answers = 0;
  const auto say = [&](const Bytevec& bytes) {
    stranger.send(host.port(), bytes);
    brought += bytes.size();
  };
  const auto hear = [&] {
    host.poll();
    while (host.receive().has_value()) {}
    host.flush();
    while (const auto answer = stranger.receive()) {
      got += answer->bytes.size();
      ++answers;
    }
    EXPECT_LE(got, brought);
  };
  for (const Bytevec& word : words) {
    for (std::size_t size = 0; size <= word.size(); ++size) {
      brought = got = 0;  // each alone
      say({word.begin(), word.begin() + static_cast<std::ptrdiff_t>(size)});
      hear();
    }
  }
  for (int i = 0; i < 20000; ++i) {
    Bytevec bytes = words[random_below(random, static_cast<std::uint32_t>(words.size()))];
    for (std::uint32_t changes = random_below(random, 3); changes > 0 && !bytes.empty(); --changes) {
      bytes[random_below(random, static_cast<std::uint32_t>(bytes.size()))] = static_cast<std::uint8_t>(random.next());
    }
    say(bytes);
    if (i % 64 == 0) hear();
  }
  for (int i = 0; i < 40; ++i) {  // what ENet would have repeated
    hear();
    host.wait(50 * kMs);
  }
  EXPECT_GT(answers, 0u);
  EXPECT_LE(got, brought);
}

TEST(EnetForgery, AFloodOfRequestsKeepsNobodyOut) {
  EnetTransport host = listen_here();
  std::vector<UdpSocket> strangers(200);
  const Doorkeeper door;
  std::uint32_t count = 0;
  // 9 a second took all places before. 100 times as many: 15 each turn of 60 a second, and ours are fewer than 60.
  const auto flood = [&] {
    for (int i = 0; i < 15; ++i) {
      const UdpSocket& stranger = strangers[++count % strangers.size()];
      const Doorkeeper::Word ask = door.ask(count);
      stranger.send(host.port(), bare_connect(count));
      stranger.send(host.port(), {ask.begin(), ask.end()});  // and never hears the answer
    }
  };
  Bench bench{{&host}};
  for (int turn = 0; turn < 600; ++turn) {  // ten seconds before the honest one comes
    flood();
    bench.turn();
  }
  EnetTransport honest = connect_to(host.port());
  bench.endpoints.push_back(&honest);
  int turns = 0;
  for (; turns < 60 && bench.count(1, ArrivalKind::connected) + bench.count(0, ArrivalKind::connected) < 2; ++turns) {
    flood();
    bench.turn();
  }
  EXPECT_LT(turns, 60);
  ASSERT_EQ(bench.count(0, ArrivalKind::connected), 1u);
  EXPECT_EQ(bench.heard[0].back().peer, 0u) << "nobody else ever had a place";
}

TEST(EnetForgery, AFloodInOneTurnLeavesWhatIsBehindItToTheSameTurn) {
  Pair pair;
  const UdpSocket stranger;
  for (int i = 0; i < 300; ++i) stranger.send(pair.host.port(), Bytevec(12, 1));  // more than ENet reads at once
  ASSERT_TRUE(pair.client.send(0, Channel::datagram, Bytevec(10, 1)).ok());
  pair.client.flush();
  const std::uint64_t before = pair.host.statistics().packets_received;
  pair.host.poll();
  std::size_t messages = 0;
  while (const auto arrival = pair.host.receive()) messages += arrival->kind == ArrivalKind::message ? 1 : 0;
  EXPECT_GT(pair.host.statistics().packets_received - before, 300u);
  EXPECT_EQ(messages, 1u);
}

// ---- the match's key

TEST(EnetForgery, WhoLacksTheMatchsKeyIsNoPeer) {
  EnetTransport host = listen_here({.timeout = kPatience, .key = {7}});
  EnetTransport stranger = connect_to(host.port(), {.timeout = 100 * kMs}),
                other = connect_to(host.port(), {.timeout = 100 * kMs, .key = {8}}),
                member = connect_to(host.port(), {.timeout = kPatience, .key = {7}});
  Bench bench{{&host, &stranger, &other, &member}};
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::disconnected));
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::disconnected));
  ASSERT_TRUE(bench.turn_until_heard(3, ArrivalKind::connected));
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected));
  EXPECT_EQ(bench.count(1, ArrivalKind::connected) + bench.count(2, ArrivalKind::connected), 0u);
  EXPECT_EQ(bench.count(0, ArrivalKind::connected), 1u);
}

}  // namespace enet_forgery_test
}  // namespace isostep::transport
