// Callers that do otherwise than the examples: slow loops, clocks that waver, requests that are dropped, wrong numbers.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace caller_test {

SessionConfig config_of(int players) {
  SessionConfig config;
  config.players = players;
  return config;
}
VirtualMatch<Toy> toy_match(const SessionConfig& config) {
  return VirtualMatch<Toy>(
      config, [] { return std::make_unique<Toy>(); },
      [](int player, Frame frame) { return toy_input(3, player, frame); });
}

TEST(Caller, WhoTurnsOnceAFrameStillCatchesUp) {
  for (const Time turn : {Time{16000}, Time{33000}}) {
    SCOPED_TRACE(turn);
    VirtualMatch<Toy> match = toy_match(config_of(3));
    match.add(profile("lan"));
    match.run(kSecond, [] { return false; });
    match.host().session.start(match.now());
    ASSERT_TRUE(match.run_to(600, 20 * kSecond));
    Machine<Toy>& joiner = match.add(profile("lan"));
    joiner.slow = turn;
    ASSERT_TRUE(match.run(12 * kSecond, [&] { return joiner.session.phase() == SessionPhase::playing; }));
    ASSERT_TRUE(match.run_to(match.host().end() + 120, 10 * kSecond));
    expect_one_history(match);
  }
}

TEST(Caller, AHostThatPlaysAloneBeginsAtOnce) {
  SessionConfig config = config_of(2);
  config.local_players = 2;
  VirtualMatch<Toy> match = toy_match(config);
  EXPECT_TRUE(match.run_to(60, 3 * kSecond));
  EXPECT_TRUE(match.host().heard(SessionEvent::Kind::started));
}

TEST(Caller, AStartBeforeTheFirstTurnIsRemembered) {
  VirtualMatch<Toy> match = toy_match(config_of(2));
  match.host().session.start(0);
  EXPECT_TRUE(match.run_to(60, 3 * kSecond));
}

TEST(Caller, AClockThatStepsBackChangesNothing) {
  VirtualMatch<Toy> match = toy_match(config_of(2));
  Machine<Toy>& client = match.add(profile("wifi"));
  Pcg32 random = Pcg32::seeded(5);
  for (std::size_t i = 0; i < 2; ++i) {
    Machine<Toy>& machine = match.machine(i);
    // Between its turns each machine is asked with times from up to 50 ms ago.
    machine.after_turn = [&machine, &match, &random] {
      const Time back = random_below(random, 50000);
      const Time then = match.now() > back ? match.now() - back : 0;
      drive(machine.session, *machine.game, then, machine);
    };
  }
  ASSERT_TRUE(match.run_to(600, 20 * kSecond));
  EXPECT_FALSE(client.heard(SessionEvent::Kind::lost_host));
  EXPECT_FALSE(match.host().heard(SessionEvent::Kind::left));
  expect_one_history(match);
}

/// The frames that one machine alone confirmed.
struct Diary {
  const Session<Toy>& session;
  std::vector<ToyInput> inputs;
  std::vector<std::uint64_t> hashes;
  void confirmed(Frame frame, std::uint64_t hash) {
    inputs.push_back(session.input(frame, 0));
    hashes.push_back(hash);
  }
};

TEST(Caller, DroppedRequestsAreToldAndMadeGood) {
  SessionConfig config = config_of(1);
  config.host = true;
  config.seed = 1;
  Session<Toy> session(config);
  Toy game;
  Diary diary{session, {}, {}};
  int misuses = 0;
  bool dropped = false;
  for (Time now = 0; now < 5 * kSecond && diary.hashes.size() < 100; now += 5000) {
    session.add_local_input(0, toy_input(3, 0, session.current()));
    if (session.current() % 30 == 7 && session.wait(now) == 0) {
      dropped = !session.advance(now).empty() || dropped;  // and nothing of it is done
      continue;
    }
    drive(session, game, now, diary);
    while (const auto event = session.poll_event()) misuses += event->kind == SessionEvent::Kind::misuse ? 1 : 0;
  }
  EXPECT_TRUE(dropped);
  EXPECT_GE(misuses, 1);
  ASSERT_GE(diary.hashes.size(), 100u) << "the match goes on";
  Toy straight;
  for (std::size_t frame = 0; frame < diary.hashes.size(); ++frame) {
    const InputStatus status = InputStatus::confirmed;
    straight.step({{&diary.inputs[frame], 1}, {&status, 1}});
    ASSERT_EQ(straight.hash(), diary.hashes[frame]) << frame;
  }
}

