// Hostile peers: whatever one of them says, nothing crashes, memory stays bounded, and the honest play on as if it had
// said nothing.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <new>

#include "../unit/session/hostile.hpp"
#include "isostep/core/random.hpp"

namespace {
std::size_t allocations = 0, allocated = 0;  // [bytes] the latter

void* counted(std::size_t size) {
  ++allocations;
  allocated += size;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) std::abort();
  return memory;
}
}  // namespace

// Not inlined: gcc would take one half of a pair for a mismatch with the other.
#define NOT_INLINED __attribute__((noinline))
NOT_INLINED void* operator new(std::size_t size) { return counted(size); }
NOT_INLINED void operator delete(void* memory) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace isostep {
namespace {

using hostile::BentPeer;
using hostile::Buffer;
using hostile::Game;
using hostile::Match;
using hostile::Pad;
using hostile::Rogue;
using Kind = SessionEvent::Kind;
using Peer = test::Machine<Game>;

constexpr Time kMs = 1000;  // [us]

transport::NetworkProfile lan() { return transport::parse_profile("latency=10").value(); }

SessionConfig three_players() {
  SessionConfig config;
  config.players = 3;
  config.most_packets = 10000000;  // so that strange packets are read and not only counted
  return config;
}

/// Same roots at all honest machines as in one process that plays the same inputs.
void expect_honest(Match& match, Frame at_least) {
  const std::vector<std::uint64_t> straight = match.straight(match.host().end());
  for (std::size_t i = 0; i < match.size(); ++i) {
    const Peer& peer = match.machine(i);
    EXPECT_TRUE(peer.in_order) << "machine " << i;
    EXPECT_GE(peer.end(), at_least) << "machine " << i;
    for (Frame f = peer.first; f < peer.end() && f < match.host().end(); ++f) {
      ASSERT_EQ(peer.roots[static_cast<std::size_t>(f - peer.first)], straight[static_cast<std::size_t>(f)])
          << "machine " << i << ", frame " << f;
    }
  }
}
void expect_no_desync(std::initializer_list<const Peer*> peers) {
  for (const Peer* peer : peers) EXPECT_FALSE(peer->heard(Kind::desync));
}

/// Host, one honest client, and a seat for the hostile one.
struct Scene {
  explicit Scene(const SessionConfig& its_config = three_players(), std::size_t ballast = 40000)
      : config(its_config), match(hostile::make_match(its_config, ballast)) {
    honest = &match.add(lan());
  }
  SessionConfig client_config() const {
    SessionConfig client = config;
    client.local_players = 0;
    return client;
  }
  /// The honest alone from now on must get `frames` further.
  void expect_progress(Frame frames) {
    const Frame from = honest->end();
    EXPECT_TRUE(match.run_to(from + frames, static_cast<Time>(frames) * 20 * kMs + 12 * kSecond));
    expect_honest(match, from + frames);
    expect_no_desync({&match.host(), honest});
  }
  SessionConfig config;
  Match match;
  Peer* honest;
};

/// A rogue that has said hello, at the time when the match runs.
struct SeatedRogue : Scene {
  explicit SeatedRogue(const SessionConfig& its_config = three_players()) : Scene(its_config), rogue(match, lan()) {
    const bool seated = match.run(2 * kSecond, [&] {
      const bool before = rogue.is_connected;
      rogue.listen();
      if (!before && rogue.is_connected) rogue.greet(hostile::hello_of(config));
      return rogue.is_welcome && rogue.host_frame > 2;
    });
    EXPECT_TRUE(seated);
    EXPECT_EQ(rogue.opens, 0);
  }
  /// Well formed but for what `change` does to it.
  Buffer packet(const std::function<void(PacketHeader&)>& change, const InputStream* stream = nullptr, Frame first = 0,
                std::uint8_t player = 0xff) {
    PacketHeader header;
    header.match = rogue.welcome.match;
    header.frame = rogue.host_frame;
    header.started = true;
    if (change) change(header);
    std::uint8_t buffer[kDatagramCap];
    PacketWriter writer(header, buffer);
    if (stream != nullptr) writer.add_slice(player == 0xff ? rogue.welcome.player : player, *stream, first);
    return Buffer(writer.bytes().begin(), writer.bytes().end());
  }
  /// Inputs of our own up to `end`, as an honest player would send them.
  InputStream stream_to(Frame end) {
    InputStream stream(4096, 2);
    for (Frame f = 0; f < end; ++f) {
      const std::uint8_t bytes[2] = {static_cast<std::uint8_t>(f % 100), 1};
      stream.append({false, bytes});
    }
    return stream;
  }
  /// Keeps the match going while `each` does its worst.
  template <class Each> void play(Time limit, Each&& each) {
    match.run(limit, [&] {
      rogue.listen();
      const Frame end = rogue.host_frame + 10;
      const InputStream stream = stream_to(end);
      rogue.say(Channel::datagram, packet(nullptr, &stream, end > 60 ? end - 60 : 0));
      each();
      return false;
    });
  }
  Rogue rogue;
};

// --- bytes ---

/// What a client says within a match, from its first word on.
std::vector<std::pair<Channel, Buffer>> captured(const SessionConfig& config) {
  Match match = hostile::make_match(config);
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
      if (!bytes.empty() && channel != Channel::datagram && bytes[0] < 8) bytes[0] = 99;
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
  datagram.resize(kDatagramCap + 1);
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

// --- floods ---

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
        Hello hello = hostile::hello_of(config);
        hello.spectator = true;
        rogue.greet(hello);
      }
      header.match = rogue.welcome.match;
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
  const std::size_t before = allocations;
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
  EXPECT_LT(allocations - before, 20u);
  EXPECT_GT(host.stats().refused, 100000u);
  EXPECT_GT(sent, 100u);
}

// --- words that are well formed and untrue ---

TEST(HostileWords, InputsThatNobodyMayGiveAreNotPlayed) {
  SeatedRogue scene;
  const std::uint8_t fine[2] = {7, 7}, invalid[2] = {101, 0}, longer[3] = {1, 2, 3}, shorter[1] = {1};
  InputStream others(4096, 2), absent(4096, 2), wrong(4096, 3), tall(4096, 3), small(4096, 3);
  for (Frame f = 0; f < 2000; ++f) {
    others.append({false, fine});
    absent.append({true, {}});
    wrong.append({false, invalid});
    tall.append({false, longer});
    small.append({false, shorter});
  }
  scene.play(3 * kSecond, [&] {
    const Frame now = scene.rogue.host_frame;
    for (const std::uint8_t player : {0, 1, 2, 3, 7}) {
      if (player == scene.rogue.welcome.player) continue;
      for (const Frame first : {now > 5 ? now - 5 : 0, now, now + 1, now + 100, now + 1500}) {
        scene.rogue.say(Channel::datagram, scene.packet(nullptr, &others, first % 2000, player));
      }
    }
    for (const InputStream* stream : {&absent, &wrong, &tall, &small}) {
      for (const Frame first : {Frame{0}, now, now + 2, now + 11}) {
        scene.rogue.say(Channel::datagram, scene.packet(nullptr, stream, first % 2000));
      }
    }
  });
  EXPECT_GT(scene.match.host().session.stats().refused, 1000u);
  const std::size_t own = scene.rogue.welcome.player;
  for (std::size_t f = 0; f < scene.match.host().inputs.size(); ++f) {
    const auto& said = scene.match.host().inputs[f];
    for (std::size_t p = 0; p < 3; ++p) {
      ASSERT_FALSE(said[p].absent);
      ASSERT_NE(said[p].input, (Pad{7, 7}));
    }
    ASSERT_EQ(said[own].input, (Pad{static_cast<std::int8_t>(f % 100), 1}));
  }
  EXPECT_GT(scene.match.host().end(), 150);
  scene.expect_progress(60);
}

TEST(HostileWords, WhatWasSaidOnceStandsWhateverIsSaidLater) {
  SeatedRogue scene;
  InputStream other(4096, 2);
  const std::uint8_t later[2] = {50, 50};
  for (Frame f = 0; f < 2000; ++f) other.append({false, later});
  scene.play(2 * kSecond, [&] {
    const Frame now = scene.rogue.host_frame;
    scene.rogue.say(Channel::datagram, scene.packet(nullptr, &other, now > 40 ? now - 40 : 0));
  });
  // Which of two words for one frame comes first is the network's choice; everybody plays the same one.
  scene.expect_progress(60);
}

TEST(HostileWords, FramesAndAcknowledgementsFromNowhereAreWithoutEffect) {
  SeatedRogue scene;
  const InputStream stream = scene.stream_to(4000);
  scene.play(3 * kSecond, [&] {
    for (const Frame frame : {0, 1, 1000000, kLastFrame - 1, kLastFrame}) {
      scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
        header.frame = frame;
        header.ack_mask = 0xff;
        for (std::size_t p = 0; p < kMaxPlayers; ++p) {
          header.ack[p] = p % 2 == 0 ? kLastFrame : static_cast<Frame>(frame / 2);
          header.slack[p] = p % 2 == 0 ? std::int8_t{-128} : std::int8_t{127};
        }
        header.has_echo = true;
        header.echo = static_cast<std::uint16_t>(frame * 7);
        header.time = static_cast<std::uint16_t>(frame * 13);
      }));
    }
    // Inputs of the far future: not even a fast clock gives them.
    for (const Frame first : {1000, 2000, 3000})
      scene.rogue.say(Channel::datagram, scene.packet(nullptr, &stream, first));
  });
  EXPECT_GT(scene.match.host().end(), 150);
  EXPECT_LE(scene.match.host().session.stats().delay, scene.config.most_delay);
  scene.expect_progress(60);
}

