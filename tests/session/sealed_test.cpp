// A match whose lines are sealed, in virtual time: the same history as without, under loss, cuts and forgeries.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "isostep/core/random.hpp"
#include "isostep/session/session.hpp"
#include "sealed/sealed_transport.hpp"
#include "session/toy_game.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::test {
namespace sealed_test {

using transport::EndpointId;
using transport::SimulatedNetwork;
using Sealed = sealed::SealedTransport<SimulatedNetwork::Port>;

sealed::SealSettings match_key() {
  sealed::SealSettings settings{.keys = {{.id = 1, .secret = {}}}, .own_key = 1};
  settings.keys[0].secret.fill(0x33);
  return settings;
}

struct Peer {
  Peer(SimulatedNetwork& network, EndpointId its_id, const SessionConfig& config)
      : id(its_id), port(network.port(its_id)), line(port, match_key()), session(config) {}

  void confirmed(Frame frame, std::uint64_t hash) {
    hashes[frame] = hash;
    for (int p = 0; p < session.config().players; ++p) {
      values[frame].push_back(session.input(frame, p));
      statuses[frame].push_back(session.status(frame, p) == InputStatus::disconnected ? InputStatus::disconnected
                                                                                      : InputStatus::confirmed);
    }
  }
  void turn(Time now) {
    transport::deliver(line, session, now);
    const int player = session.config().host ? 0 : session.local_player();
    if (player >= 0) session.add_local_input(player, toy_input(3, player, session.current()));
    drive(session, game, now, *this);
    transport::dispatch(line, session, now);
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      is_desynced = is_desynced || event->kind == SessionEvent::Kind::desync;
    }
  }

  EndpointId id;
  SimulatedNetwork::Port port;
  Sealed line;
  Session<Toy> session;
  Toy game;
  std::map<Frame, std::uint64_t> hashes;
  std::map<Frame, std::vector<ToyInput>> values;
  std::map<Frame, std::vector<InputStatus>> statuses;
  bool is_desynced = false;
};

struct Match {
  Match(SessionMode mode, const char* line) {
    SessionConfig config;
    config.players = 4;
    config.mode = mode;
    config.seed = 5;
    config.host = true;
    peers.push_back(std::make_unique<Peer>(network, SimulatedNetwork::kHost, config));
    config.host = false;
    config.local_players = 0;
    for (int p = 1; p < 4; ++p) {
      const EndpointId id = network.add_client(transport::parse_profile(line).value());
      peers.push_back(std::make_unique<Peer>(network, id, config));
      network.connect(id);
    }
  }
  void pass(Time time) {
    for (const Time end = now + time; now < end; now += 1000) {
      network.advance_to(now);
      for (auto& peer : peers) {
        peer->turn(now);
        if (peer->session.phase() == SessionPhase::lost) network.connect(peer->id);
      }
      if (disturb) disturb();
    }
  }
  /// The host's inputs, played by one process.
  void expect_one_history(Frame frames) {
    Toy straight;
    for (Frame frame = 0; frame < frames; ++frame) {
      straight.step({peers[0]->values.at(frame), peers[0]->statuses.at(frame)});
      for (auto& peer : peers) {
        const auto found = peer->hashes.find(frame);
        ASSERT_TRUE(found == peer->hashes.end() || found->second == straight.hash()) << frame;
      }
    }
    for (auto& peer : peers) {
      EXPECT_FALSE(peer->is_desynced);
      EXPECT_GE(peer->session.confirmed(), frames);
    }
    EXPECT_EQ(network.oversized(), 0u);
  }
  SimulatedNetwork network;
  std::vector<std::unique_ptr<Peer>> peers;
  std::function<void()> disturb;
  Time now = 0;
};

class SealedMatch : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, SealedMatch, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(SealedMatch, OnLossyLinesIsOneHistory) {
  Match match(GetParam(), "latency=80,jitter=30,loss=10,duplication=5");
  match.pass(20 * kSecond);
  match.expect_one_history(900);
  for (auto& peer : match.peers) {
    EXPECT_EQ(peer->line.statistics().forged, 0u);
    EXPECT_GT(peer->line.statistics().replayed, 20u) << "what the line doubled";
  }
}

TEST_P(SealedMatch, GoesOnAfterACutWithKeysOfItsOwn) {
  Match match(GetParam(), "latency=30,jitter=5,loss=1");
  match.pass(5 * kSecond);
  for (int i = 0; i < 3; ++i) {
    match.network.cut(match.peers[2]->id);
    match.pass(4 * kSecond);
    EXPECT_EQ(match.peers[2]->session.phase(), SessionPhase::playing);
  }
  match.expect_one_history(700);
}

TEST_P(SealedMatch, DoesNotNoticeAThousandForgeriesASecond) {
  Match match(GetParam(), "latency=30,jitter=5,loss=1");
  Pcg32 random = Pcg32::seeded(4);
  match.pass(2 * kSecond);
  std::uint64_t refused[4];
  for (std::size_t i = 0; i < 4; ++i) refused[i] = match.peers[i]->session.stats().refused;
  match.disturb = [&] {
    std::vector<std::uint8_t> bytes(random_below(random, 200));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    const auto to = static_cast<EndpointId>(random_below(random, 4));
    const auto from = static_cast<PeerId>(to == 0 ? random_below(random, 3) : 0);
    match.network.inject(to, from, random.next() % 2 == 0 ? Channel::datagram : Channel::reliable, bytes);
  };
  match.pass(13 * kSecond);
  match.expect_one_history(700);
  for (std::size_t i = 0; i < 4; ++i) {
    auto& peer = match.peers[i];
    const sealed::SealStatistics& statistics = peer->line.statistics();
    EXPECT_GT(statistics.forged + statistics.truncated + statistics.replayed, 2000u);
    EXPECT_EQ(statistics.handshakes + statistics.displaced, 0u);
    EXPECT_EQ(peer->session.stats().refused, refused[i]);
    EXPECT_EQ(peer->session.stats().flooded, 0u);
  }
}

}  // namespace sealed_test
}  // namespace isostep::test
