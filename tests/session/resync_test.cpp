// Machines that differ: most of them say who is wrong, and that one takes a state again while the others play on.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "session/altered_packet.hpp"
#include "session/bulky_game.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace resync_test {

using Kind = SessionEvent::Kind;
constexpr Frame kFault = 400;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

SessionConfig repairing(int players, SessionMode mode) {
  SessionConfig config = config_of(players, mode);
  config.repair = true;
  return config;
}
/// One bit of its state, until a snapshot takes its place.
template <class Game> void damage(Machine<Game>& machine, int place = 5, Frame fault = kFault) {
  machine.tamper = [&machine, place, fault](Game& game, Frame frame) {
    if (frame == fault && machine.restarts == 0) game.state.places[place] ^= 1;
  };
}
int name_of(VirtualMatch<Toy>& match, std::size_t machine) { return machine == 0 ? 0xff : match.machine(machine).seat; }

// --- the verdict ---

class VerdictOfAMatch : public testing::TestWithParam<std::tuple<SessionMode, int>> {};
INSTANTIATE_TEST_SUITE_P(Modes, VerdictOfAMatch,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(3, 4, 8)));

TEST_P(VerdictOfAMatch, NamesTheOneThatIsWrongToEverybodyOnceAndSoon) {
  const auto [mode, players] = GetParam();
  for (const std::size_t culprit : {std::size_t{0}, std::size_t{1}, static_cast<std::size_t>(players - 1)}) {
    SCOPED_TRACE(culprit);
    ToyMatch match(config_of(players, mode), kGoodLine);
    damage(match.machine(culprit));
    ASSERT_TRUE(match.run_to(kFault, 20 * kSecond));
    match.pass(kSecond);
    std::vector<Frame> states;
    for (std::size_t i = 0; i < match.size(); ++i) {
      SCOPED_TRACE(i);
      ASSERT_EQ(match.machine(i).count(Kind::outvoted), 1);
      EXPECT_FALSE(match.machine(i).heard(Kind::undecided));
      const SessionEvent event = match.machine(i).last(Kind::outvoted);
      EXPECT_EQ(event.player, name_of(match, culprit));
      EXPECT_GT(event.frame, kFault);
      EXPECT_NE(event.ours, event.theirs);
      states.push_back(event.frame);
    }
    EXPECT_EQ(std::count(states.begin(), states.end(), states[0]), static_cast<std::ptrdiff_t>(states.size()));
    match.pass(5 * kSecond);
    for (std::size_t i = 0; i < match.size(); ++i) EXPECT_EQ(match.machine(i).count(Kind::outvoted), 1) << i;
  }
}

TEST(VerdictOfAMatch, IsNoneOfTwoMachinesAndOfTwoAgainstTwo) {
  for (const int players : {2, 4}) {
    SCOPED_TRACE(players);
    ToyMatch match(repairing(players, SessionMode::rollback), kGoodLine);
    for (std::size_t i = 0; i < match.size() / 2; ++i) damage(match.machine(i));
    ASSERT_TRUE(match.run_to(kFault + 120, 20 * kSecond));
    for (std::size_t i = 0; i < match.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_TRUE(match.machine(i).heard(Kind::desync));
      EXPECT_EQ(match.machine(i).count(Kind::undecided), 1);
      EXPECT_FALSE(match.machine(i).heard(Kind::outvoted));
      EXPECT_FALSE(match.machine(i).heard(Kind::repaired)) << "nobody knows whose states are right";
    }
  }
}

TEST(VerdictOfAMatch, IsNotEscapedByTwoWords) {
  ToyMatch match(config_of(4, SessionMode::rollback), kGoodLine);
  // Its datagrams tell of other states than it does when it is asked.
  match.machine(2).outgoing = [](Channel channel, std::vector<std::uint8_t>& bytes) {
    const auto lie = [](PacketHeader& header) { header.report.chain ^= header.report.frame > kFault ? 4u : 0u; };
    if (channel == Channel::datagram) alter_packet(bytes, lie, NothingAltered{});
  };
  ASSERT_TRUE(match.run_to(kFault + 90, 20 * kSecond));
  for (const std::size_t i : {0u, 1u, 3u}) {
    ASSERT_EQ(match.machine(i).count(Kind::outvoted), 1) << i;
    EXPECT_EQ(match.machine(i).last(Kind::outvoted).player, match.machine(2).seat);
  }
}

