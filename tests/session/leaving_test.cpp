// Players who go: the others go on, from one frame on all peers, and who comes back gets its seat.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace leaving_test {

using Kind = SessionEvent::Kind;

struct Match : VirtualMatch<Toy> {
  Match(const SessionConfig& config, std::string_view line)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); },
            [](int player, Frame frame) { return toy_input(11, player, frame); }) {
    for (int p = 1; p < config.players; ++p) add(profile(line)).returns = true;
  }
};
void kill(Match& match, std::size_t i) {
  match.network().set_silent(match.machine(i).endpoint, true);
  match.machine(i).plays = false;
}
void revive(Match& match, std::size_t i) {
  match.network().set_silent(match.machine(i).endpoint, false);
  match.machine(i).plays = true;
}
void pass(Match& match, Time time) {
  match.run(time, [] { return false; });
}
/// The longest time that the host spent on one frame.
struct LongestWait {
  LongestWait(Match& its_match) : match(its_match) {
    match.host().after_turn = [this] {
      if (match.host().session.current() != frame) {
        frame = match.host().session.current();
        since = match.now();
      }
      if (match.now() - since > longest) longest = match.now() - since;
    };
  }
  ~LongestWait() { match.host().after_turn = nullptr; }
  Match& match;
  Frame frame = kNoFrame;
  Time since = 0, longest = 0;
};
/// `left` and `joined` of a player were told alike by every machine of `others`.
void expect_told_alike(Match& match, Kind kind, int player, std::initializer_list<std::size_t> others) {
  const SessionEvent hosts = match.host().last(kind, player);
  EXPECT_NE(hosts.frame, kNoFrame);
  for (const std::size_t i : others) {
    EXPECT_EQ(match.machine(i).last(kind, player).frame, hosts.frame) << "client " << i;
  }
}

class Leaving : public testing::TestWithParam<SessionMode> {
 protected:
  SessionConfig config_of(int players) const {
    SessionConfig config;
    config.mode = GetParam();
    config.players = players;
    return config;
  }
};
INSTANTIATE_TEST_SUITE_P(Modes, Leaving, testing::Values(SessionMode::lockstep, SessionMode::rollback),
                         [](const auto& mode) {
                           return mode.param == SessionMode::lockstep ? "Lockstep" : "Rollback";
                         });

TEST_P(Leaving, AKilledClientHoldsTheOthersUpUntilItIsSilentForTooLong) {
  for (const int players : {2, 3, 8}) {
    SCOPED_TRACE(players);
    Match match(config_of(players), "wifi");
    ASSERT_TRUE(match.run_to(300, 60 * kSecond));
    const std::size_t last = match.size() - 1;
    const int victim = match.machine(last).seat;
    LongestWait wait(match);
    kill(match, last);
    ASSERT_TRUE(match.run_to(1200, 60 * kSecond));
    const Time silence = match.host().session.config().silence;
    // What was under way, the window and the delay come before the wait.
    EXPECT_GE(wait.longest, silence - kSecond / 2);
    EXPECT_LE(wait.longest, silence + kSecond / 10);
    EXPECT_TRUE(match.host().heard(Kind::waiting_for));
    EXPECT_EQ(match.host().last(Kind::waiting_for).players, 1u << victim);
    EXPECT_TRUE(match.host().heard(Kind::resumed));
    const Frame gone = match.host().last(Kind::left, victim).frame;
    ASSERT_GT(gone, 290);
    for (Frame frame = 0; frame < match.host().end(); ++frame) {
      ASSERT_EQ(match.host().played(frame, victim), frame < gone) << frame;
    }
    for (std::size_t i = 1; i < last; ++i) expect_told_alike(match, Kind::left, victim, {i});
    expect_one_history(match);
  }
}

TEST_P(Leaving, AConnectionThatEndsIsNotWaitedFor) {
  Match match(config_of(3), "lan");
  match.machine(2).returns = false;
  ASSERT_TRUE(match.run_to(300, 60 * kSecond));
  LongestWait wait(match);
  match.network().cut(match.machine(2).endpoint);
  match.machine(2).turn(match.now(), [](int, Frame) { return ToyInput{}; });
  match.machine(2).plays = false;
  ASSERT_TRUE(match.run_to(600, 60 * kSecond));
  EXPECT_LE(wait.longest, kSecond / 10);
  EXPECT_EQ(match.machine(2).session.phase(), SessionPhase::lost);
  expect_told_alike(match, Kind::left, 2, {1});
  expect_one_history(match);
}