/// Whatever step of the host's throws, also that of the turn in which the state for a joiner was to be written: the
/// joiner is in the match soon, by the right state.
TEST(Caller, AStepOfTheHostThatThrowsKeepsNoJoinerOut) {
  struct Thrown {};
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    for (int nth = 1; nth < 30; ++nth) {
      SCOPED_TRACE(nth);
      SessionConfig config = config_of(2);
      config.mode = mode;
      config.history = 200;
      VirtualMatch<Toy> match = toy_match(config);
      match.run(kSecond, [] { return false; });
      match.host().session.start(match.now());
      ASSERT_TRUE(match.run_to(300, 20 * kSecond));
      int steps = 0;
      match.host().slow = kSecond / 60;  // a step in every turn
      match.host().will_step = [&](Frame) {
        if (++steps == nth) throw Thrown{};
      };
      Machine<Toy>& joiner = match.add(profile("lan"));
      const auto plays = [&] { return joiner.session.phase() == SessionPhase::playing; };
      const Time until = match.now() + 5 * kSecond;
      while (!plays() && match.now() < until) {
        try {
          match.run(until - match.now(), plays);
        } catch (const Thrown&) {}
      }
      ASSERT_TRUE(plays());
      ASSERT_GE(steps, nth);
      ASSERT_TRUE(match.run_to(match.host().end() + 60, 10 * kSecond));
      EXPECT_FALSE(joiner.heard(SessionEvent::Kind::bad_snapshot) || joiner.heard(SessionEvent::Kind::refused));
      for (std::size_t i = 0; i < 2; ++i) EXPECT_FALSE(match.machine(i).heard(SessionEvent::Kind::desync));
    }
  }
}

TEST(Caller, FramesAndPlayersThatAreNotThereHaveNeutralInputs) {
  VirtualMatch<Toy> match = toy_match(config_of(2));
  match.add(profile("lan"));
  ASSERT_TRUE(match.run_to(200, 10 * kSecond));
  const Session<Toy>& session = match.host().session;
  for (const Frame frame : {Frame{-1}, Frame{0}, session.current(), session.current() + 5, kLastFrame}) {
    EXPECT_EQ(session.input(frame, 0), ToyInput{}) << frame;
    EXPECT_EQ(session.status(frame, 0), InputStatus::disconnected) << frame;
  }
  for (const int player : {-1, 2, 1000}) EXPECT_EQ(session.input(session.current() - 1, player), ToyInput{});
}

/// Half a kilobyte of input in every frame.
struct LongInput {
  std::uint32_t words[125] = {};
  friend bool operator==(const LongInput& a, const LongInput& b) {
    for (int i = 0; i < 125; ++i) {
      if (a.words[i] != b.words[i]) return false;
    }
    return true;
  }
  ISO_FIELDS(words)
};
struct LongGame {
  using Input = LongInput;
  struct Snapshot {
    std::uint64_t sum = 0;
  };
  std::uint64_t sum = 0;
  void step(InputView<LongInput> inputs) {
    for (const LongInput& input : inputs.values) {
      for (const std::uint32_t word : input.words) sum = sum * 6364136223846793005u + word;
    }
  }
  void save(Snapshot& to) const { to.sum = sum; }
  void load(const Snapshot& from) { sum = from.sum; }
  std::uint64_t hash() const { return sum; }
};

/// [us] that 600 frames take over a line that loses bursts, as this seed draws them.
Time time_of_long_inputs(std::uint64_t seed) {
  VirtualMatch<LongGame> match(
      config_of(2), [] { return std::make_unique<LongGame>(); },
      [](int player, Frame frame) {
        LongInput input;
        Pcg32 random = Pcg32::seeded(static_cast<std::uint64_t>(frame), static_cast<std::uint64_t>(player));
        for (std::uint32_t& word : input.words) word = random.next();
        return input;
      },
      seed);
  match.add(profile("wifi"));
  EXPECT_TRUE(match.run_to(60, 10 * kSecond));
  const Time before = match.now();
  EXPECT_TRUE(match.run_to(660, 20 * kSecond));
  EXPECT_EQ(match.network().oversized(), 0u);
  return match.now() - before;
}

// One match may be unlucky: a burst stands for as long as its inputs take to be acknowledged again.
TEST(Caller, LongInputsKeepUpWithTheirFrames) {
  constexpr std::uint64_t kMatches = 40;
  Time sum = 0;
  for (std::uint64_t seed = 1; seed <= kMatches; ++seed) {
    const Time time = time_of_long_inputs(seed);
    EXPECT_LT(time, 12 * kSecond) << seed;
    sum += time;
  }
  EXPECT_LT(sum / kMatches, 11 * kSecond) << "600 frames are ten seconds";
}

TEST(Caller, ARestartedProcessProvesByItsTokenWhoItWas) {
  VirtualMatch<Toy> match = toy_match(config_of(2));
  Machine<Toy>& first = match.add(profile("lan"));
  ASSERT_TRUE(match.run_to(120, 10 * kSecond));
  const std::uint64_t token = first.session.token();
  ASSERT_NE(token, 0u);
  first.plays = false;
  match.network().set_silent(first.endpoint, true);  // a crash: the host does not know yet

  SessionConfig config = config_of(2);
  config.local_players = 0;
  Machine<Toy>& stranger = match.add(profile("lan"), config);
  ASSERT_TRUE(match.run(kSecond, [&] { return stranger.heard(SessionEvent::Kind::refused); }));
  EXPECT_EQ(stranger.last(SessionEvent::Kind::refused).field.key.view(), "seats");
  stranger.plays = false;

  config.token = token;
  Machine<Toy>& second = match.add(profile("lan"), config);
  ASSERT_TRUE(match.run(4 * kSecond, [&] { return second.session.phase() == SessionPhase::playing; }));
  EXPECT_EQ(second.session.local_player(), 1);
}

}  // namespace caller_test
}  // namespace isostep::test
