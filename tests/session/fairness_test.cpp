// Nobody pays for another's hitch, line or lies: whose fault a late input is decides whose inputs wait longer.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/input_delay.hpp"
#include "session/altered_packet.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace fairness_test {

constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr std::size_t kMachines = 4;

/// The growth of the longest wait of machine `i`'s inputs.
Frame growth(const PaceWatch<Toy>& watch, const std::vector<Frame>& before, std::size_t i) {
  return watch[i].most_delay - before[i];
}
std::vector<Frame> delays(ToyMatch& match) {
  std::vector<Frame> all;
  for (std::size_t i = 0; i < match.size(); ++i) all.push_back(match.machine(i).session.stats().delay);
  return all;
}

class Hitch : public testing::TestWithParam<std::tuple<SessionMode, std::size_t>> {};
INSTANTIATE_TEST_SUITE_P(Machines, Hitch,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(std::size_t{0}, std::size_t{1}, std::size_t{3})));

TEST_P(Hitch, OfASecondOrLessLeavesTheDelaysOfTheOthersAsTheyWere) {
  const auto [mode, who] = GetParam();
  for (const Time length : {100 * kMs, 250 * kMs, 1000 * kMs}) {
    for (const std::uint64_t seed : {1u, 2u}) {
      SCOPED_TRACE(std::to_string(length / kMs) + " ms, seed " + std::to_string(seed));
      ToyMatch match(config_of(kMachines, mode), kGoodLine, seed);
      match.pass(20 * kSecond);
      const std::vector<Frame> before = delays(match);
      match.hitch(who, length);
      PaceWatch<Toy> watch(match);
      watch.watch(15 * kSecond);
      for (std::size_t i = 0; i < kMachines; ++i) EXPECT_LE(growth(watch, before, i), i == who ? 4 : 1) << i;
      EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0);
      expect_one_history(match, true);
    }
  }
}

TEST_P(Hitch, OfThreeSecondsIsForgottenAfterFifteen) {
  const auto [mode, who] = GetParam();
  ToyMatch match(config_of(kMachines, mode), kGoodLine);
  match.pass(20 * kSecond);
  const std::vector<Frame> before = delays(match);
  match.hitch(who, 3 * kSecond);
  PaceWatch<Toy> watch(match);
  watch.watch(15 * kSecond);
  for (std::size_t i = 0; i < kMachines; ++i) {
    EXPECT_LE(growth(watch, before, i), 4) << i;
    EXPECT_LE(watch[i].delay - before[i], 1) << i;
  }
  expect_one_history(match, true);
}

TEST(Hitch, ThatComesAgainAndAgainIsCoveredByItsOwnDelay) {
  ToyMatch match(config_of(kMachines, SessionMode::rollback), kGoodLine);
  match.pass(20 * kSecond);
  const std::vector<Frame> before = delays(match);
  PaceWatch<Toy> watch(match);
  for (int n = 0; n < 20; ++n) {
    match.hitch(1, 150 * kMs);
    watch.watch(850 * kMs);
  }
  EXPECT_GE(growth(watch, before, 1), 3) << "who hitches in every second has to send earlier";
  for (const std::size_t i : {0, 2, 3}) EXPECT_LE(growth(watch, before, i), 1) << i;
  expect_one_history(match, true);
}

class BadLine : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, BadLine, testing::Values(1, 2, 3));

