// Steps that a rollback repeats cost time: a machine that has none to spare is given the inputs earlier.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace thrift_test {

constexpr Time kMs = 1000;  // [us]

/// Machines on which each step takes its time, one that a rollback repeats as well.
struct DearMatch : ToyMatch {
  DearMatch(const SessionConfig& config, Time its_cost, bool on_both) : ToyMatch(config, "latency=30,jitter=5") {
    cost = its_cost;
    from = on_both ? 0 : 1;
  }
  void pass(Time time) {
    run(time, [&] {
      for (std::size_t i = from; i < size(); ++i) {
        Machine<Toy>& each = machine(i);
        const std::uint64_t steps = each.session.stats().steps;
        if (steps > before[i]) each.next_turn = now() + (steps - before[i]) * cost;
        before[i] = steps;
      }
      return false;
    });
  }
  /// [frames/100 s] The pace of the next half minute.
  Frame pace() {
    const Frame first = host().session.confirmed();
    pass(30 * kSecond);
    return (host().session.confirmed() - first) * 10 / 3;
  }
  Time cost = 0;  // [us]
  std::size_t from = 0;
  std::uint64_t before[4] = {};
};

SessionConfig undelayed(Frame most) {
  SessionConfig config = config_of(2, SessionMode::rollback);
  config.delay = config.least_delay = 0;
  config.most_delay = most;
  return config;
}

TEST(Thrift, DelayIsLongerWhereItSparesStepsThatTakeTooLong) {
  for (const Time cost : {8 * kMs, 12 * kMs}) {
    for (const bool on_both : {false, true}) {
      SCOPED_TRACE(std::to_string(cost) + (on_both ? " on both" : " on the client"));
      DearMatch match(undelayed(20), cost, on_both);
      match.pass(30 * kSecond);
      EXPECT_GE(match.pace(), 5700) << "also where a frame less was tried";
      for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(match.machine(i).session.stats().delay, 4) << i;
      expect_one_history(match);
    }
  }
}

// Where the delay may not be longer the match is slow, as it was.
TEST(Thrift, MostDelayHolds) {
  DearMatch match(undelayed(1), 12 * kMs, true);
  match.pass(10 * kSecond);
  EXPECT_LE(match.pace(), 5500);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(match.machine(i).session.stats().delay, 1) << i;
  expect_one_history(match);
}

TEST(Thrift, DelaysAreShortAgainWhenTheMachineIsFast) {
  DearMatch match(undelayed(20), 12 * kMs, true);
  match.pass(30 * kSecond);
  const Frame most = match.machine(1).session.stats().delay;
  EXPECT_GE(most, 1);
  match.cost = 0;
  match.pass(80 * kSecond);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(match.machine(i).session.stats().delay, 0) << i;
  expect_one_history(match);
}

}  // namespace thrift_test
}  // namespace isostep::test
