// A machine that cannot keep up: all go evenly at its pace and are told whose it is; below two thirds it watches.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace slow_test {

using Kind = SessionEvent::Kind;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr std::size_t kMachines = 4;

std::string rate_of(const testing::TestParamInfo<std::tuple<SessionMode, std::size_t, int>>& info) {
  const auto [mode, who, rate] = info.param;
  return std::string(mode == SessionMode::lockstep ? "Lockstep" : "Rollback") + (who == 0 ? "Host" : "Client") +
         std::to_string(rate);
}

/// Machine `who` of a match that has settled steps `rate` frames a second from now on; the others 60.
struct SlowMatch : ToyMatch {
  SlowMatch(SessionMode mode, std::size_t its_who, int rate, std::uint64_t seed)
      : ToyMatch(config_of(kMachines, mode), kGoodLine, seed), who(its_who) {
    pass(10 * kSecond);
    machine(who).step_time = kSecond / static_cast<Time>(rate);
    began = now();
  }
  int player() { return machine(who).session.local_player(); }
  /// Every machine was told that we all go at the pace of that player, and nothing else of that kind.
  void expect_told_once(Kind kind, int whose) {
    for (std::size_t i = 0; i < kMachines; ++i) {
      EXPECT_EQ(machine(i).count(kind), 1) << i;
      EXPECT_EQ(machine(i).count(kind, whose), 1) << i;
    }
  }
  std::size_t who;
  Time began;
};

class Slow : public testing::TestWithParam<std::tuple<SessionMode, std::size_t, int>> {};
INSTANTIATE_TEST_SUITE_P(Rates, Slow,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(std::size_t{0}, std::size_t{1}), testing::Values(59, 55, 45)),
                         rate_of);

TEST_P(Slow, IsFollowedEvenlyAndToldWithinASecond) {
  const auto [mode, who, rate] = GetParam();
  const Time own = kSecond / static_cast<Time>(rate);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SlowMatch match(mode, who, rate, seed);
    PaceWatch<Toy> first(match);
    first.watch(kSecond);
    match.expect_told_once(Kind::slowed_by, match.player());
    PaceWatch<Toy> watch(match);
    watch.watch(109 * kSecond);
    for (std::size_t i = 0; i < kMachines; ++i) {
      // Until all are told, one lost datagram of who is late already may hold another machine up for longer.
      EXPECT_LE(first[i].gaps(50 * kMs), rate == 45 ? 1u : 0u) << i << ": " << first[i].worst();
      EXPECT_LE(first[i].worst(), 70 * kMs) << i;
      EXPECT_EQ(watch[i].gaps(50 * kMs), 0u) << i << ": " << watch[i].worst();
      EXPECT_LE(watch[i].percentile(99) * 2, own * 3) << i;
      EXPECT_GE(watch.hundred_seconds(i), 98 * rate) << i;
      EXPECT_LE(match.machine(i).session.stats().delay, 8) << i;
    }
    match.expect_told_once(Kind::slowed_by, match.player());
    EXPECT_FALSE(match.host().heard(Kind::left));
    expect_one_history(match);
  }
}

TEST_P(Slow, IsOverWhenTheMachineIsFastAgain) {
  const auto [mode, who, rate] = GetParam();
  SlowMatch match(mode, who, rate, 1);
  match.pass(20 * kSecond);
  match.machine(who).step_time = 0;
  match.pass(10 * kSecond);
  match.expect_told_once(Kind::full_speed, 0xff);
  PaceWatch<Toy> watch(match);
  watch.watch(10 * kSecond);
  for (std::size_t i = 0; i < kMachines; ++i) EXPECT_GE(watch.hundred_seconds(i), 5990) << i;
  expect_one_history(match);
}

class TooSlow : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, TooSlow, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(TooSlow, AClientWatchesAndPlaysAgainWhenItIsFastEnough) {
  SlowMatch match(GetParam(), 1, 35, 1);
  const int player = match.player();
  match.pass(5 * kSecond);
  EXPECT_EQ(match.machine(1).session.phase(), SessionPhase::watching);
  EXPECT_EQ(match.host().count(Kind::left, player), 1);
  PaceWatch<Toy> watch(match);
  watch.watch(20 * kSecond);
  for (const std::size_t i : {0, 2, 3}) {
    EXPECT_GE(watch.hundred_seconds(i), 5990) << "the others play at full speed";
    EXPECT_EQ(watch[i].gaps(50 * kMs), 0u);
  }
  EXPECT_EQ(match.host().count(Kind::joined, player), 1) << "it does not come and go";
  match.machine(1).step_time = 0;
  match.pass(5 * kSecond);
  EXPECT_EQ(match.machine(1).session.phase(), SessionPhase::playing);
  EXPECT_EQ(match.host().count(Kind::joined, player), 2);
  EXPECT_EQ(match.machine(1).session.local_player(), player);
  expect_one_history(match);
}

TEST_P(TooSlow, AHostIsFollowedAllTheSameForThereIsNoMatchWithoutIt) {
  SlowMatch match(GetParam(), 0, 35, 1);
  match.pass(kSecond);
  PaceWatch<Toy> watch(match);
  watch.watch(20 * kSecond);
  for (std::size_t i = 0; i < kMachines; ++i) {
    EXPECT_LE(watch[i].percentile(99) * 2, 3 * kSecond / 35) << i;
    EXPECT_GE(watch.hundred_seconds(i), 3450) << i;
  }
  match.expect_told_once(Kind::slowed_by, 0);
  expect_one_history(match);
}

TEST_P(TooSlow, OfTwoThatAreAsSlowOneIsNamed) {
  SlowMatch match(GetParam(), 1, 45, 1);
  match.machine(2).step_time = match.machine(1).step_time;
  match.pass(60 * kSecond);
  for (std::size_t i = 0; i < kMachines; ++i) {
    EXPECT_GE(match.machine(i).count(Kind::slowed_by), 1) << i;
    EXPECT_LE(match.machine(i).count(Kind::slowed_by), 2) << i;
    EXPECT_FALSE(match.machine(i).heard(Kind::full_speed)) << i;
  }
  expect_one_history(match);
}

TEST_P(TooSlow, ALoopThatComesRoundSlowlyAndStepsQuicklyIsNotSlow) {
  for (const Time turn : {Time{16900}, Time{20000}, Time{33000}}) {
    SCOPED_TRACE(turn);
    ToyMatch match(config_of(kMachines, GetParam()), kGoodLine);
    match.machine(1).slow = turn;
    match.pass(5 * kSecond);
    PaceWatch<Toy> watch(match);
    watch.watch(30 * kSecond);
    for (std::size_t i = 0; i < kMachines; ++i) {
      EXPECT_FALSE(match.machine(i).heard(Kind::slowed_by)) << i;
      EXPECT_GE(watch.hundred_seconds(i), 5990) << i;
    }
    expect_one_history(match);
  }
}

TEST_P(TooSlow, NobodyIsSoForABadLine) {
  for (const char* line : {"mobile", "severe", "burst", "asymmetric"}) {
    ToyMatch match(config_of(kMachines, GetParam()), line);
    match.pass(60 * kSecond);
    for (std::size_t i = 0; i < kMachines; ++i) EXPECT_FALSE(match.machine(i).heard(Kind::slowed_by)) << line << i;
  }
}

}  // namespace slow_test
}  // namespace isostep::test
