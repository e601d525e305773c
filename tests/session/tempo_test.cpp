// Pauses and speeds: all machines change before the same frame, nobody is blamed, and frames stay frames.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace tempo_test {

using Kind = SessionEvent::Kind;
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr const char* kBadLine = "latency=100,jitter=30,loss=5";

class Tempos : public testing::TestWithParam<std::tuple<SessionMode, const char*>> {
 protected:
  Tempos() : match(config(), std::get<1>(GetParam())) { match.pass(8 * kSecond); }
  static SessionConfig config() { return config_of(4, std::get<0>(GetParam())); }
  static bool is_good() { return std::string_view(std::get<1>(GetParam())) == kGoodLine; }

  Frame at(std::size_t i) { return match.machine(i).session.current(); }
  /// Every machine has heard that once, of the same frame.
  Frame heard_by_all(Kind kind, int times = 1) {
    const Frame frame = match.host().last(kind).frame;
    for (std::size_t i = 0; i < match.size(); ++i) {
      EXPECT_EQ(match.machine(i).count(kind), times) << i;
      EXPECT_EQ(match.machine(i).last(kind).frame, frame) << i;
    }
    return frame;
  }
  /// Nobody was left out, or told to be waited for, since the match was young.
  void expect_no_blame() {
    for (std::size_t i = 0; i < match.size(); ++i) {
      for (const SessionEvent& event : match.machine(i).events) {
        EXPECT_FALSE(event.kind == Kind::left) << i;
        if (is_good()) {
          EXPECT_FALSE(event.kind == Kind::waiting_for && event.frame > 300) << i << " in " << event.frame;
          EXPECT_FALSE(event.kind == Kind::slowed_by) << i;
        }
      }
    }
    expect_one_history(match);
  }
  ToyMatch match;
};
INSTANTIATE_TEST_SUITE_P(Lines, Tempos,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(kGoodLine, kBadLine)));

TEST_P(Tempos, APauseIsOneFrameOnAllMachinesAndAsLongAsTheHostLikes) {
  EXPECT_TRUE(match.host().session.pause());
  const Frame before = at(0);
  match.pass(2 * kSecond);
  const Frame paused = heard_by_all(Kind::paused);
  EXPECT_LE(paused, before + 32) << "half a second";
  for (std::size_t i = 0; i < match.size(); ++i) EXPECT_EQ(at(i), paused);
  match.pass(100 * kSecond);  // longer than patience, silence and reservations
  for (std::size_t i = 0; i < match.size(); ++i) {
    EXPECT_EQ(at(i), paused);
    EXPECT_EQ(match.machine(i).session.phase(), SessionPhase::playing);
  }
  EXPECT_TRUE(match.host().session.unpause());
  match.pass(5 * kSecond);
  EXPECT_EQ(heard_by_all(Kind::unpaused), paused);
  for (std::size_t i = 0; i < match.size(); ++i) EXPECT_GT(at(i), paused + (is_good() ? 285 : 200)) << i;
  match.pass(2 * kSecond);
  expect_no_blame();
}

TEST_P(Tempos, AFrameTakesTwiceOrHalfItsTime) {
  for (const int speed : {Tempo::kSlowest, Tempo::kFastest}) {
    EXPECT_TRUE(match.host().session.set_speed(speed));
    match.pass(2 * kSecond);
    const Frame before = at(0);
    match.pass(4 * kSecond);
    const Frame passed = at(0) - before, wanted = 240 * speed / Tempo::kNormal;
    EXPECT_LE(passed, wanted + 2);
    // In lockstep the way between two players is longer than most_delay at twice the speed.
    const bool waits = speed == Tempo::kFastest && !is_good();
    EXPECT_GE(passed, waits ? wanted / 3 : wanted - 4) << speed;
  }
  EXPECT_TRUE(match.host().session.set_speed(Tempo::kNormal));
  match.pass(4 * kSecond);
  heard_by_all(Kind::speed_changed, 3);
  EXPECT_EQ(match.machine(2).last(Kind::speed_changed).speed, Tempo::kNormal);
  if (is_good()) expect_no_blame();
}

TEST_P(Tempos, WhatIsWishedLastCounts) {
  for (int n = 0; n < 20; ++n) {
    EXPECT_TRUE(n % 2 == 0 ? match.host().session.pause() : match.host().session.unpause());
    match.pass(7000);
  }
  match.host().session.set_speed(12);
  match.host().session.pause();
  match.pass(3 * kSecond);
  for (std::size_t i = 1; i < match.size(); ++i) EXPECT_EQ(at(i), at(0));
  match.host().session.unpause();
  match.pass(4 * kSecond);
  for (std::size_t i = 0; i < match.size(); ++i) EXPECT_EQ(match.machine(i).last(Kind::speed_changed).speed, 12);
  EXPECT_FALSE(match.host().session.set_speed(3));
  EXPECT_FALSE(match.host().session.set_speed(17));
  expect_one_history(match);
}