TEST(HostileWords, ALiarAboutItsStatesIsNamedAndNobodyElse) {
  SessionConfig config = three_players();
  config.players = 4;
  Match match = hostile::make_match(config);
  Peer& first = match.add(lan());
  Peer& second = match.add(lan());
  Peer& liar = match.add(transport::parse_profile("latency=30,jitter=10").value());  // greets last
  liar.tamper = [](Game& game, Frame frame) { game.lies = frame >= 200; };
  ASSERT_TRUE(match.run_to(600, 20 * kSecond));
  const auto named = [](const Peer& peer) {
    std::vector<int> who;
    for (const SessionEvent& event : peer.events) {
      if (event.kind != Kind::desync) continue;
      who.push_back(event.player);
      EXPECT_GE(event.frame, 200);
      EXPECT_LT(event.frame, 260);
      EXPECT_LE(event.agreed, 201);
      EXPECT_LT(event.agreed, event.frame);
    }
    return who;
  };
  EXPECT_EQ(named(match.host()), std::vector<int>{3});
  EXPECT_EQ(named(first), std::vector<int>{3});
  EXPECT_EQ(named(second), std::vector<int>{3});
  std::vector<int> all = named(liar);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<int>{1, 2, 0xff}));
  for (std::size_t f = 0; f < 600; ++f) {
    ASSERT_EQ(first.roots[f], match.host().roots[f]);
    ASSERT_EQ(second.roots[f], match.host().roots[f]);
  }
}

