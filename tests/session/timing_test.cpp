// Time: the delay follows the line, clocks that run wrong are led to one pace.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace timing_test {

struct Match : VirtualMatch<Toy> {
  Match(const SessionConfig& config, std::string_view line)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); },
            [](int, Frame frame) {
              return ToyInput{0, 0, static_cast<std::uint16_t>(frame)};
            }) {  // when it was asked
    for (int p = 1; p < config.players; ++p) add(profile(line));
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  void change_lines(std::string_view line) {
    for (std::size_t i = 1; i < size(); ++i) network().set_profile(machine(i).endpoint, profile(line));
  }
};
SessionConfig config_of(int players, SessionMode mode) {
  SessionConfig config;
  config.players = players;
  config.mode = mode;
  return config;
}

class Delay : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Delay, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Delay, RisesOnABadLineAndFallsOnAGoodOneAndNoInputIsLost) {
  Match match(config_of(2, GetParam()), "lan");
  const auto delay = [&] { return match.machine(1).session.stats().delay; };
  match.pass(20 * kSecond);
  const Frame good = delay();
  match.change_lines("mobile");
  match.pass(10 * kSecond);
  const Frame bad = delay();
  match.change_lines("lan");
  match.pass(60 * kSecond);
  const Frame good_again = delay();
  // One way is 10 ms, or 0.6 frames; then 100 ms with 20 more and losses, 7.2 frames of which rollback takes four.
  EXPECT_LE(good, 3);
  EXPECT_GE(bad, GetParam() == SessionMode::lockstep ? 8 : 4);
  EXPECT_LE(good_again, 3);

  EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0);
  for (int player = 0; player < 2; ++player) {
    std::uint16_t asked = 0;
    for (Frame frame = 60; frame < match.host().end(); ++frame) {
      ASSERT_TRUE(match.host().played(frame, player)) << frame;
      const std::uint16_t now = match.host().at(frame)[static_cast<std::size_t>(player)].input.word;
      ASSERT_GE(now, asked) << "inputs out of order in frame " << frame;
      ASSERT_LE(now, frame);
      ASSERT_GE(now + match.host().session.config().most_delay + 1, frame) << "older than any delay";
      asked = now;
    }
  }
  expect_one_history(match);
}

TEST(Delay, IsLeftAloneWhereItIsFixed) {
  SessionConfig config = config_of(2, SessionMode::lockstep);
  config.delay = config.least_delay = config.most_delay = 5;
  Match match(config, "lan");
  match.pass(10 * kSecond);
  match.change_lines("mobile");
  match.pass(10 * kSecond);
  EXPECT_EQ(match.machine(1).session.stats().delay, 5);
  EXPECT_EQ(match.host().session.stats().delay, 5);
  EXPECT_GT(match.host().session.stats().waits, 0u);
  for (Frame frame = 60; frame < match.host().end(); ++frame) {
    const Frame asked = match.host().at(frame)[0].input.word;
    ASSERT_GE(frame - asked, 5);
    ASSERT_LE(frame - asked, 6) << "a turn that makes up for a late one steps two frames on one input";
  }
  expect_one_history(match);
}

class Pacing : public testing::TestWithParam<std::tuple<SessionMode, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Lines, Pacing,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values("lan", "wifi", "mobile", "constant")));

TEST_P(Pacing, LeadsAFastAndASlowClockToTheHostsFrame) {
  const auto [mode, line] = GetParam();
  Match match(config_of(3, mode), line);
  match.machine(1).fast = 10;
  match.machine(2).late = 10;
  match.pass(10 * kSecond);
  double sum[3] = {};
  int samples = 0;
  // 1 % of thirty seconds is 18 frames.
  match.run(30 * kSecond, [&] {
    ++samples;
    for (std::size_t i = 1; i < 3; ++i) sum[i] += match.machine(i).session.current() - match.host().session.current();
    return false;
  });
  for (std::size_t i = 1; i < 3; ++i) EXPECT_LE(std::abs(sum[i] / samples), 2.0) << "client " << i;
  EXPECT_GT(match.host().end(), 36 * 60) << "the host is held up only until the delays fit";
  expect_one_history(match);
}

// The delay that no clock can tell from a difference of clocks: both directions differ by 190 ms.
TEST(Pacing, IsWrongByHalfTheDifferenceOfBothDirectionsAndNoMore) {
  Match match(config_of(2, SessionMode::rollback), "asymmetric");
  match.pass(10 * kSecond);
  double sum = 0;
  int samples = 0;
  match.run(20 * kSecond, [&] {
    ++samples;
    sum += match.machine(1).session.current() - match.host().session.current();
    return false;
  });
  EXPECT_LE(std::abs(sum / samples), 0.095 * 60 + 1);
  expect_one_history(match);
}

}  // namespace timing_test
}  // namespace isostep::test