// --- the repair ---

/// The cost of one machine's repair to it and the others.
struct Cost {
  Time takes = 0;          // [us] from the wrong frame until it steps the same frames as the others again, and right
  Time worst_gap = 0;      // [us] between two frames of another machine
  Frame delay_change = 0;  // [frames] of another's inputs
};

template <class Game> Cost cost_of_repair(VirtualMatch<Game>& match, std::size_t culprit) {
  Machine<Game>& wrong = match.machine(culprit);
  Time since = 0;
  Cost cost;
  EXPECT_TRUE(match.run_to(kFault - 60, 20 * kSecond));
  PaceWatch<Game> watch(match);
  match.run(20 * kSecond, [&] {
    watch.look();
    if (since == 0 && wrong.newest > kFault) since = match.now();
    const bool is_back = wrong.restarts > 0 && wrong.session.current() + 2 >= match.host().session.current();
    if (cost.takes == 0 && is_back) cost.takes = match.now() - since;
    return cost.takes > 0 && match.now() > since + cost.takes + 4 * kSecond;
  });
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (i == culprit) continue;
    cost.worst_gap = std::max(cost.worst_gap, watch[i].worst());
    cost.delay_change = std::max(cost.delay_change, watch[i].most_delay - watch[i].least_delay);
  }
  return cost;
}

/// Expects that a machine has, after its repair, the states of one process that plays all inputs; the others have them
/// throughout.
template <class Game> void expect_repaired(VirtualMatch<Game>& match, std::size_t culprit) {
  const std::vector<std::uint64_t> straight = match.straight(match.host().end());
  for (std::size_t i = 0; i < match.size(); ++i) {
    SCOPED_TRACE(i);
    Machine<Game>& machine = match.machine(i);
    const int seat = match.machine(culprit).seat;
    EXPECT_TRUE(machine.in_order);
    EXPECT_EQ(machine.count(Kind::repaired), 1);
    EXPECT_EQ(machine.last(Kind::repaired).player, seat);
    EXPECT_EQ(machine.count(Kind::desync), i == culprit ? static_cast<int>(match.size()) - 1 : 1);
    EXPECT_FALSE(machine.heard(Kind::left));
    EXPECT_EQ(machine.restarts, i == culprit ? 1 : 0);
    EXPECT_EQ(machine.session.phase(), SessionPhase::playing);
    const Frame from = i == culprit ? std::max(machine.first, machine.last(Kind::repaired).frame + 1) : 0;
    std::size_t differing = 0;
    for (Frame f = from; f < std::min(machine.end(), match.host().end()); ++f) {
      differing +=
          machine.hashes[static_cast<std::size_t>(f - machine.first)] == straight[static_cast<std::size_t>(f)] ? 0 : 1;
    }
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(machine.end(), from + 120);
    for (Frame f = kFault; f < match.host().end(); ++f) ASSERT_TRUE(match.host().played(f, seat)) << f;
  }
}

constexpr Time kAgain = kSecond;   // [us] until a repaired machine plays again
constexpr Time kNoGap = 50 * kMs;  // [us]
constexpr Frame kSameDelay = 1;    // [frames]

class RepairOf : public testing::TestWithParam<std::tuple<SessionMode, int>> {};
INSTANTIATE_TEST_SUITE_P(Modes, RepairOf,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(3, 4, 8)));

TEST_P(RepairOf, AMachineTakesLessThanASecondAndNobodyNotices) {
  const auto [mode, players] = GetParam();
  ToyMatch match(repairing(players, mode), kGoodLine);
  damage(match.machine(2));
  const Cost cost = cost_of_repair(match, 2);
  RecordProperty("milliseconds", static_cast<int>(cost.takes / kMs));
  EXPECT_GT(cost.takes, 0u);
  EXPECT_LE(cost.takes, kAgain);
  EXPECT_LE(cost.worst_gap, kNoGap);
  EXPECT_LE(cost.delay_change, kSameDelay);
  expect_repaired(match, 2);
}