TEST_P(Leaving, WhoComesBackGetsItsOwnSeatByInputsAlone) {
  Match match(config_of(4), "wifi");
  ASSERT_TRUE(match.run_to(300, 60 * kSecond));
  int seats[4];
  for (std::size_t i = 1; i < 4; ++i) seats[i] = match.machine(i).seat;
  kill(match, 1);
  kill(match, 2);
  pass(match, 8 * kSecond);
  ASSERT_TRUE(match.host().heard(Kind::left, seats[1]));
  ASSERT_TRUE(match.host().heard(Kind::left, seats[2]));
  revive(match, 2);  // the other way round
  pass(match, 2 * kSecond);
  revive(match, 1);
  ASSERT_TRUE(match.run_to(match.host().end() + 600, 60 * kSecond));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(match.machine(i).seat, seats[i]);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_TRUE(match.machine(i).heard(Kind::lost_host));
    EXPECT_EQ(match.machine(i).restarts, 0);
    EXPECT_EQ(match.host().count(Kind::joined, seats[i]), 2);
    EXPECT_EQ(match.machine(i).first, 0) << "its history goes on where it ended";
    EXPECT_TRUE(match.host().played(match.host().end() - 1, seats[i]));
    expect_told_alike(match, Kind::joined, seats[i], {1, 2, 3});
  }
  EXPECT_LT(match.host().last(Kind::joined, seats[2]).frame, match.host().last(Kind::joined, seats[1]).frame);
  expect_one_history(match);
}

TEST_P(Leaving, WhoWasAwayForLongerThanTheHistoryComesBackByASnapshot) {
  SessionConfig config = config_of(3);
  config.history = 300;
  Match match(config, "wifi");
  ASSERT_TRUE(match.run_to(300, 60 * kSecond));
  const int seat = match.machine(2).seat;
  kill(match, 2);
  pass(match, 20 * kSecond);
  revive(match, 2);
  ASSERT_TRUE(match.run_to(match.host().end() + 600, 60 * kSecond));
  EXPECT_EQ(match.machine(2).restarts, 1);
  EXPECT_GT(match.machine(2).first, 900);
  EXPECT_EQ(match.machine(2).seat, seat);
  EXPECT_EQ(match.host().count(Kind::joined, seat), 2);
  expect_one_history(match);
}

TEST_P(Leaving, WhoseUplinkAloneIsDeadIsLeftOutAndComesBack) {
  Match match(config_of(3), "wifi");
  match.network().set_profile(match.machine(2).endpoint, profile("blackout-up"));  // from 5 s to 35 s
  ASSERT_TRUE(match.run_to(60, 60 * kSecond));
  const int seat = match.machine(2).seat;
  LongestWait wait(match);
  ASSERT_TRUE(match.run_to(3600, 120 * kSecond));
  EXPECT_LE(wait.longest, match.host().session.config().patience + kSecond / 10);
  EXPECT_TRUE(match.machine(2).heard(Kind::lost_host));
  EXPECT_EQ(match.host().count(Kind::joined, seat), 2);
  EXPECT_TRUE(match.host().played(3599, seat));
  expect_told_alike(match, Kind::joined, seat, {1, 2});
  expect_one_history(match);
}

// The connection holds: the client sees that it was left out, and asks to be let in again.
TEST_P(Leaving, WhoIsLeftOutOfALivingConnectionJoinsAgainWithoutANewOne) {
  SessionConfig config = config_of(3);
  config.patience = config.exclusion = kSecond;
  config.silence = 10 * kSecond;
  Match match(config, "wifi");
  match.network().set_profile(match.machine(2).endpoint,
                              profile("latency=50,jitter=20,up.blackout-start=8000,up.blackout=4000"));
  SessionPhase phase_while_out = SessionPhase::playing;
  match.machine(2).after_turn = [&] {
    if (match.now() == 11 * kSecond) phase_while_out = match.machine(2).session.phase();
  };
  ASSERT_TRUE(match.run_to(60, 60 * kSecond));
  const int seat = match.machine(2).seat;
  LongestWait wait(match);
  ASSERT_TRUE(match.run_to(1800, 60 * kSecond));
  EXPECT_GE(wait.longest, config.patience);
  EXPECT_LE(wait.longest, config.patience + kSecond / 10);
  EXPECT_EQ(phase_while_out, SessionPhase::watching);
  EXPECT_FALSE(match.machine(2).heard(Kind::lost_host));
  EXPECT_EQ(match.machine(2).session.phase(), SessionPhase::playing);
  EXPECT_EQ(match.host().count(Kind::joined, seat), 2);
  EXPECT_EQ(match.machine(2).restarts, 0);
  expect_told_alike(match, Kind::left, seat, {1, 2});
  expect_told_alike(match, Kind::joined, seat, {1, 2});
  expect_one_history(match);
}

