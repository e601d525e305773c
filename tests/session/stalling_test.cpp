// Stalling is not free: who makes the others wait spends its patience of a minute and then watches, and all are told.
// SPDX-License-Identifier: MIT
#include "session/altered_packet.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace stalling_test {

using Kind = SessionEvent::Kind;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr std::size_t kMachines = 4, kStaller = 3;

enum class Way { silent, talking };  // nothing is sent at all; or datagrams without inputs, as an altered client would

class Stalling : public testing::TestWithParam<std::tuple<SessionMode, Way>> {
 protected:
  Stalling() : match(config_of(kMachines, std::get<0>(GetParam())), kGoodLine) {
    match.pass(10 * kSecond);
    seat = match.machine(kStaller).seat;
    match.machine(kStaller).returns = true;
    match.host().middle = [this](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel == Channel::datagram && is_holding) drop_inputs_of(seat, bytes);
    };
  }
  void stall(bool on) {
    if (std::get<1>(GetParam()) == Way::silent) match.network().set_silent(match.machine(kStaller).endpoint, on);
    else is_holding = on;
  }
  /// [us] The time during which machine 1 stood for more than a twentieth of a second.
  Time lost(const PaceWatch<Toy>& watch) const {
    Time sum = 0;
    for (const Time interval : watch[1].intervals) sum += interval > 50 * kMs ? interval : 0;
    return sum;
  }

  ToyMatch match;
  int seat = -1;
  bool is_holding = false;
};
INSTANTIATE_TEST_SUITE_P(Modes, Stalling,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(Way::silent, Way::talking)));

TEST_P(Stalling, HalfOfTheTimeCostsTheOthersATenthOfIt) {
  PaceWatch<Toy> watch(match);
  for (int n = 0; n < 25; ++n) {
    stall(true);
    watch.watch(4800 * kMs);
    stall(false);
    watch.watch(5000 * kMs);
  }
  const Time total = 25 * 9800 * kMs;
  EXPECT_LE(lost(watch) * 10, total) << "half of it, for ever, when running earned waiting back";
  EXPECT_GE(lost(watch), 10 * kSecond) << "it did hold the match up, and came back to do it again";
  EXPECT_GE(match.host().count(Kind::left, seat), 3);
  EXPECT_GE(match.host().count(Kind::joined, seat), 3);
  expect_one_history(match);
}

TEST_P(Stalling, ManyShortWaitsSpendAsMuchAsALongOne) {
  PaceWatch<Toy> watch(match);
  for (int n = 0; n < 200; ++n) {
    stall(true);
    watch.watch(700 * kMs);
    stall(false);
    watch.watch(300 * kMs);
  }
  EXPECT_LE(lost(watch), 20 * kSecond) << "in 200 s";
  EXPECT_GE(match.host().count(Kind::left, seat), 2);
  expect_one_history(match);
}

TEST_P(Stalling, ShutsOutForAMinuteAndNotLonger) {
  stall(true);
  const auto is_out = [&] { return match.host().heard(Kind::left, seat); };
  ASSERT_TRUE(match.run(8 * kSecond, is_out));
  stall(false);
  const Time out = match.now();
  const auto is_back = [&] { return match.host().count(Kind::joined, seat) == 2; };
  ASSERT_TRUE(match.run(70 * kSecond, is_back));
  if (std::get<1>(GetParam()) == Way::talking) {
    EXPECT_GE(match.now() - out, 58 * kSecond);
  }
  EXPECT_LE(match.now() - out, 62 * kSecond);
  match.pass(5 * kSecond);
  EXPECT_EQ(match.machine(kStaller).session.phase(), SessionPhase::playing);
  expect_one_history(match);
}

TEST_P(Stalling, IsToldOnEveryMachine) {
  for (std::size_t i = 0; i < kMachines; ++i) match.machine(i).events.clear();
  stall(true);
  match.pass(500 * kMs + 200 * kMs);  // a rollback's window and the delay come before the wait
  for (std::size_t i = 0; i < kMachines; ++i) {
    if (i == kStaller && std::get<1>(GetParam()) == Way::silent) continue;
    EXPECT_EQ(match.machine(i).count(Kind::waiting_for), 1) << i;
    EXPECT_EQ(match.machine(i).last(Kind::waiting_for).players, 1u << seat) << i;
  }
  match.pass(2 * kSecond);
  stall(false);
  match.pass(500 * kMs);
  for (std::size_t i = 0; i < kMachines; ++i) {
    // Who was silent waits for the host first, and then hears that it is waited for.
    const bool was_silent = i == kStaller && std::get<1>(GetParam()) == Way::silent;
    EXPECT_EQ(match.machine(i).count(Kind::waiting_for), was_silent ? 2 : 1) << i;
    EXPECT_EQ(match.machine(i).count(Kind::resumed), 1) << i;
  }
  expect_one_history(match);
}

TEST(Stall, OfTheHostIsToldByTheClients) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    ToyMatch match(config_of(kMachines, mode), kGoodLine);
    match.pass(10 * kSecond);
    match.host().plays = false;
    match.pass(700 * kMs);
    for (std::size_t i = 1; i < kMachines; ++i) {
      EXPECT_EQ(match.machine(i).last(Kind::waiting_for).players, 1u) << "the host's player";
    }
    match.pass(kSecond);
    match.host().plays = true;
    match.pass(500 * kMs);
    for (std::size_t i = 1; i < kMachines; ++i) EXPECT_EQ(match.machine(i).count(Kind::resumed), 1);
    expect_one_history(match, true);
  }
}

}  // namespace stalling_test
}  // namespace isostep::test
