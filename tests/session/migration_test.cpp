// The host is gone, and the match goes on at one of its clients.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "session/match_checks.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace migration_test {

using Kind = SessionEvent::Kind;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

SessionConfig migrating(int players, SessionMode mode) {
  SessionConfig config = config_of(players, mode);
  config.migration = kSecond;
  return config;
}
/// The process is gone: nothing is sent, nothing is read.
void kill(ToyMatch& match, std::size_t machine) {
  match.machine(machine).plays = false;
  match.network().set_silent(match.machine(machine).endpoint, true);
}
/// Machines that follow `host` confirmed what one process computes from the inputs that it confirmed.
void expect_history_of(ToyMatch& match, std::size_t host, std::size_t machine) {
  SCOPED_TRACE("machine " + std::to_string(machine));
  Machine<Toy>& its = match.machine(machine);
  EXPECT_EQ(differences(its, match.machine(host), match.straight(match.machine(host).end(), host)), 0u);
  expect_sound_machine(its, true);
}

/// The machine that is the host now.
std::size_t host_of(ToyMatch& match) {
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (match.machine(i).plays && match.machine(i).session.config().host) return i;
  }
  return match.size();
}

class Migration : public testing::TestWithParam<std::tuple<int, SessionMode>> {
 protected:
  Migration() : match(migrating(players(), std::get<1>(GetParam())), kGoodLine) {}
  static int players() { return std::get<0>(GetParam()); }
  /// All that play confirm so many frames more than any has now.
  bool go_on(Frame frames, Time limit) {
    Frame newest = 0;
    for (std::size_t i = 0; i < match.size(); ++i) newest = std::max(newest, match.machine(i).end());
    return match.run_to(newest + frames, limit);
  }
  ToyMatch match;
};
INSTANTIATE_TEST_SUITE_P(Matches, Migration,
                         testing::Combine(testing::Values(4, 8),
                                          testing::Values(SessionMode::lockstep, SessionMode::rollback)));

TEST_P(Migration, WhatWasToldBeforeIsNotToldAgain) {
  match.pass(8 * kSecond);
  for (int deaths = 1; deaths <= 2; ++deaths) {
    kill(match, host_of(match));
    ASSERT_TRUE(go_on(300, 20 * kSecond));
    for (std::size_t i = 0; i < match.size(); ++i) {
      if (!match.machine(i).plays) continue;
      SCOPED_TRACE("machine " + std::to_string(i));
      EXPECT_EQ(match.machine(i).count(Kind::started), 1);
      for (int p = 0; p < players(); ++p) {
        EXPECT_EQ(match.machine(i).count(Kind::joined, p), 1) << p;
        EXPECT_LE(match.machine(i).count(Kind::left, p), 1) << p;
      }
    }
    if (players() < 8) break;  // of three two are a majority, of two one is not
  }
}

TEST_P(Migration, PlayGoesOnWithinThreeSecondsOfTheHostsDeath) {
  match.pass(8 * kSecond);
  std::vector<int> seats;
  for (std::size_t i = 0; i < match.size(); ++i) seats.push_back(match.machine(i).seat);
  kill(match, 0);
  EXPECT_TRUE(go_on(30, 3 * kSecond));
  match.pass(5 * kSecond);
  const std::size_t host = host_of(match);
  ASSERT_LT(host, match.size());
  for (std::size_t i = 1; i < match.size(); ++i) {
    EXPECT_EQ(match.machine(i).session.phase(), SessionPhase::playing) << i;
    EXPECT_EQ(match.machine(i).session.local_player(), seats[i]);
    EXPECT_EQ(match.machine(i).count(Kind::new_host), 1);
    EXPECT_EQ(match.machine(i).restarts, 0);
    expect_history_of(match, host, i);
  }
}

TEST_P(Migration, TwiceInARow) {
  match.pass(8 * kSecond);
  kill(match, 0);
  ASSERT_TRUE(go_on(30, 3 * kSecond));
  match.pass(kSecond);
  const std::size_t first = host_of(match);
  ASSERT_LT(first, match.size());
  kill(match, first);
  EXPECT_TRUE(go_on(30, 3 * kSecond));
  match.pass(5 * kSecond);
  const std::size_t second = host_of(match);
  ASSERT_LT(second, match.size());
  EXPECT_NE(first, second);
  for (std::size_t i = 1; i < match.size(); ++i) {
    if (!match.machine(i).plays) continue;
    EXPECT_EQ(match.machine(i).session.phase(), SessionPhase::playing) << i;
    EXPECT_EQ(match.machine(i).restarts, 0);
    expect_history_of(match, second, i);
  }
}

