// Presets: what CHOOSING.md says of each kind of game on three lines.
// SPDX-License-Identifier: MIT
#include "isostep/session/preset.hpp"

#include "session/match_checks.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace preset_test {

constexpr const char* kGood = "latency=10,jitter=2";
constexpr const char* kUsual = "latency=30,jitter=5,loss=0.5";
constexpr const char* kBad = "latency=75,jitter=20,loss=2";

struct Expected {
  Genre genre;
  int players;
  const char* line;
  Frame delay;    // [frames] that no machine's inputs wait longer than
  Frame deepest;  // [frames] of rollbacks that 99 of 100 frames do not exceed
};
constexpr Expected kExpected[] = {
    {Genre::fighting, 2, kGood, 2, 1}, {Genre::fighting, 2, kUsual, 2, 4}, {Genre::fighting, 2, kBad, 4, 8},
    {Genre::brawler, 4, kGood, 1, 2},  {Genre::brawler, 4, kUsual, 4, 4},  {Genre::brawler, 4, kBad, 6, 8},
    {Genre::racing, 8, kGood, 1, 2},   {Genre::racing, 8, kUsual, 2, 6},   {Genre::racing, 8, kBad, 8, 12},
    {Genre::strategy, 8, kGood, 6, 0}, {Genre::strategy, 8, kUsual, 8, 0}, {Genre::strategy, 8, kBad, 18, 0},
    {Genre::sandbox, 4, kGood, 2, 1},  {Genre::sandbox, 4, kUsual, 5, 2},  {Genre::sandbox, 4, kBad, 12, 4}};

class Preset : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(Genres, Preset, testing::ValuesIn(kExpected));

/// [frames] that 99 of 100 rollbacks and frames without one do not exceed.
Frame usual_depth(const SessionStats& stats, Frame frames) {
  std::uint64_t left = static_cast<std::uint64_t>(frames) / 100;
  for (Frame depth = 64; depth > 0; --depth) {
    const std::uint64_t count = stats.rollbacks[depth];
    if (count > left) return depth;
    left -= count;
  }
  return 0;
}

std::uint64_t replaced(const SessionStats& stats) {
  std::uint64_t sum = 0;
  for (const PlayerStats& player : stats.players) sum += player.replaced;
  return sum;
}

TEST_P(Preset, KeepsWhatThePageSays) {
  const Expected& expected = GetParam();
  ToyMatch match(preset(expected.genre, expected.players), expected.line);
  match.pass(15 * kSecond);
  const std::uint64_t before = replaced(match.host().session.stats());
  PaceWatch<Toy> pace(match);
  pace.watch(30 * kSecond);
  EXPECT_EQ(replaced(match.host().session.stats()), before);
  for (std::size_t i = 0; i < match.size(); ++i) {
    SCOPED_TRACE("machine " + std::to_string(i));
    const auto& session = match.machine(i).session;
    EXPECT_LE(pace[i].most_delay, expected.delay);
    EXPECT_LE(usual_depth(session.stats(), session.current()), expected.deepest);
    EXPECT_EQ(pace[i].gaps(50000), 0u);
    EXPECT_GE(pace.hundred_seconds(i), 5990);
  }
  expect_one_history(match);
}

/// A preset with a deadline, and the longest line on which it plays: the round trip of one player, the others have
/// kUsual lines.
struct Reach {
  Genre genre;
  int players;
  int farthest;  // [ms]
};
constexpr Reach kReaches[] = {
    {Genre::fighting, 2, 600}, {Genre::brawler, 4, 600}, {Genre::racing, 4, 600}, {Genre::strategy, 4, 450}};

class PresetReach : public testing::TestWithParam<Reach> {
 protected:
  /// One player on a line of `trip` [ms] there and back, and what it lost in half a minute.
  void play(int trip, const char* rest) {
    const Reach& reach = GetParam();
    SCOPED_TRACE("line of " + std::to_string(trip) + " ms" + rest);
    ToyMatch match(preset(reach.genre, reach.players), kUsual);
    Machine<Toy>& far = match.machine(1);
    match.network().set_profile(far.endpoint, profile("latency=" + std::to_string(trip / 2) + rest));
    match.pass(15 * kSecond);
    const bool plays = trip <= reach.farthest;
    const int seat = far.seat < 0 ? 1 : far.seat;
    const Machine<Toy>* both[] = {&match.host(), &far};
    for (const Machine<Toy>* machine : both) {
      EXPECT_EQ(machine->session.stats().players[seat].replaced > 0,
                machine->heard(SessionEvent::Kind::replaced, seat));
      EXPECT_EQ(machine->heard(SessionEvent::Kind::too_far, seat), !plays);
    }
    const std::uint64_t before = replaced(match.host().session.stats());
    PaceWatch<Toy> pace(match);
    pace.watch(30 * kSecond);
    EXPECT_EQ(replaced(match.host().session.stats()), before);
    EXPECT_EQ(far.session.phase(), plays ? SessionPhase::playing : SessionPhase::watching);
    EXPECT_EQ(match.host().heard(SessionEvent::Kind::left, seat), !plays);
    EXPECT_LE(pace[1].most_delay, 30);
    for (std::size_t i = 0; i < match.size(); ++i) {
      if (i == 1) continue;
      EXPECT_EQ(pace[i].gaps(50000), 0u) << i << " waits " << pace[i].worst();
    }
    expect_one_history(match, true);
  }
};
INSTANTIATE_TEST_SUITE_P(Genres, PresetReach, testing::ValuesIn(kReaches));

TEST_P(PresetReach, LosesNoInputOnItsLinesAndBeyondThemWatches) {
  for (int trip = 0; trip <= 800; trip += 100) play(trip, "");
}

TEST_P(PresetReach, LosesNoInputOnBadLines) {
  for (const int trip : {100, 200, 300, 400}) play(trip, ",jitter=40,loss=5");
}

// After it all wait as long as before.
TEST(Preset, ForgetsAHitchInTwentySeconds) {
  for (const Time hitch : {200, 500, 900}) {
    SCOPED_TRACE(hitch);
    ToyMatch match(preset(Genre::strategy, 4), kUsual);
    match.pass(20 * kSecond);
    std::vector<Frame> before;
    for (std::size_t i = 0; i < match.size(); ++i) before.push_back(match.machine(i).session.stats().delay);
    match.hitch(1, hitch * 1000);
    match.pass(20 * kSecond);
    PaceWatch<Toy> pace(match);
    pace.watch(40 * kSecond);
    for (std::size_t i = 0; i < match.size(); ++i) EXPECT_LE(pace[i].most_delay, before[i]) << i;
    expect_one_history(match, true);
  }
}

TEST(Preset, IsAConfigurationThatASessionTakes) {
  for (const Genre genre : {Genre::fighting, Genre::brawler, Genre::racing, Genre::strategy, Genre::sandbox}) {
    for (int players = 2; players <= static_cast<int>(kMaxPlayers); ++players) {
      EXPECT_EQ(problem_of(preset(genre, players)), nullptr);
    }
  }
}

}  // namespace preset_test
}  // namespace isostep::test
