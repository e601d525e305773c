// Strangers who fill the connections: silent ones, spectators, players without a seat, again and again.
// SPDX-License-Identifier: MIT
#include "session/admission_scene.hpp"

namespace isostep::test {
namespace strangers_test {

constexpr Time kBackWithin = 2 * kSecond;

/// Connects whenever it is not, and does one thing.
struct Stranger : hostile::Rogue {
  enum class Way : std::uint8_t { silent, watches, plays, guesses, differs };
  Way way;
  Time stays;  // [us] a connection, by its own will
  Time since = 0;
  int connections = 0;
  bool was_connected = false;

  Stranger(OpenMatch& scene, Way its_way, Time its_stay, const transport::NetworkProfile& line)
      : Rogue(scene.match, line), way(its_way), stays(its_stay) {}
  void turn(const OpenMatch& scene, Time now) {
    listen();
    if (is_connected && !was_connected) {
      since = now;
      ++connections;
      Hello hello = hostile::hello_of(scene.config);
      hello.spectator = way == Way::watches;
      if (way == Way::guesses) hello.token = now * 0x9e3779b97f4a7c15u | 1u;
      if (way == Way::differs) hello.identity.set("scene", "another", true);
      if (way != Way::silent) greet(hello);
    }
    if (is_connected && now - since > stays) {
      port.disconnect(0);
      is_connected = false;
    }
    was_connected = is_connected;
    if (!is_connected) network->connect(id);
  }
};

using Ways = std::vector<Stranger::Way>;

/// Players, and strangers of these ways in turns.
struct CrowdedMatch : FullMatch {
  CrowdedMatch(const SessionConfig& its_config, std::size_t count, const Ways& ways) : FullMatch(its_config) {
    for (std::size_t i = 0; i < count; ++i) {
      // Some stay until they are sent away, others come and go ten times a second.
      const Time stays = i % 3 == 0 ? kSecond / 10 : 100 * kSecond;
      const transport::NetworkProfile line = profile(i % 2 == 0 ? "lan" : kLine);
      strangers.push_back(std::make_unique<Stranger>(*this, ways[i % ways.size()], stays, line));
    }
  }
  template <class Done> bool run(Time limit, Done&& done) {
    return match.run(limit, [&] {
      for (auto& stranger : strangers) stranger->turn(*this, match.now());
      return done();
    });
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  std::vector<std::unique_ptr<Stranger>> strangers;
};

class Strangers : public testing::TestWithParam<SessionMode> {
 protected:
  SessionConfig config_of(int players) const {
    SessionConfig config = players_of(players);
    config.mode = GetParam();
    return config;
  }
};
INSTANTIATE_TEST_SUITE_P(Modes, Strangers, testing::Values(SessionMode::lockstep, SessionMode::rollback));

/// [us] The time from the moment at which its line is there again to its first frame.
Time time_to_come_back(CrowdedMatch& scene, bool as_another_process) {
  Player& owner = scene.player(2);
  scene.drop(owner);
  scene.pass(kSecond);
  EXPECT_FALSE(scene.host().peer_of(2).has_value());
  Player* back = &owner;
  if (as_another_process) {
    owner.plays = false;
    back = &scene.come(scene.with_token(owner.session.token()));
  } else {
    owner.returns = true;
  }
  const Time from = scene.match.now();
  EXPECT_TRUE(scene.run(10 * kSecond, [&] { return back->session.phase() == SessionPhase::playing; }));
  EXPECT_EQ(back->session.local_player(), 2);
  return scene.match.now() - from;
}

TEST_P(Strangers, FortyOfThemKeepNoOwnerOutOfItsSeat) {
  using enum Stranger::Way;
  Time worst = 0;
  for (const Ways& ways : {Ways{silent}, Ways{watches}, Ways{silent, watches, plays, guesses}}) {
    for (const int offset : {0, 170000, 340000, 510000}) {  // [us] when in the strangers' rounds the line drops
      SCOPED_TRACE(std::to_string(ways.size()) + " ways, " + std::to_string(offset));
      CrowdedMatch scene(config_of(3), 40, ways);
      scene.pass(3 * kSecond + static_cast<Time>(offset));
      worst = std::max(worst, time_to_come_back(scene, offset % 340000 != 0));
      scene.pass(2 * kSecond);
      EXPECT_EQ(scene.player(1).session.phase(), SessionPhase::playing);
      EXPECT_FALSE(scene.match.host().heard(Kind::waiting_for)) << "nobody else notices";
      EXPECT_EQ(scene.host().stats().events_lost, 0u);
      int connections = 0;
      for (const auto& stranger : scene.strangers) connections += stranger->connections;
      EXPECT_GT(connections, 200) << "they come again and again";
    }
  }
  std::printf("the slowest owner was back after %d ms\n", static_cast<int>(worst / 1000));
  EXPECT_LE(worst, kBackWithin);
}

TEST_P(Strangers, WhoDoNotGreetAreSentAwayAfterTwoSeconds) {
  FullMatch scene(config_of(2));
  Stranger silent(scene, Stranger::Way::silent, 100 * kSecond, profile("loopback"));
  scene.match.run(kSecond, [&] { return silent.listen(), silent.is_connected; });
  const Time from = scene.match.now();
  const std::uint64_t before = scene.host().stats().refused;
  EXPECT_TRUE(scene.match.run(4 * kSecond, [&] { return silent.listen(), !silent.is_connected; }));
  EXPECT_GE(scene.match.now() - from, 2 * kSecond - 10000);
  EXPECT_LE(scene.match.now() - from, 2 * kSecond + 100000);
  EXPECT_EQ(scene.host().stats().refused, before + 1);
}

TEST_P(Strangers, AsSpectatorsLeaveThePlacesOfPlayers) {
  SessionConfig config = config_of(4);
  config.max_peers = 8;
  OpenMatch scene(config);
  Player& first = scene.come();
  scene.pass(kSecond);
  scene.host().start(scene.match.now());
  ASSERT_TRUE(scene.plays(first, 2 * kSecond));
  std::vector<Player*> watchers;
  for (int i = 0; i < 8; ++i) {
    watchers.push_back(&scene.come(scene.as_spectator()));
    scene.pass(kSecond / 2);
  }
  int watching = 0;
  for (const Player* watcher : watchers) {
    watching += watcher->session.phase() == SessionPhase::watching ? 1 : 0;
    if (!watcher->heard(Kind::refused)) continue;
    EXPECT_EQ(watcher->last(Kind::refused).field.key.view(), "spectators");
  }
  EXPECT_EQ(watching, 8 - 3);
  for (int p = 2; p < 4; ++p) EXPECT_TRUE(scene.plays(scene.come(), 3 * kSecond)) << p;
  // Who leaves makes room.
  scene.drop(*watchers[0]);
  scene.pass(kSecond);
  Player& next = scene.come(scene.as_spectator());
  EXPECT_TRUE(scene.match.run(2 * kSecond, [&] { return next.session.phase() == SessionPhase::watching; }));
}

// The host counts each refusal; it reports 32 at once, then one a second.
TEST_P(Strangers, OfAnotherVersionDoNotFloodTheGameWithEvents) {
  CrowdedMatch scene(config_of(2), 12, {Stranger::Way::differs});
  scene.pass(20 * kSecond);
  const std::uint64_t refused = scene.host().stats().refused;
  EXPECT_GT(refused, 200u);
  int told = 0;
  for (const SessionEvent& event : scene.match.host().events) told += event.kind == Kind::refused ? 1 : 0;
  EXPECT_GE(told, 20);
  EXPECT_LE(told, 32 + 21);
  EXPECT_EQ(scene.host().stats().events_lost, 0u);
}

TEST_P(Strangers, BeyondThePlacesOfASessionAreCountedAndNotServed) {
  SessionConfig config = config_of(2);
  config.host = true;
  config.seed = 1;
  config.max_peers = 4;
  config.max_strangers = 2;
  Session<hostile::Game> host(config);
  host.connected(6, 0);
  EXPECT_EQ(host.stats().refused, 1u);
  host.receive(6, Channel::reliable, {}, 0);
  EXPECT_EQ(host.stats().refused, 2u);
  host.connected(5, 0);
  EXPECT_EQ(host.stats().refused, 2u);
}

}  // namespace strangers_test
}  // namespace isostep::test
