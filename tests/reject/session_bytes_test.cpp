// Hostile bytes and floods: nothing crashes, memory stays bounded, and the honest play on.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hostile_scene.hpp"
#include "isostep/core/random.hpp"

namespace isostep::hostile {
namespace session_bytes_test {

/// The words of a client within a match, from its first on.
std::vector<std::pair<Channel, Buffer>> captured(const SessionConfig& config) {
  Match match = make_match(config);
  match.add(lan());
  SessionConfig client = config;
  client.local_players = 0;
  BentPeer peer(match, client, lan());
  std::vector<std::pair<Channel, Buffer>> said;
  peer.bend = [&](BentPeer::Words& words) { said.insert(said.end(), words.begin(), words.end()); };
  match.run(2 * kSecond, [&] {
    peer.turn(match.now());
    return false;
  });
  return said;
}

TEST(HostileBytes, RealTrafficCutAtEveryLengthDoesNoHarm) {
  const auto said = captured(three_players());
  SeatedRogue scene;
  std::size_t next = 0;
  const PeerId peer = 1;  // the second that connected
  scene.play(2 * kSecond, [&] {
    for (int n = 0; n < 2 && next < said.size(); ++n, ++next) {
      const auto& [channel, bytes] = said[next];
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        scene.match.network().inject(transport::SimulatedNetwork::kHost, peer, channel, Bytes(bytes).first(size));
      }
    }
  });
  EXPECT_GT(next, 60u);
  EXPECT_GT(scene.match.host().session.stats().refused, 1000u);
  scene.expect_progress(60);
}

TEST(HostileBytes, RealTrafficWithAnyBitFlippedDoesNoHarm) {
  const auto said = captured(three_players());
  SeatedRogue scene;
  std::size_t next = 0;
  const PeerId peer = 1;  // the second that connected
  scene.play(2 * kSecond, [&] {
    if (next >= said.size()) return;
    auto [channel, bytes] = said[next++];
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
      scene.match.network().inject(transport::SimulatedNetwork::kHost, peer, channel, bytes);
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    }
  });
  EXPECT_GT(next, 60u);
  EXPECT_GT(scene.match.host().session.stats().refused, 1000u);
  // It may have said strange things of its states by then; of ours nobody said anything.
  const Frame from = scene.honest->end();
  EXPECT_TRUE(scene.match.run_to(from + 60, 15 * kSecond));
  expect_honest(scene.match, from + 60);
}

TEST(HostileBytes, NoiseOfAnySizeOnAnyChannelIsRefused) {
  SeatedRogue scene;
  Pcg32 random = Pcg32::seeded(5);
  std::uint64_t noise = 0;
  const std::uint64_t before = scene.match.host().session.stats().refused;
  scene.play(2 * kSecond, [&] {
    for (int n = 0; n < 20; ++n) {
      Buffer bytes(random.next() % (n == 0 ? 20000 : 200));
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
      const auto channel = static_cast<Channel>(random.next() % 4);  // two of them unknown
      if (!bytes.empty() && bytes[0] == 0xd1) continue;
      const bool is_word = !bytes.empty() && message_kind(Bytes(bytes).first(1)).ok();
      if (is_word && channel != Channel::datagram) bytes[0] = 0xff;  // some are whole with that alone
      for (const PeerId from : {PeerId{0}, PeerId{1}, PeerId{2}, PeerId{15}, PeerId{16}, PeerId{65535}}) {
        scene.match.network().inject(transport::SimulatedNetwork::kHost, from, channel, bytes);
        ++noise;
      }
    }
  });
  scene.play(kMs, [] {});
  EXPECT_EQ(scene.match.host().session.stats().refused - before, noise);
  scene.expect_progress(60);
}

TEST(HostileBytes, MoreThanAChannelTakesIsRefused) {
  SeatedRogue scene;
  Buffer datagram = scene.packet(nullptr);
  datagram.resize(transport::cap_of(Channel::datagram) + 1);
  Buffer message(kReliableCap + 1);
  message[0] = static_cast<std::uint8_t>(MessageKind::ready);
  EXPECT_FALSE(scene.rogue.say(Channel::datagram, datagram));  // no transport carries it
  const std::uint64_t before = scene.match.host().session.stats().refused;
  for (const PeerId peer : {PeerId{0}, PeerId{1}}) {
    scene.match.network().inject(transport::SimulatedNetwork::kHost, peer, Channel::datagram, datagram);
    scene.match.network().inject(transport::SimulatedNetwork::kHost, peer, Channel::reliable, message);
  }
  scene.play(kSecond, [] {});
  EXPECT_EQ(scene.match.host().session.stats().refused - before, 4u);
  scene.expect_progress(60);
}

