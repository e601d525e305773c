// Hosts that sleep, lose their line, are left alone or are too slow: one match goes on, and no frame is final twice.
// SPDX-License-Identifier: MIT
#include <map>

#include "session/match_checks.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace one_history_test {

using Kind = SessionEvent::Kind;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

SessionConfig migrating(int players, SessionMode mode = SessionMode::rollback, Time migration = kSecond) {
  SessionConfig config = config_of(players, mode);
  config.migration = migration;
  return config;
}

/// A match that remembers what every machine was told as final, also those that are gone.
struct Watched : ToyMatch {
  explicit Watched(const SessionConfig& config) : ToyMatch(config, kGoodLine) {
    for (std::size_t i = 0; i < size(); ++i) watch(i);
  }
  void watch(std::size_t i) {
    machine(i).keeps = false;
    machine(i).was_confirmed = [this](Frame frame, std::uint64_t hash) {
      newest = std::max(newest, frame);
      twice += said.emplace(frame, hash).first->second == hash ? 0 : 1;
    };
  }
  /// Its process is gone.
  std::uint64_t kill(std::size_t i) {
    machine(i).plays = false;
    network().set_silent(machine(i).endpoint, true);
    return machine(i).session.token();
  }
  /// It ends its connections first, as a program does that is closed.
  std::uint64_t leave(std::size_t i) {
    for (PeerId peer = 0; peer < 16; ++peer) machine(i).port.disconnect(peer);
    machine(i).plays = false;
    return machine(i).session.token();
  }
  /// A new process with that token asks at `home`.
  std::size_t come_back(std::uint64_t token, std::size_t home) {
    SessionConfig config = machine(0).session.config();
    config.host = false;
    config.local_players = 0;
    config.token = token;
    config.address = Address{};
    Machine<Toy>& its = add(profile(kGoodLine), config, machine(home).endpoint);
    its.returns = true;
    watch(size() - 1);
    return size() - 1;
  }
  std::vector<std::size_t> hosts() {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < size(); ++i) {
      if (machine(i).plays && machine(i).session.config().host) found.push_back(i);
    }
    return found;
  }
  int playing() {
    int count = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      count += machine(i).plays && machine(i).session.phase() == SessionPhase::playing ? 1 : 0;
    }
    return count;
  }
  void expect_goes_on() {
    const Frame before = newest;
    pass(2 * kSecond);
    EXPECT_GT(newest, before + 60);
    EXPECT_EQ(hosts().size(), 1u);
    EXPECT_EQ(twice, 0);
  }
  std::map<Frame, std::uint64_t> said;
  Frame newest = 0;
  int twice = 0;  // frames that were told with another hash before
};

TEST(OneHistory, OfASleeperWhomAProcessWithoutMemoryFinds) {
  for (const bool successor_restarts : {true, false}) {
    SCOPED_TRACE(successor_restarts);
    Watched match(migrating(4));
    match.pass(6 * kSecond);
    match.machine(0).plays = false;
    match.pass(4 * kSecond);
    ASSERT_EQ(match.hosts().size(), 1u);
    const std::size_t successor = match.hosts()[0];
    const std::size_t dies = successor_restarts ? successor : (successor == 3 ? 2 : 3);
    const std::uint64_t token = match.kill(dies);
    match.pass(300 * kMs);
    match.come_back(token, 0);
    match.pass(1500 * kMs);
    match.machine(0).plays = true;
    match.pass(20 * kSecond);
    match.expect_goes_on();
  }
}

TEST(OneHistory, OfAHostWhoseCableIsPulled) {
  for (const Frame deadline : {0, 8}) {
    for (const Time migration : {kSecond / 2, kSecond, 3 * kSecond}) {
      for (const int players : {3, 5}) {
        SessionConfig config = migrating(players, SessionMode::rollback, migration);
        config.deadline = deadline;
        Watched match(config);
        match.pass(6 * kSecond);
        match.network().set_side(0, 1);
        match.pass(8 * kSecond);
        match.network().set_side(0, 0);
        match.pass(10 * kSecond);
        SCOPED_TRACE(std::to_string(deadline) + " " + std::to_string(migration) + " " + std::to_string(players));
        match.expect_goes_on();
      }
    }
  }
}