TEST_P(Migration, OfALineInTwoHalvesExactlyOneGoesOn) {
  // The half with the host, and with one machine less the other.
  for (const std::size_t with_host : {match.size() / 2, match.size() / 2 - 1}) {
    ToyMatch split(migrating(players(), std::get<1>(GetParam())), kGoodLine);
    split.pass(8 * kSecond);
    for (std::size_t i = with_host; i < split.size(); ++i) split.network().set_side(split.machine(i).endpoint, 1);
    split.pass(12 * kSecond);
    const Frame ends[2] = {split.machine(0).session.current(), split.machine(split.size() - 1).session.current()};
    split.pass(5 * kSecond);
    const bool goes_on[2] = {split.machine(0).session.current() > ends[0] + 60,
                             split.machine(split.size() - 1).session.current() > ends[1] + 60};
    EXPECT_EQ(goes_on[0], with_host == split.size() / 2) << with_host;
    EXPECT_EQ(goes_on[1], with_host != split.size() / 2) << with_host;
  }
}

TEST_P(Migration, AHostThatStoodStillComesBackAsAPlayer) {
  match.pass(8 * kSecond);
  const int seat = match.machine(0).seat;
  match.machine(0).plays = false;
  ASSERT_TRUE(go_on(30, 3 * kSecond));
  match.pass(2 * kSecond);
  match.machine(0).plays = true;
  match.pass(12 * kSecond);
  const std::size_t host = host_of(match);
  ASSERT_LT(host, match.size());
  EXPECT_NE(host, 0u);
  EXPECT_EQ(match.machine(0).count(Kind::deposed), 1);
  EXPECT_EQ(match.machine(0).session.phase(), SessionPhase::playing);
  EXPECT_EQ(match.machine(0).session.local_player(), seat);
  for (std::size_t i = 1; i < match.size(); ++i) expect_history_of(match, host, i);
}

TEST_P(Migration, WhoAloneLosesTheHostIsSentBackToIt) {
  match.pass(8 * kSecond);
  Machine<Toy>& alone = match.machine(2);
  match.network().set_silent(alone.endpoint, true);
  match.pass(1300 * kMs);
  match.network().set_silent(alone.endpoint, false);
  match.pass(10 * kSecond);
  EXPECT_EQ(host_of(match), 0u);
  EXPECT_EQ(alone.count(Kind::seeks_host), 1);
  EXPECT_EQ(alone.session.phase(), SessionPhase::playing);
  for (std::size_t i = 1; i < match.size(); ++i) expect_history_of(match, 0, i);
}

/// To connect takes as long as to call and be supported: who is elected may have greeted another meanwhile, and counts
/// there as one that seeks a host for as long as that connection is open.
TEST(LateGreeting, OfWhoIsElectedEnds) {
  const auto lose_host = [](ToyMatch& match) {
    match.pass(2 * kSecond);
    kill(match, 0);
  };
  const auto elect = [](ToyMatch& match) { return match.run(5 * kSecond, [&] { return host_of(match) == 1; }); };
  const SessionConfig config = migrating(3, SessionMode::lockstep);
  ToyMatch undisturbed(config, "latency=30");
  lose_host(undisturbed);
  ASSERT_TRUE(elect(undisturbed));
  // It called 60 ms before: the connection comes since then, and in time for a greeting.
  for (Time before = 115 * kMs; before >= 65 * kMs; before -= 5 * kMs) {
    SCOPED_TRACE(std::to_string(before) + " us before it is elected");
    ToyMatch match(config, "latency=30");
    lose_host(match);
    match.pass(undisturbed.now() - before - match.now());
    const auto connect = [&] { return match.network().connect(match.machine(1).endpoint, match.machine(2).endpoint); };
    ASSERT_TRUE(connect());
    ASSERT_TRUE(elect(match));
    match.pass(kSecond / 2);
    EXPECT_TRUE(connect()) << "the one before is not over";
  }
}

}  // namespace migration_test
}  // namespace isostep::test