TEST(HostileBytes, OldPacketsSentAgainChangeNothing) {
  Scene scene;
  BentPeer peer(scene.match, scene.client_config(), lan());
  std::vector<Buffer> old;
  std::size_t again = 0;
  peer.bend = [&](BentPeer::Words& words) {
    for (const auto& [channel, bytes] : words) {
      if (channel == Channel::datagram) old.push_back(bytes);
    }
    if (old.size() < 200) return;
    for (int n = 0; n < 5; ++n) words.emplace_back(Channel::datagram, old[(again += 7) % old.size()]);
  };
  scene.match.run(10 * kSecond, [&] {
    peer.turn(scene.match.now());
    return scene.honest->end() >= 500;
  });
  EXPECT_GT(again, 1000u);
  expect_honest(scene.match, 500);
  expect_no_desync({&scene.match.host(), scene.honest});
  for (const SessionEvent& event : peer.events) EXPECT_NE(event.kind, Kind::desync);
}

TEST(HostileFlood, HundredThousandPacketsASecondAreDroppedUnread) {
  const auto frames_with = [](int flood, std::uint64_t& flooded) {
    SessionConfig config = three_players();
    config.players = 2;
    config.most_packets = SessionConfig{}.most_packets;
    Scene scene(config);
    Rogue rogue(scene.match, lan());
    bool greeted = false;
    PacketHeader header;
    std::uint8_t buffer[kDatagramCap];
    const auto turn = [&](int packets) {
      rogue.listen();
      if (rogue.is_connected && !greeted) {
        greeted = true;
        Hello hello = hello_of(config);
        hello.spectator = true;
        rogue.greet(hello);
      }
      header.match = rogue.welcome.match;
      header.frame = rogue.host_frame;
      header.ack_mask = 3;  // who acknowledges nothing is put out
      for (const int p : {0, 1}) header.ack[p] = rogue.ends[p];
      const Bytes bytes = PacketWriter(header, buffer).bytes();
      for (int n = 0; n < packets; ++n) {
        const Channel channel = n % 2 == 0 ? Channel::datagram : Channel::reliable;
        scene.match.network().inject(transport::SimulatedNetwork::kHost, 1, channel, bytes);
      }
      return false;
    };
    scene.match.run(2 * kSecond, [&] { return turn(0); });
    EXPECT_TRUE(rogue.is_welcome);
    const Frame from = scene.match.host().end();
    scene.match.run(5 * kSecond, [&] { return turn(flood > 0 ? flood : scene.match.now() % (10 * kMs) == 0); });
    EXPECT_TRUE(rogue.is_connected);
    flooded = scene.match.host().session.stats().flooded;
    expect_honest(scene.match, 300);
    expect_no_desync({&scene.match.host(), scene.honest});
    return scene.match.host().end() - from;
  };
  std::uint64_t none = 0, many = 0;
  const Frame calm = frames_with(0, none);
  const Frame stormy = frames_with(100, many);
  EXPECT_EQ(none, 0u);
  EXPECT_GT(calm, 295);
  EXPECT_GE(stormy, calm - 2);
  EXPECT_GT(many, 490000u);  // of 500000; 480 a second of each channel were read, and more at the start
}

TEST(HostileFlood, NothingThatAPeerSaysMakesTheHostAllocate) {
  SessionConfig config = three_players();
  const auto said = captured(config);
  config.host = true;
  config.seed = 1;
  config.local_players = 2;
  Session<Game> host(config);
  Game game;
  Time now = 0;
  std::uint64_t sent = 0;
  const auto turn = [&] {
    now += kMs;
    for (int p = 0; p < 2; ++p) host.add_local_input(p, {});
    drive(host, game, now);
    while (host.poll_send(now)) ++sent;
    while (host.poll_event()) {}
  };
  turn();
  host.connected(0, now);
  host.receive(0, said[0].first, said[0].second, now);
  turn();
  ASSERT_EQ(host.phase(), SessionPhase::playing);
  Buffer words = said[60].second;
  const std::size_t before = allocation_count.times;
  for (int step = 0; step < 3000; ++step) {
    if (step % 10 == 0) {
      const Buffer& next = said[static_cast<std::size_t>(step / 10) % (said.size() - 1) + 1].second;
      words.assign(next.begin(), next.end());
    }
    for (std::size_t bit = static_cast<std::size_t>(step % 10); bit < words.size() * 8; bit += 10) {
      words[bit / 8] = static_cast<std::uint8_t>(words[bit / 8] ^ 1u << bit % 8);
      host.receive(0, Channel::datagram, words, now);
      host.receive(0, Channel::reliable, words, now);
      words[bit / 8] = static_cast<std::uint8_t>(words[bit / 8] ^ 1u << bit % 8);
    }
    turn();
  }
  // The words themselves grow a few times; the host does not.
  EXPECT_LT(allocation_count.times - before, 20u);
  EXPECT_GT(host.stats().refused, 100000u);
  EXPECT_GT(sent, 100u);
}

}  // namespace session_bytes_test
}  // namespace isostep::hostile