TEST(HostileWords, RootsOfTheFutureAreNotComparedAndHideNothing) {
  SeatedRogue scene;
  scene.play(2 * kSecond, [&] {
    for (const Frame ahead : {30, 1000, 100000000}) {
      scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
        header.root = {header.frame + ahead, 0x1234};
      }));
    }
  });
  expect_no_desync({&scene.match.host(), scene.honest});
  EXPECT_GT(scene.match.host().end(), 90);
  // One about the present is still heard.
  scene.play(kSecond, [&] {
    scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
      header.root = {header.frame - 20, 0x1234};
    }));
  });
  for (const Peer* peer : std::initializer_list<const Peer*>{&scene.match.host(), scene.honest}) {
    int named = 0;
    for (const SessionEvent& event : peer->events) {
      if (event.kind != Kind::desync) continue;
      ++named;
      EXPECT_EQ(event.player, scene.rogue.welcome.player);
    }
    EXPECT_EQ(named, 1);
  }
}

TEST(HostileWords, NonsenseAboutTheRoundTripDelaysOnlyTheLiarsOwnReturn) {
  SeatedRogue scene;
  const Frame before = scene.match.host().end();
  scene.play(3 * kSecond, [&] {
    scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
      header.has_echo = true;
      header.echo = static_cast<std::uint16_t>(scene.match.now() / 1000 - 32000);
    }));
  });
  EXPECT_GT(scene.match.host().end() - before, 170);
  scene.expect_progress(60);
}