TEST_P(Tempos, WhoComesInAPauseWaitsWithTheOthers) {
  match.host().session.pause();
  match.pass(kSecond);
  Machine<Toy>& away = match.machine(2);
  away.returns = true;
  match.network().cut(away.endpoint);
  match.pass(3 * kSecond);
  EXPECT_EQ(away.session.current(), at(0));
  match.host().session.unpause();
  match.pass(5 * kSecond);
  EXPECT_EQ(away.session.phase(), SessionPhase::playing);
  for (int p = 0; p < 4; ++p) EXPECT_TRUE(match.host().played(match.host().end() - 1, p)) << p;
  expect_one_history(match);
}

class Asked : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Asked, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Asked, TheHostsGameHearsOfItOrGrantsIt) {
  for (const bool grants : {false, true}) {
    SessionConfig config = config_of(3, GetParam());
    config.players_set_tempo = grants;
    ToyMatch match(config, kGoodLine);
    match.pass(3 * kSecond);
    Machine<Toy>& one = match.machine(2);
    EXPECT_TRUE(one.session.pause());
    match.pass(kSecond);
    EXPECT_TRUE(one.session.set_speed(5));
    EXPECT_FALSE(one.session.set_speed(99));
    match.pass(kSecond);
    EXPECT_TRUE(one.session.unpause());
    match.pass(kSecond);
    const int player = one.session.local_player();
    EXPECT_EQ(match.host().count(Kind::asks_pause, player), grants ? 0 : 1);
    EXPECT_EQ(match.host().count(Kind::asks_speed, player), grants ? 0 : 1);
    EXPECT_EQ(match.host().count(Kind::asks_unpause, player), grants ? 0 : 1);
    for (std::size_t i = 0; i < match.size(); ++i) {
      EXPECT_EQ(match.machine(i).count(Kind::paused, player), grants ? 1 : 0);
      EXPECT_EQ(match.machine(i).count(Kind::unpaused, player), grants ? 1 : 0);
      EXPECT_EQ(match.machine(i).last(Kind::speed_changed, player).speed, grants ? 5 : 0);
    }
    expect_one_history(match);
  }
}

TEST_P(Asked, AFloodOfAsksIsHeardOnceASecond) {
  for (const bool grants : {false, true}) {
    SessionConfig config = config_of(3, GetParam());
    config.players_set_tempo = grants;
    ToyMatch match(config, kGoodLine);
    match.pass(3 * kSecond);
    bool on = false;
    match.run(10 * kSecond, [&] {
      on = !on;
      on ? match.machine(2).session.pause() : match.machine(2).session.unpause();
      if (match.now() % 2000 == 0) match.machine(2).session.set_speed(on ? 5 : 9);
      return false;
    });
    EXPECT_GE(match.host().events.size(), 5u);
    EXPECT_LE(match.host().events.size(), 3u + 1 + 3 * 11) << "joined, started, then of each kind one a second";
    EXPECT_EQ(match.host().session.stats().events_lost, 0u);
  }
}

TEST_P(Asked, AMigrationKeepsThePause) {
  SessionConfig config = config_of(4, GetParam());
  config.migration = kSecond;
  ToyMatch match(config, kGoodLine);
  match.pass(8 * kSecond);
  match.host().session.set_speed(Tempo::kFastest);
  match.pass(kSecond);
  match.host().session.pause();
  match.pass(2 * kSecond);
  match.host().plays = false;
  match.network().set_silent(match.host().endpoint, true);
  match.pass(5 * kSecond);
  std::size_t at = 1;
  while (at + 1 < match.size() && !match.machine(at).session.config().host) ++at;
  Machine<Toy>& host = match.machine(at);
  ASSERT_TRUE(host.session.config().host);
  const Frame paused = host.session.current();
  for (std::size_t i = 1; i < match.size(); ++i) EXPECT_EQ(match.machine(i).session.current(), paused);
  EXPECT_TRUE(host.session.unpause());
  match.pass(3 * kSecond);
  for (std::size_t i = 1; i < match.size(); ++i) {
    EXPECT_GT(match.machine(i).session.current(), paused + 300) << "at the speed of before";
    EXPECT_EQ(match.machine(i).session.phase(), SessionPhase::playing);
    expect_sound_machine(match.machine(i), true);
    EXPECT_EQ(differences(match.machine(i), host, match.straight(host.end(), at)), 0u);
  }
}

}  // namespace tempo_test
}  // namespace isostep::test