TEST_P(RepairOf, AMachineGoesOnWhenTheHostsCallerForgetsTheSnapshot) {
  const auto [mode, players] = GetParam();
  ToyMatch match(repairing(players, mode), kGoodLine);
  damage(match.machine(2));
  bool has_forgotten = false;
  match.host().forgets = [&](std::span<const Request<ToyInput>> requests) {
    const auto captures = [](const Request<ToyInput>& request) { return request.kind == RequestKind::capture; };
    if (has_forgotten || std::none_of(requests.begin(), requests.end(), captures)) return false;
    return has_forgotten = true;
  };
  EXPECT_GT(cost_of_repair(match, 2).takes, 0u);
  EXPECT_TRUE(has_forgotten);
  EXPECT_EQ(match.host().count(Kind::misuse), 1);
  EXPECT_FALSE(match.machine(2).heard(Kind::bad_snapshot));
  expect_repaired(match, 2);
}

TEST_P(RepairOf, ABulkyGameTakesLessThanASecondAsWell) {
  const auto [mode, players] = GetParam();
  if (players != 4) return;
  static constexpr std::uint64_t kWords = 16 << 10;  // 128 KB: a world of a hundred bodies
  VirtualMatch<Bulky> match(
      repairing(players, mode), [] { return std::make_unique<Bulky>(kWords); },
      [](int player, Frame frame) { return toy_input(3, player, frame); });
  for (int p = 1; p < players; ++p) match.add(profile(kGoodLine));
  damage(match.machine(1));
  const Cost cost = cost_of_repair(match, 1);
  RecordProperty("milliseconds", static_cast<int>(cost.takes / kMs));
  EXPECT_GT(cost.takes, 0u);
  EXPECT_LE(cost.takes, kAgain);
  EXPECT_LE(cost.worst_gap, kNoGap);
  EXPECT_LE(cost.delay_change, kSameDelay);
  expect_repaired(match, 1);
}

TEST(Repair, OfAMegabyteOverASlowLineTakesAsLongAsItMustAndNobodyNotices) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    SCOPED_TRACE(mode == SessionMode::lockstep ? "lockstep" : "rollback");
    VirtualMatch<Bulky> match(
        repairing(4, mode), [] { return std::make_unique<Bulky>(128 << 10); },
        [](int player, Frame frame) { return toy_input(3, player, frame); });
    for (int p = 1; p < 4; ++p) match.add(profile("latency=30,jitter=5,loss=0.5,rate=200"));
    for (std::size_t i = 0; i < 4; ++i) match.machine(i).slow = 16 * kMs;  // loops of 60 turns a second
    damage(match.machine(2));
    const Cost cost = cost_of_repair(match, 2);
    EXPECT_GT(cost.takes, 5 * kSecond);  // 1 MB at 200 kB/s
    EXPECT_LE(cost.takes, 8 * kSecond);
    // Datagrams wait in the line's queue for a tenth of a second at most: see SnapshotTransfer. In lockstep the machine
    // steps so much later, and who waits for its inputs does so too.
    const bool is_lockstep = mode == SessionMode::lockstep;
    EXPECT_LE(cost.worst_gap, is_lockstep ? 2 * kNoGap : kNoGap);
    EXPECT_LE(cost.delay_change, is_lockstep ? 4 * kSameDelay : 2 * kSameDelay);
    expect_repaired(match, 2);
  }
}

