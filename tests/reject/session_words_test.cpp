// Hostile words that are well formed and untrue, and peers that play with time.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "hostile_scene.hpp"
#include "isostep/core/random.hpp"

namespace isostep::hostile {
namespace session_words_test {

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
        const auto count = static_cast<std::uint32_t>(frame);
        header.echo = static_cast<std::uint16_t>(count * 7);
        header.time = static_cast<std::uint16_t>(count * 13);
        header.number = static_cast<std::uint16_t>(count * 31);
        header.figured = static_cast<std::uint8_t>(frame % 5);
        header.figures = {.waited = 0xffffffffu, .round_trip = 0xffffffffu, .loss = 1000};
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
  Match match = make_match(config);
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
    ASSERT_EQ(first.hashes[f], match.host().hashes[f]);
    ASSERT_EQ(second.hashes[f], match.host().hashes[f]);
  }
}

TEST(HostileWords, HashesOfTheFutureAreNotComparedAndHideNothing) {
  SeatedRogue scene;
  scene.play(2 * kSecond, [&] {
    for (const Frame ahead : {30, 1000, 100000000}) {
      scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
        header.report = {header.frame + ahead, 0x1234};
      }));
    }
  });
  expect_no_desync({&scene.match.host(), scene.honest});
  EXPECT_GT(scene.match.host().end(), 90);
  // One about the present is still heard.
  scene.play(kSecond, [&] {
    scene.rogue.say(Channel::datagram, scene.packet([&](PacketHeader& header) {
      header.report = {header.frame - 20, 0x1234};
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

/// [us] The first five seconds of a match are charged to nobody: delays find out how long the lines are.
constexpr Time kCharged = 6 * kSecond;

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
  scene.play(kCharged, [] {});
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
  scene.play(kCharged, [] {});
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
  Match match = make_match(config);
  for (int i = 0; i < 5; ++i) match.add(lan());
  ASSERT_TRUE(match.run_to(400, 10 * kSecond));
  for (std::size_t i = 2; i < 6; ++i) {
    match.run((i + 1) * 7 * kMs, [] { return false; });
    match.machine(i).muted = true;
  }
  const Frame from = match.host().end();
  EXPECT_TRUE(match.run(config.patience + 1500 * kMs, [&] { return match.host().end() >= from + 60; }));
}

}  // namespace session_words_test
}  // namespace isostep::hostile
