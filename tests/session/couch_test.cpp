// Several players on one client: they come, play, go and come back together, each with inputs of its own.
// SPDX-License-Identifier: MIT
#include <bit>

#include "session/pace_watch.hpp"

namespace isostep::test {
namespace couch_test {

using Kind = SessionEvent::Kind;
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr std::uint32_t kHosts = 0b00011, kCouch = 0b01100, kSingle = 0b10000;

/// The player's number and the frame: no two players say the same.
ToyInput word_of(int player, Frame frame) {
  return {static_cast<std::int8_t>(player + 1), 0, static_cast<std::uint16_t>(frame)};
}

/// Two players at the host, two on one client, one on another.
struct CouchMatch : VirtualMatch<Toy> {
  explicit CouchMatch(SessionMode mode, Time migration = 0, std::uint64_t seed = 1)
      : VirtualMatch(
            config_for(mode, migration), [] { return std::make_unique<Toy>(40); }, word_of, seed) {}

  static SessionConfig config_for(SessionMode mode, Time migration) {
    SessionConfig config = config_of(5, mode);
    config.local_players = 2;
    config.migration = migration;
    return config;
  }
  SessionConfig of(int seats) {
    SessionConfig config = config_for(host().session.config().mode, host().session.config().migration);
    config.local_players = seats;
    return config;
  }
  Machine<Toy>& come(int seats) {
    Machine<Toy>& machine = add(profile(kGoodLine), of(seats));
    machine.returns = true;
    pass(kSecond / 5);  // who comes first has the first seats
    return machine;
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  /// All five did something of their own in each of the newest frames.
  void expect_all_play(const Machine<Toy>& machine, Frame frames = 30) {
    ASSERT_GT(machine.end() - machine.first, frames);
    for (Frame frame = machine.end() - frames; frame < machine.end(); ++frame) {
      for (int p = 0; p < 5; ++p) {
        const auto& said = machine.at(frame)[static_cast<std::size_t>(p)];
        ASSERT_FALSE(said.absent) << p << " in " << frame;
        ASSERT_EQ(said.input.push, p + 1) << "said by another";
      }
    }
  }
};

class Couch : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Couch, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Couch, EverySeatOfAMachinePlays) {
  CouchMatch match(GetParam());
  match.come(2);
  match.come(1);
  match.pass(10 * kSecond);
  const std::uint32_t seats[] = {kHosts, kCouch, kSingle};
  for (std::size_t i = 0; i < 3; ++i) {
    const Machine<Toy>& machine = match.machine(i);
    EXPECT_EQ(machine.session.local_players(), seats[i]);
    EXPECT_EQ(machine.session.local_player(), std::countr_zero(seats[i]));
    EXPECT_EQ(machine.session.phase(), SessionPhase::playing);
    EXPECT_GT(machine.end(), 500);
    match.expect_all_play(machine);
  }
  EXPECT_FALSE(match.host().session.add_local_input(2, {}));
  EXPECT_FALSE(match.machine(1).session.add_local_input(4, {}));
  EXPECT_EQ(match.host().session.peer_of(2), match.host().session.peer_of(3));
  EXPECT_NE(match.host().session.peer_of(2), match.host().session.peer_of(4));
  expect_one_history(match);
}

TEST_P(Couch, JoinsLateInOneFrame) {
  CouchMatch match(GetParam());
  match.come(1);
  match.pass(kSecond);
  match.host().session.start(match.now());
  match.pass(4 * kSecond);
  Machine<Toy>& couch = match.come(2);
  match.pass(10 * kSecond);
  EXPECT_EQ(std::popcount(couch.session.local_players()), 2);
  for (std::size_t i = 0; i < 3; ++i) {
    match.expect_all_play(match.machine(i));
    const Machine<Toy>& machine = match.machine(i);
    EXPECT_EQ(machine.last(Kind::joined, 3).frame, machine.last(Kind::joined, 4).frame);
    EXPECT_GT(machine.last(Kind::joined, 3).frame, 200);
  }
  expect_one_history(match);
}

TEST_P(Couch, ComesBackToAllOfItsSeats) {
  for (const Time away : {kSecond, 30 * kSecond}) {
    CouchMatch match(GetParam());
    Machine<Toy>& couch = match.come(2);
    match.come(1);
    match.pass(5 * kSecond);
    couch.returns = false;
    match.network().cut(couch.endpoint);
    match.pass(away);
    Machine<Toy>& stranger = match.add(profile(kGoodLine), match.of(1));  // its seats are kept
    match.pass(kSecond);
    EXPECT_EQ(stranger.session.phase(), SessionPhase::refused);
    match.network().connect(couch.endpoint);
    match.pass(10 * kSecond);
    EXPECT_EQ(couch.session.local_players(), kCouch);
    for (std::size_t i = 0; i < 3; ++i) {
      const Machine<Toy>& machine = match.machine(i);
      match.expect_all_play(machine);
      // Each left and came once, for who was sent a snapshot as well.
      for (const int p : {2, 3}) EXPECT_EQ(machine.count(Kind::left, p), 1) << p << " at " << i;
      EXPECT_EQ(machine.last(Kind::joined, 2).frame, machine.last(Kind::joined, 3).frame);
      SCOPED_TRACE(i);
      EXPECT_EQ(differences(machine, match.host(), match.straight(match.host().end())), 0u);
    }
  }
}

TEST_P(Couch, ANewProcessHasTheSeatsByItsToken) {
  CouchMatch match(GetParam());
  Machine<Toy>& former = match.come(2);
  match.come(1);
  match.pass(5 * kSecond);
  former.plays = false;
  match.network().set_silent(former.endpoint, true);
  SessionConfig config = match.of(2);
  config.token = former.session.token();
  Machine<Toy>& again = match.add(profile(kGoodLine), config);
  match.pass(10 * kSecond);
  EXPECT_EQ(again.session.local_players(), kCouch);
  match.expect_all_play(match.host());
  // With one pad less it has the first of them, and the other one is free.
  config.token = again.session.token();
  config.local_players = 1;
  again.plays = false;
  Machine<Toy>& fewer = match.add(profile(kGoodLine), config);
  match.pass(5 * kSecond);
  EXPECT_EQ(fewer.session.local_players(), 0b00100u);
  Machine<Toy>& other = match.come(1);
  match.pass(5 * kSecond);
  EXPECT_EQ(other.session.local_players(), 0b01000u);
  match.expect_all_play(match.host());
}

TEST_P(Couch, HasAllSeatsOrNone) {
  CouchMatch match(GetParam());
  match.come(1);
  match.come(1);
  Machine<Toy>& couch = match.come(2);
  match.pass(2 * kSecond);
  EXPECT_EQ(couch.session.phase(), SessionPhase::refused);
  EXPECT_EQ(couch.last(Kind::refused).field.key.view(), "seats");
  EXPECT_EQ(couch.last(Kind::refused).field.in_file.view(), "one more");
  SessionConfig config = match.of(2);
  config.seat = 3;  // and 4: one is there, the other one is not
  EXPECT_EQ(match.add(profile(kGoodLine), config).session.local_players(), 0u);
  match.pass(kSecond);
  EXPECT_EQ(match.machine(4).last(Kind::refused).field.key.view(), "seat");
  EXPECT_FALSE(match.host().session.peer_of(4).has_value());
}

TEST_P(Couch, IsKickedWhole) {
  CouchMatch match(GetParam());
  Machine<Toy>& couch = match.come(2);
  match.come(1);
  match.pass(5 * kSecond);
  couch.returns = false;
  EXPECT_TRUE(match.host().session.kick(3, "rude"));
  match.pass(3 * kSecond);
  EXPECT_EQ(couch.session.phase(), SessionPhase::refused);
  EXPECT_EQ(couch.last(Kind::refused).field.key.view(), "kicked");
  for (const int p : {2, 3}) {
    EXPECT_EQ(match.host().count(Kind::left, p), 1);
    EXPECT_EQ(match.machine(2).last(Kind::left, p).frame, match.host().last(Kind::left, p).frame);
  }
  match.come(2);
  match.pass(10 * kSecond);
  match.expect_all_play(match.host());  // the seats were free
  EXPECT_EQ(match.machine(3).session.local_players(), kCouch);
  expect_one_history(match);
}

TEST_P(Couch, IsLeftOutTogetherWhenItStalls) {
  CouchMatch match(GetParam());
  Machine<Toy>& couch = match.come(2);
  match.come(1);
  match.pass(6 * kSecond);
  match.network().set_silent(couch.endpoint, true);
  match.pass(6 * kSecond);
  match.network().set_silent(couch.endpoint, false);
  match.pass(10 * kSecond);
  const Frame left = match.host().last(Kind::left, 2).frame;
  EXPECT_NE(left, kNoFrame);
  EXPECT_LE(std::abs(match.host().last(Kind::left, 3).frame - left), 2);
  match.pass(70 * kSecond);
  match.expect_all_play(match.host());
  expect_one_history(match, true);
}

TEST_P(Couch, FollowsAHostThatDies) {
  CouchMatch match(GetParam(), kSecond);
  match.come(2);
  match.come(1);
  match.pass(8 * kSecond);
  match.host().plays = false;
  match.network().set_silent(match.host().endpoint, true);
  match.pass(5 * kSecond);
  Machine<Toy>&couch = match.machine(1), &single = match.machine(2);
  EXPECT_TRUE(couch.session.config().host) << "the first seat of a client is its";
  EXPECT_EQ(couch.session.local_players(), kCouch);
  for (const Machine<Toy>* machine : {&couch, &single}) {
    EXPECT_EQ(machine->session.phase(), SessionPhase::playing);
    EXPECT_GT(machine->end(), 8 * 60 + 60);
    for (const int p : {2, 3, 4}) EXPECT_TRUE(machine->played(machine->end() - 1, p)) << p;
    for (const int p : {0, 1}) EXPECT_FALSE(machine->played(machine->end() - 1, p)) << p;
    EXPECT_EQ(differences(*machine, couch, match.straight(couch.end(), 1)), 0u);
    expect_sound_machine(*machine, true);
  }
}

TEST_P(Couch, AnOldHostKeepsAllOfItsPlayers) {
  CouchMatch match(GetParam(), kSecond);
  match.come(2);
  match.come(1);
  match.pass(8 * kSecond);
  match.host().plays = false;
  match.pass(4 * kSecond);
  match.host().plays = true;
  match.pass(12 * kSecond);
  EXPECT_EQ(match.host().count(Kind::deposed), 1);
  EXPECT_EQ(match.host().session.local_players(), kHosts);
  EXPECT_EQ(match.host().session.phase(), SessionPhase::playing);
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    const Machine<Toy>& machine = match.machine(i);
    match.expect_all_play(machine);
    EXPECT_TRUE(i == 0 || differences(machine, match.machine(1), match.straight(match.machine(1).end(), 1)) == 0);
    expect_sound_machine(machine, true);
  }
}

TEST_P(Couch, PlaysUnderADeadline) {
  SessionConfig config = CouchMatch::config_for(GetParam(), 0);
  config.deadline = 8;
  VirtualMatch<Toy> match(
      config, [] { return std::make_unique<Toy>(); }, word_of);
  match.add(profile(kGoodLine), config).returns = true;
  config.local_players = 1;
  match.add(profile(kGoodLine), config).returns = true;
  match.run(10 * kSecond, [] { return false; });
  EXPECT_GT(match.host().end(), 500);
  for (int p = 0; p < 5; ++p) EXPECT_TRUE(match.host().played(match.host().end() - 1, p));
  for (int p = 2; p < 5; ++p) EXPECT_EQ(match.host().session.stats().players[p].replaced, 0u) << p;
  expect_one_history(match);
}

}  // namespace couch_test
}  // namespace isostep::test
