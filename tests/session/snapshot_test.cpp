// Snapshots over slow lines: how long they take, what the players notice, and that a cut costs only what was under way.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/session/protocol/message.hpp"
#include "session/bulky_game.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace snapshot_test {

constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

/// Two play on good lines for half a minute: then the first inputs are gone, and a third needs a snapshot.
struct Slow : VirtualMatch<Bulky> {
  explicit Slow(std::uint64_t bytes, int players = 3)
      : VirtualMatch(
            config_of(players, SessionMode::rollback), [bytes] { return std::make_unique<Bulky>(bytes / 8); },
            [](int player, Frame frame) { return toy_input(5, player, frame); }) {
    add(profile(kGoodLine));
    pass(kSecond);
    host().session.start(now());
    pass(30 * kSecond);
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  bool run_until_playing(const Machine<Bulky>& joiner, Time limit) {
    return run(limit, [&] { return joiner.session.phase() == SessionPhase::playing; });
  }
};

struct Line {
  const char* text;
  Time limit;  // [us] until a joiner plays
};
class SlowLine : public testing::TestWithParam<Line> {};
INSTANTIATE_TEST_SUITE_P(Rates, SlowLine,
                         testing::Values(Line{"latency=30,rate=200", 35 * kSecond},
                                         Line{"latency=30,rate=100", 70 * kSecond}));

TEST_P(SlowLine, BringsFiveMegabytesAndThePlayersDoNotNotice) {
  Slow match(5000000);
  PaceWatch<Bulky> before(match);
  before.watch(10 * kSecond);
  Machine<Bulky>& joiner = match.add(profile(GetParam().text));
  PaceWatch<Bulky> watch(match);
  const Time from = match.now();
  const bool plays = match.run(3 * GetParam().limit, [&] {
    watch.look();
    return joiner.session.phase() == SessionPhase::playing;
  });
  EXPECT_TRUE(plays);
  EXPECT_LE(match.now() - from, GetParam().limit);
  EXPECT_EQ(joiner.count(SessionEvent::Kind::lost_host), 0);
  for (const std::size_t i : {0, 1}) {
    EXPECT_LE(watch[i].worst(), 50000u) << "[us] between two steps";
    EXPECT_LE(watch[i].most_delay, before[i].most_delay);
  }
  std::printf("%s: plays after %.1f s, lost the host %d times, longest step of a player %.1f ms\n", GetParam().text,
              double(match.now() - from) / kSecond, joiner.count(SessionEvent::Kind::lost_host),
              double(std::max(watch[0].worst(), watch[1].worst())) / 1000);
}

// --- what is told ---

TEST(Snapshot, TellsBothSidesHowFarItIs) {
  Slow match(1000000);
  Machine<Bulky>& joiner = match.add(profile("latency=30,rate=200"));
  SnapshotProgress last;
  bool never_less = true, host_never_more = true, host_near = false;
  int told = 0;
  const auto look = [&] {
    const SnapshotProgress has = joiner.session.snapshot_progress();
    const SnapshotProgress known = match.host().session.snapshot_progress(1);
    if (has.size == 0) return false;
    never_less = never_less && has.arrived >= last.arrived && (last.size == 0 || has.size == last.size);
    host_never_more = host_never_more && known.arrived <= has.arrived;
    host_near = host_near || (known.arrived > 500000 && known.size == has.size);
    told += has.arrived != last.arrived ? 1 : 0;
    last = has;
    return false;
  };
  match.run(10 * kSecond, look);
  EXPECT_EQ(joiner.session.phase(), SessionPhase::playing);
  EXPECT_GT(last.size, 1000000u);
  EXPECT_GT(told, 100);
  EXPECT_TRUE(never_less && host_never_more && host_near);
  EXPECT_EQ(joiner.session.snapshot_progress().size, 0u) << "it is over";
  EXPECT_EQ(match.host().session.snapshot_progress(1).size, 0u);
  EXPECT_EQ(match.host().session.snapshot_progress(200).size, 0u);
}

// --- a line that is cut ---

/// [bytes] The messages that a joiner got until it plays, cut off so often, each time for so long.
std::uint64_t bytes_until_playing(Slow& match, Machine<Bulky>& joiner, int cuts, Time away) {
  joiner.returns = true;
  std::uint64_t bytes = 0;
  joiner.middle = [&](Channel channel, std::vector<std::uint8_t>& message) {
    if (channel == Channel::reliable) bytes += message.size();
  };
  for (int cut = 0; cut < cuts; ++cut) {
    match.pass(kSecond);
    EXPECT_EQ(joiner.session.phase(), SessionPhase::joining);
    match.network().cut(joiner.endpoint);
    joiner.plays = false;
    match.pass(away);
    joiner.plays = true;
  }
  EXPECT_TRUE(match.run_until_playing(joiner, 30 * kSecond));
  EXPECT_EQ(joiner.count(SessionEvent::Kind::lost_host), cuts);
  EXPECT_EQ(joiner.restarts, 1);
  match.pass(5 * kSecond);
  expect_one_history(match);
  return bytes;
}

TEST(Snapshot, GoesOnWhereItWasCutOff) {
  for (const Time away : {Time{0}, 2 * kSecond, 20 * kSecond}) {
    SCOPED_TRACE(away);
    Slow match(1000000);
    const std::uint64_t bytes =
        bytes_until_playing(match, match.add(profile("latency=30,rate=200")), away < 10 * kSecond ? 3 : 1, away);
    EXPECT_LE(bytes, 1020000u) << "no byte that had arrived came again";
  }
}

TEST(Snapshot, OfASpectatorGoesOnToo) {
  Slow match(1000000);
  SessionConfig watcher = config_of(3, SessionMode::spectator);
  watcher.local_players = 0;
  Machine<Bulky>& joiner = match.add(profile("latency=30,rate=200"), watcher);
  joiner.returns = true;
  match.pass(2 * kSecond);
  match.network().cut(joiner.endpoint);
  match.pass(kSecond / 2);
  EXPECT_GT(match.host().session.snapshot_progress(1).arrived, 300000u);
  EXPECT_TRUE(match.run(10 * kSecond, [&] { return joiner.session.phase() == SessionPhase::watching; }));
}

TEST(Snapshot, BeginsAnewWhenTheHostHasAnotherByThen) {
  Slow match(1000000, 4);
  Machine<Bulky>& joiner = match.add(profile("latency=30,rate=200"));
  joiner.returns = true;
  match.pass(2 * kSecond);
  match.network().cut(joiner.endpoint);
  joiner.plays = false;
  match.pass(10 * kSecond);  // longer than it is held for
  Machine<Bulky>& other = match.add(profile("lan"));
  ASSERT_TRUE(match.run_until_playing(other, 10 * kSecond));
  joiner.plays = true;
  EXPECT_TRUE(match.run_until_playing(joiner, 20 * kSecond));
  match.pass(5 * kSecond);
  expect_one_history(match);
}

// --- several at once, and lines that lose ---

TEST(Snapshot, IsSharedByWhoComesWhileItIsOnItsWay) {
  Slow match(2000000, 4);
  Machine<Bulky>& slow = match.add(profile("latency=30,rate=100"));
  match.pass(10 * kSecond);
  Machine<Bulky>& fast = match.add(profile("lan"));
  ASSERT_TRUE(match.run_until_playing(fast, 5 * kSecond));
  EXPECT_EQ(slow.session.phase(), SessionPhase::joining);
  ASSERT_TRUE(match.run_until_playing(slow, 20 * kSecond));
  EXPECT_EQ(slow.first, fast.first);
  match.pass(5 * kSecond);
  expect_one_history(match);
}

TEST(Snapshot, ArrivesOnLinesThatLose) {
  for (const char* line : {"wifi", "mobile", "severe"}) {
    SCOPED_TRACE(line);
    Slow match(1000000);
    Machine<Bulky>& joiner = match.add(profile(line));
    const Time from = match.now();
    EXPECT_TRUE(match.run_until_playing(joiner, 60 * kSecond));
    EXPECT_EQ(joiner.count(SessionEvent::Kind::lost_host), 0);
    std::printf("1 MB over %s: plays after %.1f s\n", line, double(match.now() - from) / kSecond);
  }
}

// A line on which it can never arrive keeps nobody out for longer than half of the log.
TEST(Snapshot, ThatCannotArriveInTimeMakesRoomForOthers) {
  Slow match(5000000, 4);
  match.add(profile("latency=30,rate=10"));
  match.pass(70 * kSecond);
  Machine<Bulky>& other = match.add(profile("lan"));
  EXPECT_TRUE(match.run_until_playing(other, 10 * kSecond));
}

}  // namespace snapshot_test
}  // namespace isostep::test
