// Sixteen and thirty-two players: all of them play, in datagrams that every path takes, and go on without their host.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace crowd_test {

using Kind = SessionEvent::Kind;
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

struct CrowdMatch : VirtualMatch<Toy> {
  /// As many players on every machine.
  CrowdMatch(const SessionConfig& config, int machines)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); },
            [](int player, Frame frame) { return toy_input(7, player, frame); }) {
    for (int i = 1; i < machines; ++i) add(profile(kGoodLine), config).returns = true;
  }
  void expect_all_play(std::size_t from = 0) {
    for (std::size_t i = from; i < size(); ++i) {
      const Machine<Toy>& its = machine(i);
      EXPECT_EQ(its.session.phase(), SessionPhase::playing) << i;
      for (int p = 0; p < its.session.config().players; ++p)
        ASSERT_TRUE(its.played(its.end() - 1, p)) << p << " at " << i;
    }
  }
};

class Crowd : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Crowd, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Crowd, OfSixteenMachinesPlays) {
  CrowdMatch match(config_of(16, GetParam()), 16);
  EXPECT_TRUE(match.run_to(480, 12 * kSecond));
  match.expect_all_play();
  expect_one_history(match);
  EXPECT_EQ(match.host().count(Kind::left), 0);
}

TEST_P(Crowd, OfThirtyTwoPlayersOnSixteenMachinesPlays) {
  SessionConfig config = config_of(32, GetParam());
  config.local_players = 2;
  CrowdMatch match(config, 16);
  EXPECT_TRUE(match.run_to(300, 10 * kSecond));
  match.expect_all_play();
  expect_one_history(match);
}

TEST_P(Crowd, OfSixteenGoesOnWithoutItsHost) {
  SessionConfig config = config_of(16, GetParam());
  config.migration = kSecond;
  CrowdMatch match(config, 16);
  EXPECT_TRUE(match.run_to(300, 10 * kSecond));
  match.host().plays = false;
  match.network().set_silent(match.host().endpoint, true);
  EXPECT_TRUE(match.run_to(420, 5 * kSecond));
  for (std::size_t i = 1; i < match.size(); ++i) {
    const Machine<Toy>& machine = match.machine(i);
    EXPECT_EQ(machine.session.phase(), SessionPhase::playing) << i;
    expect_sound_machine(machine, true);
    for (int p = 1; p < 16; ++p) ASSERT_TRUE(machine.played(machine.end() - 1, p)) << p << " at " << i;
  }
}

TEST(Crowd32, OnAMachineEachPlays) {
  SessionConfig config = config_of(32, SessionMode::rollback);
  CrowdMatch match(config, 32);
  EXPECT_TRUE(match.run_to(200, 10 * kSecond));
  match.expect_all_play();
  expect_one_history(match);
}

}  // namespace crowd_test
}  // namespace isostep::test