TEST(OneHistory, OfAHostThatIsHeardNoMoreButHears) {
  for (const Frame deadline : {0, 8}) {
    SessionConfig config = migrating(3);
    config.deadline = deadline;
    Watched match(config);
    match.pass(6 * kSecond);
    for (std::size_t i : {1, 2}) {
      match.network().set_profile(match.machine(i).endpoint, profile("latency=30,jitter=5,down.loss=100"));
    }
    match.pass(3 * kSecond);
    for (std::size_t i : {1, 2}) match.network().set_profile(match.machine(i).endpoint, profile(kGoodLine));
    match.pass(10 * kSecond);
    match.expect_goes_on();
  }
}

TEST(Alone, AHostWhomTheMajorityLeavesPlaysOnAndTakesThemBack) {
  for (const int players : {3, 4, 8}) {
    SCOPED_TRACE(players);
    Watched match(migrating(players));
    match.pass(6 * kSecond);
    std::vector<std::uint64_t> tokens;
    const auto stays = static_cast<std::size_t>(players == 8 ? 3 : 1);
    for (std::size_t i = stays; i < static_cast<std::size_t>(players); ++i) tokens.push_back(match.leave(i));
    match.pass(5 * kSecond);
    EXPECT_FALSE(match.host().heard(Kind::deposed));
    match.expect_goes_on();
    std::vector<std::uint8_t> saved;
    EXPECT_TRUE(match.host().session.save_match(*match.host().game, saved).ok());
    for (const std::uint64_t token : tokens) match.come_back(token, 0);
    match.pass(12 * kSecond);
    EXPECT_EQ(match.playing(), players);
    match.expect_goes_on();
  }
}

TEST(Alone, WhoDiedAndReturnsFormsTheMatchAnew) {
  for (const Time away : {kSecond, 3 * kSecond, 15 * kSecond}) {
    SCOPED_TRACE(away);
    Watched match(migrating(3));
    match.pass(6 * kSecond);
    const std::uint64_t tokens[] = {match.kill(1), match.kill(2)};
    match.pass(away);
    match.come_back(tokens[0], 0);
    match.pass(kSecond);
    EXPECT_TRUE(match.playing() <= 1) << "the other may have a match of its own";
    match.come_back(tokens[1], 0);
    match.pass(30 * kSecond);
    EXPECT_EQ(match.playing(), 3);
    match.expect_goes_on();
  }
}

TEST(Alone, TheGameMayGoOnWithThoseWhoAreHere) {
  Watched match(migrating(5));
  match.pass(6 * kSecond);
  EXPECT_FALSE(match.host().session.go_on(match.now())) << "all are here";
  for (const std::size_t i : {2, 3, 4}) match.kill(i);
  match.pass(1500 * kMs);
  const Frame stood = match.newest;
  EXPECT_TRUE(match.host().session.go_on(match.now()));
  match.pass(5 * kSecond);
  EXPECT_GT(match.newest, stood + 60);
  EXPECT_EQ(match.playing(), 2);
  match.expect_goes_on();
  // Likewise long after it was lost.
  match.kill(1);
  match.pass(10 * kSecond);
  match.expect_goes_on();

  Watched lost(migrating(3));
  lost.pass(6 * kSecond);
  lost.kill(1);
  lost.kill(2);
  lost.pass(20 * kSecond);
  EXPECT_EQ(lost.host().session.phase(), SessionPhase::lost);
  EXPECT_TRUE(lost.host().session.go_on(lost.now()));
  lost.pass(2 * kSecond);
  lost.expect_goes_on();
}

/// The loop of the host comes round so many times in ten seconds.
void slow_down(Watched& match, Time in_ten_seconds) { match.machine(0).slow = 10 * kSecond / in_ten_seconds; }

TEST(SlowHost, IsNamedWithinASecond) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    for (const Time turns : {80, 100, 120, 150, 200, 250}) {
      SCOPED_TRACE(turns);
      Watched match(config_of(2, mode));
      match.pass(6 * kSecond);
      slow_down(match, turns);
      match.pass(kSecond);
      EXPECT_EQ(match.machine(1).last(Kind::slowed_by).player, 0);
      match.machine(0).slow = 0;
      match.pass(5 * kSecond);
      EXPECT_TRUE(match.machine(1).heard(Kind::full_speed));
    }
  }
}