TEST(Repair, OfAMachineWithTwoPlayersKeepsBothSeats) {
  SessionConfig config = repairing(5, SessionMode::rollback), pair = config;
  config.local_players = 1;
  pair.local_players = 2;
  VirtualMatch<Toy> match(
      config, [] { return std::make_unique<Toy>(); },
      [](int player, Frame frame) { return toy_input(3, player, frame); });
  SessionConfig single = config;
  match.add(profile(kGoodLine), pair);
  for (int n = 0; n < 2; ++n) match.add(profile(kGoodLine), single);
  ASSERT_TRUE(match.run_to(60, 20 * kSecond));
  const int first = match.machine(1).session.local_player();
  damage(match.machine(1));
  ASSERT_TRUE(match.run_to(kFault + 180, 20 * kSecond));
  for (std::size_t i = 0; i < match.size(); ++i) {
    EXPECT_EQ(match.machine(i).count(Kind::outvoted), 1) << i;
    EXPECT_EQ(match.machine(i).last(Kind::outvoted).player, first);
    EXPECT_EQ(match.machine(i).count(Kind::repaired), 1) << i;
    EXPECT_FALSE(match.machine(i).heard(Kind::left));
  }
  for (Frame f = kFault; f < match.host().end(); ++f) {
    for (int player = 0; player < 5; ++player) ASSERT_TRUE(match.host().played(f, player)) << player;
  }
  const Frame end = std::min(match.machine(1).end(), match.host().end());
  EXPECT_EQ(match.machine(1).hashes[static_cast<std::size_t>(end - 1 - match.machine(1).first)],
            match.host().hashes[static_cast<std::size_t>(end - 1)]);
}

TEST(Repair, IsTheGamesToAskForWhereNobodyJudges) {
  ToyMatch match(config_of(2, SessionMode::rollback), kGoodLine);
  Machine<Toy>& wrong = match.machine(1);
  damage(wrong);
  EXPECT_FALSE(wrong.session.resync()) << "not in the match yet";
  ASSERT_TRUE(match.run_to(kFault + 60, 20 * kSecond));
  EXPECT_EQ(wrong.restarts, 0);
  EXPECT_FALSE(match.host().session.resync()) << "the host has nobody to ask";
  EXPECT_TRUE(wrong.session.resync());
  EXPECT_FALSE(wrong.session.resync()) << "under way";
  match.pass(3 * kSecond);
  expect_repaired(match, 1);
}

TEST(Repair, OfAMachineThatGoesWrongAgainIsToldAgainAndServedEveryTenSeconds) {
  ToyMatch match(repairing(4, SessionMode::rollback), kGoodLine);
  Machine<Toy>& wrong = match.machine(3);
  // Another program: every hundredth frame it computes something else.
  wrong.tamper = [](Toy& game, Frame frame) {
    if (frame >= kFault && frame % 100 == 0) game.state.places[2] += 1;
  };
  ASSERT_TRUE(match.run_to(kFault, 20 * kSecond));
  match.pass(30 * kSecond);
  EXPECT_GE(wrong.restarts, 3);
  EXPECT_LE(wrong.restarts, 4);
  for (std::size_t i = 0; i < match.size(); ++i) {
    const Machine<Toy>& machine = match.machine(i);
    EXPECT_EQ(machine.count(Kind::repaired, wrong.seat), wrong.restarts) << i;
    EXPECT_GE(machine.count(Kind::outvoted, wrong.seat), wrong.restarts) << i;
    EXPECT_EQ(machine.count(Kind::outvoted), machine.count(Kind::outvoted, wrong.seat));
    EXPECT_EQ(machine.count(Kind::left), 0);
  }
}

TEST(Repair, LeavesTimeToWriteDownWhatWasWrong) {
  ToyMatch match(repairing(3, SessionMode::rollback), kGoodLine);
  Machine<Toy>& wrong = match.machine(1);
  damage(wrong);
  std::size_t seen = 0;
  bool has_wrong_state = false;
  wrong.after_turn = [&] {
    for (; seen < wrong.events.size(); ++seen) {
      if (wrong.events[seen].kind != Kind::outvoted) continue;
      Toy::Snapshot kept = wrong.session.state(kFault + 1);
      has_wrong_state = wrong.restarts == 0 && kept.state.tick == static_cast<std::uint64_t>(kFault) + 1;
    }
  };
  ASSERT_TRUE(match.run_to(kFault + 120, 20 * kSecond));
  EXPECT_EQ(wrong.restarts, 1);
  EXPECT_TRUE(has_wrong_state);
}

