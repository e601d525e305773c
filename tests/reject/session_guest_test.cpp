// Hostile guests: on their way into the match, and out of it.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hostile_scene.hpp"
#include "isostep/core/random.hpp"

namespace isostep::hostile {
namespace session_guest_test {

TEST(HostileGuest, WordsBeforeTheFirstAreRefused) {
  Scene scene;
  Rogue rogue(scene.match, lan());
  Buffer ready, progress, open, welcome, refusal, piece;
  write_ready(ready);
  write_progress(7, progress);
  write_open(3, open);
  Welcome strange;
  strange.players = 3;
  strange.start.frame = 0;
  write_welcome(strange, welcome);
  write_refusal({}, refusal);
  write_piece({0, ready}, piece);
  PacketHeader header;
  std::uint8_t buffer[kDatagramCap];
  const PacketWriter writer(header, buffer);
  const std::uint64_t before = scene.match.host().session.stats().refused;
  int said = 0;
  scene.match.run(kSecond, [&] {
    rogue.listen();
    if (!rogue.is_connected || said > 0) return false;
    for (const Buffer* words : {&ready, &progress, &open, &welcome, &refusal, &piece}) {
      said += rogue.say(Channel::reliable, *words) ? 1 : 0;
    }
    const Bytes datagram = writer.bytes();
    said += rogue.say(Channel::datagram, Buffer(datagram.begin(), datagram.end())) ? 1 : 0;
    return false;
  });
  EXPECT_EQ(said, 7);
  EXPECT_EQ(scene.match.host().session.stats().refused - before, 7u);
  EXPECT_FALSE(rogue.is_welcome);
  // Who connects and says nothing that counts is sent away.
  scene.match.run(scene.config.silence, [&] {
    rogue.listen();
    return false;
  });
  EXPECT_FALSE(rogue.is_connected);
}

TEST(HostileGuest, OneHelloIsHeardAndAThousandMoreAreNot) {
  SeatedRogue scene;
  const std::uint64_t before = scene.match.host().session.stats().refused;
  const std::uint64_t token = scene.rogue.welcome.token;
  for (int n = 0; n < 1000; ++n) scene.rogue.greet(hello_of(scene.config));
  scene.play(kSecond, [] {});
  EXPECT_EQ(scene.match.host().session.stats().refused - before, 1000u);
  EXPECT_FALSE(scene.match.host().heard(Kind::refused));
  EXPECT_EQ(scene.rogue.welcome.token, token);
  scene.expect_progress(60);
}

TEST(HostileGuest, ASeatIsTakenOverWithItsTokenAndWithNoOther) {
  SeatedRogue scene;
  Pcg32 random = Pcg32::seeded(77);
  std::vector<std::unique_ptr<Rogue>> thieves;
  for (int n = 0; n < 8; ++n) thieves.push_back(std::make_unique<Rogue>(scene.match, lan()));
  std::size_t greeted = 0;
  scene.play(kSecond, [&] {
    for (auto& thief : thieves) {
      const bool before = thief->is_connected;
      thief->listen();
      if (before || !thief->is_connected) continue;
      Hello hello = hello_of(scene.config);
      hello.token = scene.rogue.welcome.token ^ (greeted == 0 ? 2u : std::uint64_t{random.next()} << 32 | 1u);
      ++greeted;
      thief->greet(hello);
    }
  });
  EXPECT_EQ(greeted, 8u);
  for (const auto& thief : thieves) {
    EXPECT_TRUE(thief->is_refused);
    EXPECT_FALSE(thief->is_welcome);
  }
  EXPECT_TRUE(scene.rogue.is_connected);

  Rogue owner(scene.match, lan());
  scene.play(kSecond, [&] {
    const bool before = owner.is_connected;
    owner.listen();
    if (before || !owner.is_connected) return;
    Hello hello = hello_of(scene.config);
    hello.token = scene.rogue.welcome.token;
    owner.greet(hello);
  });
  EXPECT_TRUE(owner.is_welcome);
  EXPECT_EQ(owner.welcome.player, scene.rogue.welcome.player);
  EXPECT_NE(owner.welcome.token, scene.rogue.welcome.token);
  EXPECT_FALSE(scene.rogue.is_connected) << "the old connection is ended, not forgotten";
  scene.expect_progress(60);
}

TEST(HostileGuest, WhoComesAndGoesDoesNotPushTheMatchOutOfItsLog) {
  SessionConfig config = three_players();
  config.exclusion = 0;  // it may play again at once
  Scene scene(config);
  std::unique_ptr<Rogue> rogue = std::make_unique<Rogue>(scene.match, transport::parse_profile("loopback").value());
  int opened = 0;
  std::uint64_t token = 0;
  bool greeted = false;
  scene.match.run(20 * kSecond, [&] {
    rogue->listen();
    if (rogue->is_connected && !greeted) {
      greeted = true;
      Hello hello = hello_of(scene.config);
      hello.token = token;
      rogue->greet(hello);
    }
    if (rogue->is_welcome) {
      token = rogue->welcome.token;
      PacketHeader header;  // a round trip of half a minute: the longest notice
      header.match = rogue->welcome.match;
      header.has_echo = true;
      header.echo = static_cast<std::uint16_t>(scene.match.now() / 1000 - 32000);
      header.ack_mask = 7;  // who acknowledges nothing is put out
      for (const int p : {0, 1, 2}) header.ack[p] = rogue->ends[p];
      std::uint8_t buffer[kDatagramCap];
      const Bytes bytes = PacketWriter(header, buffer).bytes();
      rogue->say(Channel::datagram, Buffer(bytes.begin(), bytes.end()));
      Buffer ready;
      write_ready(ready);
      rogue->say(Channel::reliable, ready);
    }
    if (rogue->opens > 0) {
      ++opened;
      rogue->port.disconnect(0);
      rogue = std::make_unique<Rogue>(scene.match, transport::parse_profile("loopback").value());
      greeted = false;
    }
    return false;
  });
  EXPECT_GT(opened, 50);
  EXPECT_EQ(scene.honest->restarts, 0);
  EXPECT_GT(scene.honest->end(), 550);  // of 1200: the first stood still for its patience and the free start
  expect_honest(scene.match, 550);
  expect_no_desync({&scene.match.host(), scene.honest});
}

TEST(HostileGuest, ASnapshotThatIsNeverTakenDoesNotKeepOthersOut) {
  SessionConfig config = three_players();
  config.history = 400;
  Scene scene(config, 2 * kSnapshotFlight);
  scene.match.run(kSecond, [] { return false; });
  scene.match.host().session.start(scene.match.now());
  // A spectator with a strange state gets a snapshot, says that a little of it came, and again, and again.
  Rogue rogue(scene.match, lan());
  bool greeted = false;
  std::uint32_t arrived = 0;
  Peer* late = nullptr;
  scene.match.run(30 * kSecond, [&] {
    rogue.listen();
    if (rogue.is_connected && !greeted && scene.match.now() > 3 * kSecond) {
      greeted = true;
      Hello hello = hello_of(scene.config);
      hello.spectator = true;
      hello.have = {12345, 6};
      rogue.greet(hello);
    }
    if (rogue.is_welcome && scene.match.now() % (500 * kMs) == 0) {
      Buffer progress;
      write_progress(++arrived, progress);
      rogue.say(Channel::reliable, progress);
    }
    if (late == nullptr && scene.match.now() > 12 * kSecond) late = &scene.match.add(lan());
    return late != nullptr && late->session.phase() == SessionPhase::playing;
  });
  ASSERT_NE(late, nullptr);
  EXPECT_EQ(late->session.phase(), SessionPhase::playing);
  expect_no_desync({&scene.match.host(), scene.honest, late});
}

TEST(HostileGuest, ComingAndGoingAtAnyMomentDisturbsNobody) {
  Scene scene;
  Pcg32 random = Pcg32::seeded(3);
  std::unique_ptr<BentPeer> peer;
  std::vector<transport::EndpointId> ids;
  scene.match.run(20 * kSecond, [&] {
    if (!peer) peer = std::make_unique<BentPeer>(scene.match, scene.client_config(), lan());
    peer->turn(scene.match.now());
    if (random.next() % 400 == 0) {
      if (random.next() % 2 == 0) {
        peer->network->cut(peer->id);
      } else {
        peer->port.disconnect(0);
      }
      peer.reset();
    }
    return false;
  });
  EXPECT_GT(scene.honest->end(), 700);
  scene.expect_progress(60);
}

}  // namespace session_guest_test
}  // namespace isostep::hostile