// --- time ---

TEST(HostileTime, AFastClockGainsNoFramesAndChangesNobodysRate) {
  const auto frames_with = [](Time pace, Frame& own) {
    Scene scene;
    BentPeer peer(scene.match, scene.client_config(), lan());
    scene.match.run(10 * kSecond, [&] {
      peer.turn(scene.match.now() * pace / 4);
      return false;
    });
    expect_no_desync({&scene.match.host(), scene.honest});
    expect_honest(scene.match, 500);
    own = peer.session.current();
    return scene.match.host().end();
  };
  Frame own = 0, own_fast = 0;
  const Frame calm = frames_with(4, own);
  const Frame fast = frames_with(12, own_fast);
  EXPECT_NEAR(fast, calm, 3);
  EXPECT_LE(own_fast, own + SessionConfig{}.window + SessionConfig{}.most_delay + 2);
}

/// The longest time that the host stood still, and all of it [us].
struct Stall {
  Time longest = 0, whole = 0;
};
template <class Each> Stall stalls(Scene& scene, Time limit, Each&& each) {
  Stall stall;
  Frame last = -1;
  Time since = scene.match.now();
  scene.match.run(limit, [&] {
    each();
    if (scene.match.host().session.current() == last) {
      const Time still = scene.match.now() - since;
      stall.longest = std::max(stall.longest, still);
      if (still > 20 * kMs) stall.whole += kMs;
    } else {
      last = scene.match.host().session.current();
      since = scene.match.now();
    }
    return false;
  });
  return stall;
}

TEST(HostileTime, ASilentPeerHoldsTheMatchUpForItsPatienceOnce) {
  SessionConfig config = three_players();
  config.patience = 2 * kSecond;
  SeatedRogue scene(config);
  scene.play(kSecond, [] {});
  const Stall stall = stalls(scene, 10 * kSecond, [] {});
  EXPECT_GT(stall.longest, config.patience - 100 * kMs);
  EXPECT_LT(stall.longest, config.patience + 200 * kMs);
  EXPECT_LT(stall.whole, config.patience + 200 * kMs);
  EXPECT_GT(scene.honest->end(), 400);
  expect_honest(scene.match, 400);
  expect_no_desync({&scene.match.host(), scene.honest});
}

TEST(HostileTime, InputsThatDripJustInTimeDoNotHoldTheMatchUpForEver) {
  SessionConfig config = three_players();
  config.patience = 2 * kSecond;
  SeatedRogue scene(config);
  scene.play(kSecond, [] {});
  Time next = 0;
  const Stall stall = stalls(scene, 20 * kSecond, [&] {
    scene.rogue.listen();
    if (scene.match.now() < next) return;
    next = scene.match.now() + 1900 * kMs;
    const InputStream stream = scene.stream_to(scene.rogue.host_frame + 2);
    scene.rogue.say(Channel::datagram, scene.packet(nullptr, &stream, std::max(0, scene.rogue.host_frame - 60)));
  });
  EXPECT_LT(stall.whole, config.patience + 500 * kMs);
  EXPECT_GT(scene.honest->end(), 900);
  expect_honest(scene.match, 900);
}

TEST(HostileTime, EverybodySilentAtOnceCostsOnePatience) {
  SessionConfig config = three_players();
  config.players = 6;
  config.patience = 2 * kSecond;
  config.silence = 30 * kSecond;
  Match match = hostile::make_match(config);
  for (int i = 0; i < 5; ++i) match.add(lan());
  ASSERT_TRUE(match.run_to(100, 10 * kSecond));
  for (std::size_t i = 2; i < 6; ++i) {
    match.run((i + 1) * 7 * kMs, [] { return false; });
    match.machine(i).muted = true;
  }
  const Frame from = match.host().end();
  EXPECT_TRUE(match.run(config.patience + 1500 * kMs, [&] { return match.host().end() >= from + 60; }));
}