TEST(SlowHost, HandsOverWithinFiveSecondsAndThePlayersStay) {
  for (const Time turns : {8, 10, 11, 15, 20, 40, 100, 150}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(turns);
      Watched match(migrating(4));
      match.pass((10 + seed) * kSecond + seed * 7 * kMs);
      slow_down(match, turns);
      match.pass(5 * kSecond);
      for (const std::size_t i : {1, 2, 3}) EXPECT_TRUE(match.machine(i).heard(Kind::new_host)) << i;
      match.pass(20 * kSecond);
      for (const std::size_t i : {1, 2, 3}) {
        EXPECT_EQ(match.machine(i).session.phase(), SessionPhase::playing) << i;
        EXPECT_FALSE(match.machine(1).heard(Kind::left, match.machine(i).session.local_player())) << i;
      }
      EXPECT_EQ(match.twice, 0);
      EXPECT_EQ(match.hosts().size(), 1u);
    }
  }
}

TEST(SlowHost, StaysWhereNobodyIsFaster) {
  Watched match(migrating(3));
  for (std::size_t i = 0; i < 3; ++i) match.machine(i).step_time = kSecond / 30;
  match.pass(20 * kSecond);
  EXPECT_TRUE(match.machine(0).session.config().host);
}

TEST(SlowHost, IsNoneForOneHitch) {
  for (const Time hitch : {300 * kMs, 600 * kMs}) {
    Watched match(migrating(4));
    match.pass(6 * kSecond);
    match.hitch(0, hitch);
    match.pass(5 * kSecond);
    EXPECT_TRUE(match.machine(0).session.config().host);
    EXPECT_FALSE(match.machine(1).heard(Kind::slowed_by));
  }
}

TEST(Settings, OfTheFirstHostAreItsSuccessors) {
  SessionConfig config = migrating(5);
  Watched match(config);
  match.pass(6 * kSecond);
  EXPECT_EQ(match.machine(1).session.config().deadline, 0);

  SessionConfig strict = config;
  strict.players = 5;
  strict.deadline = 8;
  strict.votes = strict.asks_admission = strict.players_set_tempo = true;
  strict.patience = 3 * kSecond;
  strict.reservation = 90 * kSecond;
  VirtualMatch<Toy> other(
      strict, [] { return std::make_unique<Toy>(); },
      [](int player, Frame frame) { return toy_input(2, player, frame); });
  int let_in = 0;
  other.host().after_turn = [&] {
    while (const auto applicant = other.host().session.poll_applicant()) {
      if (++let_in <= 3) other.host().session.admit(applicant->id);
      else other.host().session.refuse(applicant->id, "not invited");
    }
  };
  config.local_players = 0;
  for (int p = 1; p < 4; ++p) other.add(profile(kGoodLine), config);
  other.run(kSecond, [] { return false; });
  other.host().session.start(other.now());
  other.run(6 * kSecond, [] { return false; });
  ASSERT_EQ(let_in, 3);
  other.host().plays = false;
  other.network().set_silent(other.host().endpoint, true);
  other.run(4 * kSecond, [] { return false; });
  std::size_t next = 0;
  for (std::size_t i = 1; i < 4; ++i) next = other.machine(i).session.config().host ? i : next;
  ASSERT_NE(next, 0u);
  const SessionConfig& its = other.machine(next).session.config();
  EXPECT_EQ(its.deadline, 8);
  EXPECT_TRUE(its.votes && its.asks_admission && its.players_set_tempo);
  EXPECT_EQ(its.patience, strict.patience);
  EXPECT_EQ(its.reservation, strict.reservation);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(other.machine(i).session.phase(), SessionPhase::playing) << i;
  Machine<Toy>& stranger = other.add(profile(kGoodLine), config, other.machine(next).endpoint);
  other.run(3 * kSecond, [] { return false; });
  EXPECT_EQ(stranger.session.local_player(), -1);
  const auto applicant = other.machine(next).session.poll_applicant();
  ASSERT_TRUE(applicant.has_value());
  EXPECT_TRUE(other.machine(next).session.refuse(applicant->id, "not invited"));
}

TEST(Settings, WhoHasAnotherMigrationIsRefusedByThatName) {
  for (const Time migration : {Time{0}, 2 * kSecond}) {
    SessionConfig config = migrating(3);
    VirtualMatch<Toy> match(
        config, [] { return std::make_unique<Toy>(); },
        [](int player, Frame frame) { return toy_input(2, player, frame); });
    config.migration = migration;
    config.local_players = 0;
    Machine<Toy>& other = match.add(profile(kGoodLine), config);
    match.run(2 * kSecond, [] { return false; });
    EXPECT_EQ(other.session.phase(), SessionPhase::refused);
    EXPECT_EQ(other.last(Kind::refused).field.key.view(), "migration");
  }
}

}  // namespace one_history_test
}  // namespace isostep::test
