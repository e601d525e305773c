// Spectators: they see what is final, whenever they come and however bad their line, and disturb nobody.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes/match.hpp"
#include "session/match_checks.hpp"

namespace isostep::test {
namespace spectator_test {

using Game = scenes::Match<Q16_16>;
constexpr int kPlayers = 2;

struct Watched {
  explicit Watched(Frame history = 1200) {
    config.players = kPlayers;
    config.history = history;
    config.silence = 30 * kSecond;  // a spectator may pause for as long
    watcher = config;
    watcher.mode = SessionMode::spectator;
    watcher.local_players = 0;
    const scenes::MatchSettings settings = {.players = kPlayers, .pile = 4, .substeps = 2};
    match = std::make_unique<VirtualMatch<Game>>(
        config, [settings] { return std::make_unique<Game>(settings); },
        [](int player, Frame frame) { return scenes::bot_input(21, player, frame); });
    match->add(profile("wifi"));
  }
  Machine<Game>& watch(std::string_view line) {
    Machine<Game>& machine = match->add(profile(line), watcher);
    machine.returns = true;
    machine.after_turn = [&machine, this] {
      const bool ahead = machine.session.current() > match->host().session.confirmed() && machine.session.current() > 0;
      was_ahead = was_ahead || ahead;
    };
    return machine;
  }
  SessionConfig config, watcher;
  std::unique_ptr<VirtualMatch<Game>> match;
  bool was_ahead = false;
};

void expect_spectator(const Machine<Game>& machine) {
  EXPECT_FALSE(machine.guessed) << "it stepped a frame that was not final";
  EXPECT_EQ(machine.seat, -1);
  for (const std::uint64_t count : machine.session.stats().rollbacks) EXPECT_EQ(count, 0u);
  EXPECT_EQ(machine.session.phase(), SessionPhase::watching);
}

TEST(Spectators, SeeTheSameMatchFromItsStartLateAndOverASevereLine) {
  Watched watched;
  Machine<Game>& first = watched.watch("lan");
  Machine<Game>& bad = watched.watch("severe");
  ASSERT_TRUE(watched.match->run_to(900, 60 * kSecond));
  Machine<Game>& late = watched.watch("wifi");
  ASSERT_TRUE(watched.match->run_to(1800, 60 * kSecond));
  for (const Machine<Game>* machine : {&first, &bad, &late}) expect_spectator(*machine);
  EXPECT_FALSE(watched.was_ahead);
  EXPECT_EQ(late.first, 0) << "the inputs of all frames were there";
  EXPECT_GT(watched.match->network().statistics(bad.endpoint, transport::Direction::down).lost, 100u);
  expect_one_history(*watched.match);
}

TEST(Spectators, ComeByASnapshotWhenTheFirstInputsAreGone) {
  Watched watched(200);
  ASSERT_TRUE(watched.match->run_to(900, 60 * kSecond));
  Machine<Game>& late = watched.watch("wifi");
  ASSERT_TRUE(watched.match->run_to(1500, 60 * kSecond));
  EXPECT_EQ(late.restarts, 1);
  EXPECT_GT(late.first, 800);
  expect_spectator(late);
  expect_one_history(*watched.match);
}

TEST(Spectators, CatchUpAfterTwentySecondsWithoutATurn) {
  Watched watched(2400);
  Machine<Game>& watcher = watched.watch("wifi");
  ASSERT_TRUE(watched.match->run_to(600, 60 * kSecond));
  const Frame before = watcher.end();
  watcher.plays = false;
  watched.match->run(20 * kSecond, [] { return false; });
  EXPECT_EQ(watcher.end(), before);
  EXPECT_GT(watched.match->host().end(), before + 1100);
  watcher.plays = true;
  // 1200 frames behind, six steps a turn, and one round trip for each 128 frames of inputs.
  EXPECT_TRUE(watched.match->run(5 * kSecond, [&] { return watched.match->host().end() - watcher.end() < 20; }));
  EXPECT_EQ(watcher.restarts, 0);
  EXPECT_EQ(watcher.first, 0);
  EXPECT_FALSE(watched.was_ahead);
  ASSERT_TRUE(watched.match->run_to(2400, 60 * kSecond));
  expect_spectator(watcher);
  expect_one_history(*watched.match, true);
}

TEST(Spectators, LeaveThePlayersAsTheyWouldBeAlone) {
  Watched alone, watched;
  watched.watch("lan");
  watched.watch("severe");
  watched.watch("mobile");
  ASSERT_TRUE(alone.match->run_to(1200, 60 * kSecond));
  ASSERT_TRUE(watched.match->run(alone.match->now() + 1, [&] { return watched.match->now() >= alone.match->now(); }));
  for (std::size_t i = 0; i < 2; ++i) {
    const SessionStats &without = alone.match->machine(i).session.stats(),
                       &with = watched.match->machine(i).session.stats();
    EXPECT_EQ(without.steps, with.steps);
    EXPECT_EQ(without.waits, with.waits);
    EXPECT_EQ(without.delay, with.delay);
    for (std::size_t depth = 0; depth < std::size(with.rollbacks); ++depth) {
      EXPECT_EQ(without.rollbacks[depth], with.rollbacks[depth]) << depth;
    }
  }
  EXPECT_EQ(alone.match->host().hashes, watched.match->host().hashes);
  EXPECT_GT(alone.match->host().session.stats().steps, 1200u) << "there were rollbacks to disturb";
}

}  // namespace spectator_test
}  // namespace isostep::test