TEST_P(Leaving, TwentyTimesInARowLeavesOneHistory) {
  Match match(config_of(4), "mobile");
  ASSERT_TRUE(match.run_to(120, 60 * kSecond));
  Pcg32 random = Pcg32::seeded(5);
  for (int i = 0; i < 20; ++i) {
    match.network().cut(match.machine(1 + random.next() % 3).endpoint);
    pass(match, (200 + random.next() % 3000) * 1000);
  }
  ASSERT_TRUE(match.run_to(match.host().end() + 600, 60 * kSecond));
  int returns = 0;
  for (int p = 1; p < 4; ++p) {
    returns += match.host().count(Kind::joined, p) - 1;
    EXPECT_TRUE(match.host().played(match.host().end() - 1, p));
  }
  EXPECT_GE(returns, 10);
  expect_one_history(match);
}

TEST_P(Leaving, AMatchWhoseSeatsAreAllTakenRefusesByThatName) {
  Match match(config_of(2), "lan");
  ASSERT_TRUE(match.run_to(100, 60 * kSecond));
  Machine<Toy>& third = match.add(profile("lan"));
  third.keeps = false;
  match.run(5 * kSecond, [&] { return third.heard(Kind::refused); });
  EXPECT_EQ(third.last(Kind::refused).field.key.view(), "seats");
  EXPECT_EQ(third.session.phase(), SessionPhase::refused);
  EXPECT_EQ(match.host().last(Kind::refused).field.key.view(), "seats");
  pass(match, 5 * kSecond);
  EXPECT_GT(match.machine(1).end(), 300);
  EXPECT_EQ(differences(match.machine(1), match.host(), match.straight(match.host().end())), 0u);
}

TEST_P(Leaving, AnAwayPlayersSeatGoesToANewcomerAfterItsReservationAndIsThenTaken) {
  SessionConfig config = config_of(2);
  config.reservation = 2 * kSecond;
  Match match(config, "lan");
  ASSERT_TRUE(match.run_to(100, 60 * kSecond));
  kill(match, 1);
  pass(match, 8 * kSecond);  // the patience, and then the reservation
  match.add(profile("lan"));
  ASSERT_TRUE(match.run_to(match.host().end() + 120, 60 * kSecond));
  EXPECT_EQ(match.machine(2).seat, 1);
  EXPECT_TRUE(match.host().played(match.host().end() - 1, 1));
  revive(match, 1);
  ASSERT_TRUE(match.run(10 * kSecond, [&] { return match.machine(1).heard(Kind::refused); }));
  EXPECT_EQ(match.machine(1).last(Kind::refused).field.key.view(), "seats");
  expect_one_history(match);
}

TEST_P(Leaving, ALostHostIsToldAfterTheSilenceAndAllReturnWhenItWasOnlyAway) {
  Match match(config_of(3), "wifi");
  ASSERT_TRUE(match.run_to(300, 60 * kSecond));
  const Time away = match.now();
  match.host().plays = false;  // a process that is stopped: its transport is silent too
  for (std::size_t i = 1; i < 3; ++i) match.network().set_silent(match.machine(i).endpoint, true);
  ASSERT_TRUE(match.run(60 * kSecond, [&] {
    return match.machine(1).heard(Kind::lost_host) && match.machine(2).heard(Kind::lost_host);
  }));
  const Time silence = match.host().session.config().silence;
  EXPECT_GE(match.now() - away, silence - kSecond / 10);
  EXPECT_LE(match.now() - away, silence + kSecond / 2);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LE(match.machine(i).session.current(), 300 + 60) << "nobody plays on alone";
  }
  pass(match, 5 * kSecond);
  for (std::size_t i = 1; i < 3; ++i) match.network().set_silent(match.machine(i).endpoint, false);
  match.host().plays = true;
  ASSERT_TRUE(match.run_to(match.host().end() + 600, 60 * kSecond));
  for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ(match.machine(i).restarts, 0) << "though ahead of the host";
  for (int p = 1; p < 3; ++p) EXPECT_TRUE(match.host().played(match.host().end() - 1, p));
  expect_one_history(match);
}

}  // namespace leaving_test
}  // namespace isostep::test