TEST_P(BadLine, CostsWhoHasItAndNobodyElse) {
  ToyMatch match(config_of(kMachines, SessionMode::rollback), kGoodLine, GetParam());
  const std::size_t bad = 3;
  match.network().set_profile(match.machine(bad).endpoint, profile("latency=150,jitter=50"));
  match.pass(5 * kSecond);  // as long as clocks and delays take to settle
  PaceWatch<Toy> watch(match);
  watch.watch(60 * kSecond);
  Frame worst = 0;
  for (std::size_t i = 0; i < bad; ++i) {
    EXPECT_LE(watch[i].most_delay, 6) << i;
    EXPECT_EQ(watch[i].gaps(50 * kMs), 0u) << i << ": " << watch[i].worst();
    EXPECT_GE(watch.hundred_seconds(i), 5900) << i;
    worst = std::max(worst, watch[i].most_delay);
  }
  EXPECT_EQ(watch[bad].gaps(50 * kMs), 0u) << watch[bad].worst();
  EXPECT_GE(watch[bad].least_delay, worst);
  EXPECT_GE(watch.hundred_seconds(bad), 5900);

  match.machine(bad).plays = false;
  match.network().cut(match.machine(bad).endpoint);
  match.pass(5 * kSecond);
  ToyMatch good(config_of(kMachines, SessionMode::rollback), kGoodLine, GetParam());
  good.pass(20 * kSecond);
  const std::vector<Frame> usual = delays(good), now = delays(match);
  for (std::size_t i = 0; i < bad; ++i) EXPECT_LE(now[i], usual[i] + 1) << "as on good lines alone";
  expect_one_history(match);
}

TEST(BadLine, InLockstepCostsTheOthersLessThanWhoHasIt) {
  ToyMatch match(config_of(kMachines, SessionMode::lockstep), kGoodLine);
  match.network().set_profile(match.machine(3).endpoint, profile("latency=150,jitter=50"));
  match.pass(10 * kSecond);
  PaceWatch<Toy> watch(match);
  watch.watch(60 * kSecond);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(watch[i].most_delay, 10) << "16 were needed when all waited for it";
    EXPECT_LE(watch[i].gaps(50 * kMs), 2u);
  }
  expect_one_history(match);
}

constexpr int kLiar = 3;
enum class Lie { slack, echo, both, bursts_too };
class Lies : public testing::TestWithParam<std::tuple<SessionMode, Lie>> {};
INSTANTIATE_TEST_SUITE_P(Modes, Lies,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(Lie::slack, Lie::echo, Lie::both, Lie::bursts_too)));

/// The liar says that all others' inputs come two seconds late, that its own line takes half a second, or both.
void tell_lie(Lie lie, PacketHeader& header) {
  constexpr auto kNothing = static_cast<std::int8_t>(RecentLeast::kNothing);
  if (header.slack[kLiar] != kNothing || header.slack[0] == kNothing) return;
  for (int p = 0; p < kLiar && lie != Lie::echo; ++p) header.slack[p] = -127;
  if (lie != Lie::slack) header.echo = static_cast<std::uint16_t>(header.echo - 500);
}

TEST_P(Lies, AboutLatenessAndTheLineMoveTheOthersByLittle) {
  const auto [mode, lie] = GetParam();
  ToyMatch match(config_of(kMachines, mode), kGoodLine);
  match.pass(20 * kSecond);
  const std::vector<Frame> before = delays(match);
  match.host().middle = [lie = lie](Channel channel, std::vector<std::uint8_t>& bytes) {
    if (channel != Channel::datagram) return;
    alter_packet(
        bytes, [lie](PacketHeader& header) { tell_lie(lie, header); }, [](int, Frame, std::vector<std::uint8_t>&) {});
  };
  if (lie == Lie::bursts_too) match.machine(kLiar).slow = 70 * kMs;
  PaceWatch<Toy> watch(match);
  watch.watch(30 * kSecond);
  for (std::size_t i = 0; i < kLiar; ++i) EXPECT_LE(growth(watch, before, i), 2) << "20 before";
  expect_one_history(match);
}

TEST(Lie, OfAClockThatIsTooFastMoveTheOthersByLittle) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    ToyMatch honest(config_of(kMachines, mode), kGoodLine), match(config_of(kMachines, mode), kGoodLine);
    match.machine(3).fast = 200;
    honest.pass(20 * kSecond);
    match.pass(20 * kSecond);
    const std::vector<Frame> before = delays(honest);
    PaceWatch<Toy> watch(match);
    watch.watch(30 * kSecond);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(growth(watch, before, i), 2) << "20 before";
    expect_one_history(match);
  }
}

}  // namespace fairness_test
}  // namespace isostep::test
