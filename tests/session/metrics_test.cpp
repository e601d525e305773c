// Figures of every player's line, on all machines, beside what the simulated network did.
// SPDX-License-Identifier: MIT
#include <array>
#include <set>

#include "session/pace_watch.hpp"

namespace isostep::test {
namespace metrics_test {

constexpr Time kMs = 1000;  // [us]
constexpr std::size_t kMachines = 4;
constexpr const char* kLines[kMachines] = {"", "latency=30,jitter=5,loss=0.5", "latency=60,jitter=40,loss=0.5",
                                           "latency=60,jitter=5,loss=5"};
// [us] The mean difference of two delays that are even over +-jitter is two thirds of it. A tenth less or more, and
// half a millisecond, for time stamps are whole ones.
constexpr std::uint32_t kLeastJitter[kMachines] = {0, 2500, 23500, 2500},
                        kMostJitter[kMachines] = {0, 4100, 29900, 4100};
constexpr std::uint32_t kWay[kMachines] = {0, 30000, 60000, 60000};  // [us]

struct Measured : ToyMatch {
  explicit Measured(SessionMode mode) : ToyMatch(settings(mode), kLines[1], 3) {
    for (std::size_t i = 1; i < kMachines; ++i) network().set_profile(machine(i).endpoint, profile(kLines[i]));
  }
  static SessionConfig settings(SessionMode mode) {
    SessionConfig config = config_of(static_cast<int>(kMachines), mode);
    config.patience = 60 * kSecond;  // for lines like these in lockstep
    return config;
  }
  const PlayerStats& figures(std::size_t on, std::size_t of) {
    return machine(on).session.stats().players[static_cast<std::size_t>(machine(of).seat)];
  }
  std::uint32_t lost(std::size_t i, transport::Direction direction) {
    const transport::DirectionStatistics& line = network().statistics(machine(i).endpoint, direction);
    return static_cast<std::uint32_t>((line.lost * 1000 + line.packets / 2) / line.packets);
  }
};

class Metrics : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Metrics, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Metrics, AreThoseOfTheNetwork) {
  Measured match(GetParam());
  match.pass(60 * kSecond);
  for (std::size_t i = 1; i < kMachines; ++i) {
    SCOPED_TRACE(kLines[i]);
    const PlayerStats& up = match.figures(0, i);
    const SessionStats& own = match.machine(i).session.stats();
    EXPECT_NEAR(up.loss, match.lost(i, transport::Direction::up), 2);
    EXPECT_NEAR(own.loss, match.lost(i, transport::Direction::down), 2);
    EXPECT_NEAR(up.loss, i == 3 ? 50 : 5, i == 3 ? 10 : 3) << "as the line was set";
    for (const std::uint32_t jitter : {up.jitter, own.jitter}) {
      EXPECT_GE(jitter, kLeastJitter[i]);
      EXPECT_LE(jitter, kMostJitter[i]);
    }
    EXPECT_GE(up.round_trip, 2 * kWay[i] - 15 * kMs);
    EXPECT_LE(up.round_trip, 2 * kWay[i] + 25 * kMs);
  }
  EXPECT_EQ(match.figures(2, 0).round_trip, 0u) << "the host's own player has no line";
  expect_one_history(match);
}

TEST_P(Metrics, AreKnownOnEveryMachineWithinASecond) {
  Measured match(GetParam());
  match.pass(30 * kSecond);
  const std::uint64_t refused = match.machine(1).session.stats().refused;
  // What the host had at some moment of the last second and a way.
  std::set<std::array<std::uint32_t, 3>> had[kMachines];
  const auto figures = [](const PlayerStats& of) { return std::array{of.loss, of.jitter, of.round_trip}; };
  match.run(kSecond + 300 * kMs, [&] {
    for (std::size_t of = 1; of < kMachines; ++of) had[of].insert(figures(match.figures(0, of)));
    return false;
  });
  for (std::size_t on = 1; on < kMachines; ++on) {
    for (std::size_t of = 1; of < kMachines; ++of) EXPECT_TRUE(had[of].contains(figures(match.figures(on, of))));
  }
  for (std::size_t of = 1; of < kMachines; ++of) EXPECT_LE(had[of].size(), 3u);
  EXPECT_EQ(match.machine(1).session.stats().refused, refused);
}

TEST_P(Metrics, SayForHowLongTheOthersWaited) {
  SessionConfig config = config_of(4, GetParam());
  ToyMatch match(config, kLines[1]);
  match.pass(20 * kSecond);
  const auto seat = static_cast<std::size_t>(match.machine(2).seat);
  const std::uint32_t before = match.host().session.stats().players[seat].waited;
  match.network().set_silent(match.machine(2).endpoint, true);
  match.pass(2 * kSecond);
  match.network().set_silent(match.machine(2).endpoint, false);
  match.pass(3 * kSecond);
  for (std::size_t i = 0; i < match.size(); ++i) {
    SCOPED_TRACE(i);
    const SessionStats& stats = match.machine(i).session.stats();
    // Less what its last inputs were early, and what may be guessed.
    EXPECT_LE(stats.players[seat].waited - before, 2150u * kMs);
    EXPECT_GE(stats.players[seat].waited - before, 1600u * kMs);
    for (std::size_t p = 0; p < 4; ++p) {
      EXPECT_TRUE(p == seat || stats.players[p].waited <= 200u * kMs) << "nobody else is blamed";
    }
  }
  match.pass(61 * kSecond);
  EXPECT_LE(match.machine(1).session.stats().players[seat].waited, 100u * kMs) << "a minute later it is forgotten";
}

}  // namespace metrics_test
}  // namespace isostep::test