TEST(Repair, OfASpectatorFollowsTheHost) {
  ToyMatch match(repairing(3, SessionMode::rollback), kGoodLine);
  SessionConfig config = repairing(3, SessionMode::spectator);
  config.local_players = 0;
  match.pass(kSecond);
  Machine<Toy>& watcher = match.add(profile(kGoodLine), config);
  match.pass(2 * kSecond);
  const int before = watcher.restarts;
  watcher.tamper = [&](Toy& game, Frame frame) {
    if (frame == kFault && watcher.restarts == before) game.state.places[5] ^= 1;
  };
  ASSERT_TRUE(match.run_to(kFault + 200, 20 * kSecond));
  EXPECT_EQ(watcher.restarts, before + 1);
  EXPECT_TRUE(watcher.heard(Kind::repaired));
  EXPECT_EQ(watcher.hashes.back(), match.straight(watcher.end())[static_cast<std::size_t>(watcher.end() - 1)]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(match.machine(i).heard(Kind::desync)) << "whoever watches";
}

TEST(Repair, OfTheHostIsAnotherHost) {
  for (const bool migrates : {true, false}) {
    SCOPED_TRACE(migrates);
    SessionConfig config = repairing(4, SessionMode::rollback);
    if (migrates) config.migration = kSecond;
    ToyMatch match(config, kGoodLine);
    const Machine<Toy>& host = match.host();
    damage(match.host());
    ASSERT_TRUE(match.run_to(kFault, 20 * kSecond));
    match.pass(kSecond);
    for (std::size_t i = 0; i < match.size(); ++i) {
      EXPECT_EQ(match.machine(i).last(Kind::outvoted).player, 0xff);
      EXPECT_FALSE(match.machine(i).heard(Kind::repaired)) << "of a state that is wrong";
    }
    Frame newest = 0;
    for (std::size_t i = 0; i < match.size(); ++i) newest = std::max(newest, match.machine(i).end());
    ASSERT_TRUE(match.run_to(newest + 30, 3 * kSecond));
    match.pass(10 * kSecond);
    EXPECT_EQ(host.session.config().host, !migrates);
    if (!migrates) continue;
    EXPECT_EQ(host.session.phase(), SessionPhase::playing);
    EXPECT_EQ(host.session.local_player(), 0);
    EXPECT_EQ(host.restarts, 1);
    const std::vector<std::uint64_t> straight = match.straight(match.machine(1).end(), 1);
    for (std::size_t i = 1; i < match.size(); ++i) {
      EXPECT_EQ(match.machine(i).restarts, 0);
      EXPECT_EQ(differences(match.machine(i), match.machine(1), straight), 0u);
    }
    ASSERT_GT(host.end(), newest);
    const auto last = static_cast<std::size_t>(std::min(host.end(), match.machine(1).end()) - 1);
    EXPECT_EQ(host.hashes[last - static_cast<std::size_t>(host.first)], straight[last]);
  }
}

// --- liars and joiners ---

class LiarAndJoiner : public testing::TestWithParam<std::tuple<SessionMode, int>> {};
INSTANTIATE_TEST_SUITE_P(Modes, LiarAndJoiner,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(3, 4, 8)));

/// A player's seat opens although one machine, or half of them, tell of other states than they have.
TEST_P(LiarAndJoiner, APlayerIsInWithinTenSeconds) {
  const auto [mode, players] = GetParam();
  for (const int liars : {1, players / 2}) {
    SCOPED_TRACE(liars);
    SessionConfig config = config_of(players, mode), client = config;
    client.local_players = 0;
    VirtualMatch<Toy> match(
        config, [] { return std::make_unique<Toy>(); },
        [](int player, Frame frame) { return toy_input(3, player, frame); });
    for (int p = 1; p < players - 1; ++p) match.add(profile(kGoodLine));
    for (int n = 1; n <= liars && n < players - 1; ++n) {
      match.machine(static_cast<std::size_t>(n)).outgoing = [](Channel channel, std::vector<std::uint8_t>& bytes) {
        const auto lie = [](PacketHeader& header) { header.report.chain ^= 4u; };
        if (channel == Channel::datagram) alter_packet(bytes, lie, NothingAltered{});
      };
    }
    match.run(kSecond, [] { return false; });
    match.host().session.start(match.now());
    match.run(4 * kSecond, [] { return false; });
    Machine<Toy>& joiner = match.add(profile(kGoodLine), client);
    EXPECT_TRUE(match.run(10 * kSecond, [&] { return joiner.session.phase() == SessionPhase::playing; }));
  }
}

}  // namespace resync_test
}  // namespace isostep::test