// --- coming and going ---

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
  for (int n = 0; n < 1000; ++n) scene.rogue.greet(hostile::hello_of(scene.config));
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
      Hello hello = hostile::hello_of(scene.config);
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
    Hello hello = hostile::hello_of(scene.config);
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
  Scene scene;
  std::unique_ptr<Rogue> rogue = std::make_unique<Rogue>(scene.match, transport::parse_profile("loopback").value());
  int opened = 0;
  std::uint64_t token = 0;
  bool greeted = false;
  scene.match.run(20 * kSecond, [&] {
    rogue->listen();
    if (rogue->is_connected && !greeted) {
      greeted = true;
      Hello hello = hostile::hello_of(scene.config);
      hello.token = token;
      rogue->greet(hello);
    }
    if (rogue->is_welcome) {
      token = rogue->welcome.token;
      PacketHeader header;  // a round trip of half a minute: the longest notice
      header.match = rogue->welcome.match;
      header.has_echo = true;
      header.echo = static_cast<std::uint16_t>(scene.match.now() / 1000 - 32000);
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
  EXPECT_GT(scene.honest->end(), 850);  // of 1200: the first stood still for its patience
  expect_honest(scene.match, 850);
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
      Hello hello = hostile::hello_of(scene.config);
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

// --- a hostile host ---

/// A client whose host is the test.
struct Victim {
  explicit Victim(SessionMode mode = SessionMode::rollback) : session(make(mode)) {
    session.connected(0, now);
    drive(session, game, now);
    while (session.poll_send(now)) {}
  }
  static SessionConfig make(SessionMode mode) {
    SessionConfig config = three_players();
    config.local_players = 0;
    config.mode = mode;
    return config;
  }
  void hear(const Buffer& bytes, Channel channel = Channel::reliable) { session.receive(0, channel, bytes, now); }
  void hear_welcome(const Welcome& welcome) {
    Buffer bytes;
    write_welcome(welcome, bytes);
    hear(bytes);
  }
  void hear_piece(std::uint32_t offset, Bytes content) {
    Buffer bytes;
    write_piece({offset, content}, bytes);
    hear(bytes);
  }
  void turn() {
    now += kMs;
    for (int p = 0; p < 3; ++p) session.add_local_input(p, {1, 1});
    drive(session, game, now);
    while (session.poll_send(now)) {}
  }
  static Welcome first_welcome() {
    return {.match = 9,
            .players = 3,
            .host_players = 1,
            .player = 1,
            .token = 1,
            .start = {0, Game{}.hash()},
            .root = Game{}.hash(),
            .snapshot_size = 0,
            .opens = 0};
  }
  Buffer datagram(const std::function<void(PacketHeader&)>& change = nullptr) {
    PacketHeader header;
    header.match = 9;
    header.started = true;
    if (change) change(header);
    std::uint8_t buffer[kDatagramCap];
    const Bytes bytes = PacketWriter(header, buffer).bytes();
    return Buffer(bytes.begin(), bytes.end());
  }
  Time now = 1000;
  Session<Game> session;
  Game game;
};

TEST(HostileHost, AWelcomeToAStateThatWeDoNotHaveIsRefused) {
  for (const RootReport start :
       {RootReport{1, Game{}.hash()}, RootReport{0, 5}, RootReport{100000, 5}, RootReport{kLastFrame, 1}}) {
    Victim victim;
    Welcome welcome = Victim::first_welcome();
    welcome.start = start;
    victim.hear_welcome(welcome);
    victim.turn();
    EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
    EXPECT_EQ(victim.session.current(), 0);
  }
}

TEST(HostileHost, PromisesOfSizeCostNoMemory) {
  Victim victim;
  Welcome welcome = Victim::first_welcome();
  welcome.opens = kNoFrame;
  for (const std::uint32_t size : {1u, 16u << 20, 64u << 20}) {
    welcome.snapshot_size = size;
    for (int n = 0; n < 10; ++n) {
      victim.now += 10 * kMs;
      victim.hear_welcome(welcome);
    }
    EXPECT_LT(victim.session.portable().capacity(), 100000u);
    EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  }
  welcome.snapshot_size = (64u << 20) + 1;
  victim.hear_welcome(welcome);
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
}

TEST(HostileHost, PiecesOutOfOrderOverlappingOrTooManyAreRefused) {
  Victim victim;
  Welcome welcome = Victim::first_welcome();
  welcome.start = {50, 3};
  welcome.snapshot_size = 100;
  const Buffer content(60, 7);
  victim.hear_piece(0, content);
  EXPECT_EQ(victim.session.stats().refused, 1u) << "none was promised";
  victim.hear_welcome(welcome);
  victim.hear_piece(60, content);
  victim.hear_piece(1, content);
  EXPECT_TRUE(victim.session.portable().empty());
  victim.hear_piece(0, content);
  victim.hear_piece(0, content);
  victim.hear_piece(30, content);
  victim.hear_piece(60, content);
  victim.hear_piece(0xffffffffu, content);
  EXPECT_EQ(victim.session.portable().size(), 60u);
  EXPECT_EQ(victim.session.stats().refused, 7u);
  for (int n = 0; n < 100; ++n) victim.hear_piece(60, {});
  EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  victim.hear_piece(60, Bytes(content).first(40));
  victim.hear_piece(100, {});
  victim.turn();  // a state that the game refuses
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
  EXPECT_EQ(victim.session.current(), 50);
}

TEST(HostileHost, AStateThatIsNotTheOneWhoseRootWasNamedIsRefused) {
  Victim victim;
  Game other;
  Buffer state;
  Writer writer(state);
  other.write_portable(writer);
  Welcome welcome = Victim::first_welcome();
  welcome.start = {50, 3};
  welcome.root = other.hash() ^ 1;
  welcome.opens = kNoFrame;
  welcome.snapshot_size = static_cast<std::uint32_t>(state.size());
  victim.hear_welcome(welcome);
  for (std::size_t at = 0; at < state.size(); at += 10000) {
    victim.hear_piece(static_cast<std::uint32_t>(at),
                      Bytes(state).subspan(at, std::min<std::size_t>(10000, state.size() - at)));
  }
  victim.turn();
  EXPECT_EQ(victim.session.phase(), SessionPhase::refused);
  bool told = false;
  while (const auto event = victim.session.poll_event()) told = told || event->kind == Kind::bad_snapshot;
  EXPECT_TRUE(told);

  // The same session may try again: it asks for a state, for it has none of the match any more.
  victim.session.connected(0, victim.now);
  std::optional<Hello> hello;
  while (const auto out = victim.session.poll_send(victim.now)) {
    if (out->channel == Channel::reliable && !out->bytes.empty()) hello = read_hello(out->bytes).value();
  }
  ASSERT_TRUE(hello.has_value());
  EXPECT_EQ(hello->have.frame, 0);
  EXPECT_EQ(hello->have.chain, 0u);
  welcome.root = other.hash();
  victim.hear_welcome(welcome);
  for (std::size_t at = 0; at < state.size(); at += 10000) {
    victim.hear_piece(static_cast<std::uint32_t>(at),
                      Bytes(state).subspan(at, std::min<std::size_t>(10000, state.size() - at)));
  }
  victim.turn();
  EXPECT_EQ(victim.session.phase(), SessionPhase::joining);
  EXPECT_EQ(victim.session.confirmed(), 50);
}

TEST(HostileHost, ASpectatorIsNeverSeated) {
  for (const Frame opens : {kNoFrame, 0, 5, kLastFrame}) {
    for (const std::uint8_t player :
         {std::uint8_t{0}, std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{0xfe}, std::uint8_t{0xff}}) {
      Victim victim(SessionMode::spectator);
      Welcome welcome = Victim::first_welcome();
      welcome.player = player;
      welcome.opens = opens;
      victim.hear_welcome(welcome);
      Buffer open;
      write_open(3, open);
      victim.hear(open);
      victim.turn();
      victim.hear(open);
      victim.turn();
      EXPECT_FALSE(victim.session.wants_input(0) || victim.session.wants_input(1) || victim.session.wants_input(2));
    }
  }
}

TEST(HostileHost, OpeningsThatMakeNoSenseAreRefused) {
  for (const Frame first : {Frame{-1}, Frame{601}, Frame{100000}, kLastFrame, kLastFrame + 1, Frame{0x7fffffff}}) {
    Victim victim;
    Welcome welcome = Victim::first_welcome();
    welcome.opens = kNoFrame;
    victim.hear_welcome(welcome);
    victim.turn();
    const std::uint64_t before = victim.session.stats().refused;
    Buffer open;
    write_open(first, open);
    victim.hear(open);
    EXPECT_EQ(victim.session.stats().refused, before + 1) << first;
    EXPECT_FALSE(victim.session.wants_input(1));
    write_open(600, open);
    victim.hear(open);
    EXPECT_TRUE(victim.session.wants_input(1));
    victim.hear(open);
    EXPECT_EQ(victim.session.stats().refused, before + 2) << "opened twice";
  }
}

TEST(HostileHost, AnythingAtAllInAnyOrderBreaksNothing) {
  Pcg32 random = Pcg32::seeded(11);
  for (int run = 0; run < 60; ++run) {
    Victim victim(run % 3 == 0 ? SessionMode::spectator : SessionMode::rollback);
    InputStream stream(400, 2);
    const auto frame = [&]() -> Frame {
      const Frame near = victim.session.current() + static_cast<Frame>(random.next() % 80) - 40;
      const Frame odd[] = {0, 1, 600, 1200, kLastFrame - 1, kLastFrame};
      return random.next() % 4 == 0 ? odd[random.next() % 6] : near < 0 ? 0 : near;
    };
    for (int step = 0; step < 400; ++step) {
      Buffer bytes;
      switch (random.next() % 8) {
        case 0: {
          Welcome welcome = Victim::first_welcome();
          if (random.next() % 2 == 0) welcome.start = {frame(), random.next()};
          welcome.player = random.next() % 3 == 0 ? 0xff : static_cast<std::uint8_t>(random.next() % 4);
          welcome.opens = random.next() % 2 == 0 ? kNoFrame : frame();
          welcome.snapshot_size = random.next() % 3 == 0 ? 10 : 0;
          if (step % 50 == 0) victim.hear_welcome(welcome);
          break;
        }
        case 1:
          write_open(frame(), bytes);
          victim.hear(bytes);
          break;
        case 2: victim.hear_piece(random.next() % 12, Buffer(random.next() % 12)); break;
        case 3:
          if (step % 60 == 0) victim.session.disconnected(0, victim.now);
          if (step % 40 == 0) victim.session.connected(0, victim.now);
          break;
        case 4: {
          Welcome fine = Victim::first_welcome();
          if (victim.session.phase() != SessionPhase::playing) victim.hear_welcome(fine);
          break;
        }
        default: {
          const Frame first = frame();
          stream.reset(first);
          for (std::uint32_t n = random.next() % 100; n > 0; --n) {
            const std::uint8_t input[2] = {static_cast<std::uint8_t>(random.next() % 3), 0};
            if (random.next() % 10 == 0) {
              stream.append({true, {}});
            } else {
              stream.append({false, input});
            }
          }
          PacketHeader header;
          header.match = 9;
          header.started = random.next() % 2 == 0;
          header.frame = frame();
          header.root = {random.next() % 2 == 0 ? kNoFrame : frame(), random.next() % 5};
          header.ack_mask = static_cast<std::uint8_t>(random.next());
          for (Frame& ack : header.ack) ack = frame();
          for (std::int8_t& slack : header.slack) slack = static_cast<std::int8_t>(random.next());
          header.reporter = static_cast<std::uint8_t>(random.next() % 9);
          header.passed_on = {frame(), random.next() % 5};
          std::uint8_t buffer[kDatagramCap];
          PacketWriter writer(header, buffer);
          for (std::uint8_t p = 0; p < 4; ++p) writer.add_slice(p, stream, first);
          victim.hear(Buffer(writer.bytes().begin(), writer.bytes().end()), Channel::datagram);
          break;
        }
      }
      const Frame confirmed = victim.session.confirmed();
      victim.turn();
      while (victim.session.poll_event()) {}
      ASSERT_GE(victim.session.confirmed(), std::min(confirmed, victim.session.current()));
      ASSERT_LE(victim.session.current(), kLastFrame);
      if (random.next() % 30 == 0) victim.now += 20 * kMs * (random.next() % 10);
    }
  }
}

}  // namespace
}  // namespace isostep
