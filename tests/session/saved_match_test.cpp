// A match is saved by its host, and another process goes on with it: the same frame, the same seats, nobody absent.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"
#include "session/recorded_play.hpp"

namespace isostep::test {
namespace saved_match_test {

using Kind = SessionEvent::Kind;
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

struct Match : VirtualMatch<Toy> {
  Match(const SessionConfig& config, std::uint64_t seed)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(40); },
            [seed](int player, Frame frame) { return toy_input(seed, player, frame); }, seed) {}
  void pass(Time time) {
    run(time, [] { return false; });
  }
};

/// One player at the host, two on one client, one on another.
class SavedMatches : public testing::TestWithParam<SessionMode> {
 protected:
  SavedMatches() : before(config_of(4, GetParam()), 1) {
    for (const int seats : {2, 1}) {
      before.add(profile(kGoodLine), client(seats)).returns = true;
      before.pass(kSecond / 5);
    }
    before.pass(6 * kSecond);
  }
  static SessionConfig client(int seats, std::uint64_t token = 0) {
    SessionConfig config = config_of(4, GetParam());
    config.local_players = seats;
    config.token = token;
    return config;
  }
  std::vector<std::uint8_t> save() {
    std::vector<std::uint8_t> bytes;
    const Machine<Toy>& host = before.host();
    const std::uint64_t hash = host.game->hash();
    EXPECT_TRUE(before.host().session.save_match(*before.host().game, bytes).ok());
    EXPECT_EQ(host.game->hash(), hash) << "the game is where it was";
    return bytes;
  }
  std::unique_ptr<Match> resume(const std::vector<std::uint8_t>& bytes, std::uint64_t seed = 2) {
    SessionConfig config = config_of(4, GetParam());
    config.saved_match = bytes;
    return std::make_unique<Match>(config, seed);
  }
  /// Every hash of the match that goes on is that of one process that plays what was played before, and since.
  void expect_one_match(Match& after, Frame start) {
    Toy game(40);
    const auto step = [&](const std::vector<Machine<Toy>::Said>& said) {
      std::vector<ToyInput> inputs;
      std::vector<InputStatus> statuses;
      for (const auto& one : said) {
        inputs.push_back(one.input);
        statuses.push_back(one.absent ? InputStatus::disconnected : InputStatus::confirmed);
      }
      game.step({inputs, statuses});
    };
    for (Frame frame = 0; frame < start; ++frame) step(before.host().at(frame));
    ASSERT_EQ(after.host().first, start);
    for (Frame frame = start; frame < after.host().end(); ++frame) {
      step(after.host().at(frame));
      for (std::size_t i = 0; i < after.size(); ++i) {
        const Machine<Toy>& machine = after.machine(i);
        if (frame < machine.first || frame >= machine.end()) continue;
        ASSERT_EQ(machine.hashes[static_cast<std::size_t>(frame - machine.first)], game.hash()) << frame << " at " << i;
      }
    }
    for (std::size_t i = 0; i < after.size(); ++i) expect_sound_machine(after.machine(i), true);
  }
  Match before;
};
INSTANTIATE_TEST_SUITE_P(Modes, SavedMatches, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(SavedMatches, GoOnAtTheSameFrameWithTheSameSeatsAndNobodyAbsent) {
  before.host().session.set_speed(6);
  before.pass(kSecond);
  const std::vector<std::uint8_t> bytes = save();
  const Frame start = read_saved_match(bytes).value().start.frame;
  before.pass(2 * kSecond);  // is lost
  const std::unique_ptr<Match> after = resume(bytes);
  after->pass(kSecond);
  EXPECT_EQ(after->host().session.current(), start);
  after->add(profile(kGoodLine), client(1, before.machine(2).session.token()));
  after->pass(5 * kSecond);
  EXPECT_EQ(after->host().session.current(), start) << "one is missing";
  Machine<Toy>& stranger = after->add(profile(kGoodLine), client(1));
  after->pass(kSecond);
  EXPECT_EQ(stranger.session.phase(), SessionPhase::refused);
  stranger.plays = false;
  after->add(profile(kGoodLine), client(2, before.machine(1).session.token()));
  after->pass(8 * kSecond);
  EXPECT_EQ(after->machine(1).session.local_players(), 0b1000u);
  EXPECT_EQ(after->machine(3).session.local_players(), 0b0110u);
  EXPECT_GT(after->host().end(), start + 200);
  EXPECT_EQ(after->host().last(Kind::started).frame, start);
  for (const std::size_t i : {0, 1, 3}) {
    const Machine<Toy>& machine = after->machine(i);
    EXPECT_EQ(machine.session.phase(), SessionPhase::playing) << i;
    EXPECT_EQ(machine.first, start) << i;
    EXPECT_EQ(machine.last(Kind::speed_changed).speed, 6);
    for (Frame frame = start; frame < machine.end(); ++frame) {
      for (int p = 0; p < 4; ++p) ASSERT_TRUE(machine.played(frame, p)) << p << " in " << frame << " at " << i;
    }
  }
  expect_one_match(*after, start);
}

TEST_P(SavedMatches, BeginWithoutWhoIsMissingWhenTheHostSaysSo) {
  const std::vector<std::uint8_t> bytes = save();
  const Frame start = read_saved_match(bytes).value().start.frame;
  const std::unique_ptr<Match> after = resume(bytes);
  after->add(profile(kGoodLine), client(2, before.machine(1).session.token()));
  after->pass(2 * kSecond);
  after->host().session.start(after->now());
  after->pass(3 * kSecond);
  for (int p = 0; p < 4; ++p) EXPECT_EQ(after->host().played(start + 30, p), p < 3) << p;
  after->add(profile(kGoodLine), client(1, before.machine(2).session.token()));  // its seat is kept
  after->pass(5 * kSecond);
  EXPECT_TRUE(after->host().played(after->host().end() - 1, 3));
  EXPECT_EQ(after->machine(2).session.local_players(), 0b1000u);
  expect_one_match(*after, start);
}

TEST_P(SavedMatches, MayBeSavedAgain) {
  const std::vector<std::uint8_t> bytes = save();
  const std::unique_ptr<Match> after = resume(bytes, 1);  // of the same seed, which nobody should do
  after->add(profile(kGoodLine), client(2, before.machine(1).session.token()));
  after->add(profile(kGoodLine), client(1, before.machine(2).session.token()));
  after->pass(6 * kSecond);
  std::vector<std::uint8_t> again;
  ASSERT_TRUE(after->host().session.save_match(*after->host().game, again).ok());
  const SavedMatch first = read_saved_match(bytes).value(), second = read_saved_match(again).value();
  EXPECT_GT(second.start.frame, first.start.frame + 200);
  EXPECT_EQ(second.term, first.term + 1);
  EXPECT_EQ(second.players, 4);
  for (int p = 1; p < 4; ++p) EXPECT_NE(second.proofs[p], first.proofs[p]) << "each process has tokens of its own";
  EXPECT_EQ(second.proofs[1], second.proofs[2]) << "one machine";
  EXPECT_NE(second.proofs[1], second.proofs[3]);
}

TEST_P(SavedMatches, DamagedBytesAreRefusedByName) {
  std::vector<std::uint8_t> bytes = save();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<SavedMatch> read = read_saved_match(Bytes(bytes).first(size));
    ASSERT_FALSE(read.ok()) << size;
    ASSERT_FALSE(read.error().place.view().empty());
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    bytes[at] ^= 16;
    ASSERT_FALSE(read_saved_match(bytes).ok()) << at;
    bytes[at] ^= 16;
  }
  const auto refusal = [&](const std::vector<std::uint8_t>& its, const SessionConfig& like) {
    SessionConfig config = like;
    config.host = true;
    config.seed = 3;
    config.saved_match = its;
    Session<Toy> session(config);
    EXPECT_EQ(session.phase(), SessionPhase::refused);
    const std::optional<SessionEvent> event = session.poll_event();
    return event ? std::string(event->field.key.view()) + ": " + std::string(event->field.in_file.view()) : "";
  };
  const SessionConfig config = config_of(4, GetParam());
  std::vector<std::uint8_t> cut = bytes;
  cut.pop_back();
  EXPECT_EQ(refusal(cut, config), "saved_match: checksum");
  std::vector<std::uint8_t> newer = bytes;
  newer[4] ^= 3;
  EXPECT_EQ(refusal(newer, config), "saved_match: version");
  EXPECT_EQ(refusal({1, 2, 3}, config), "saved_match: magic");
  EXPECT_EQ(refusal(bytes, config_of(3, GetParam())), "players: 4");
  SessionConfig two = config;
  two.local_players = 2;
  EXPECT_EQ(refusal(bytes, two), "saved_match: local_players");
  const auto changed = [&](const auto& change) {
    SavedMatch match = read_saved_match(bytes).value();
    change(match);
    std::vector<std::uint8_t> out;
    write_saved_match(match, out);
    return out;
  };
  EXPECT_EQ(refusal(changed([](SavedMatch& m) { m.speed = 3; }), config), "saved_match: speed");
  EXPECT_EQ(refusal(changed([](SavedMatch& m) { m.start.frame = -1; }), config), "saved_match: frame");
  EXPECT_EQ(refusal(changed([](SavedMatch& m) { m.hosted = 16; }), config), "saved_match: hosted");
  EXPECT_EQ(refusal(changed([](SavedMatch& m) { m.proofs[0] = 5; }), config), "saved_match: seats");
  EXPECT_EQ(refusal(changed([](SavedMatch& m) { m.players = 0; }), config), "saved_match: players");
}

TEST_P(SavedMatches, OfAnotherStateAreRefused) {
  const std::vector<std::uint8_t> bytes = save();
  for (const bool is_short : {false, true}) {
    SavedMatch match = read_saved_match(bytes).value();
    if (is_short) match.state.pop_back();
    else match.state[0] ^= 1;
    std::vector<std::uint8_t> other;
    write_saved_match(match, other);
    const std::unique_ptr<Match> after = resume(other);
    after->pass(kSecond);
    EXPECT_EQ(after->host().session.phase(), SessionPhase::refused);
    EXPECT_EQ(after->host().count(Kind::bad_snapshot), 1);
    EXPECT_EQ(after->host().steps, 0u);
  }
}

TEST_P(SavedMatches, AreOfAHostThatPlays) {
  std::vector<std::uint8_t> bytes;
  EXPECT_FALSE(before.machine(1).session.save_match(*before.machine(1).game, bytes).ok());
  Match waiting(config_of(2, GetParam()), 1);
  waiting.pass(kSecond);
  EXPECT_FALSE(waiting.host().session.save_match(*waiting.host().game, bytes).ok());
  SessionConfig config = client(1);
  config.saved_match = save();
  Session<Toy> session(config);
  EXPECT_EQ(session.poll_event()->field.here.view(), "saved_match: of a host");
}

TEST_P(SavedMatches, AreRecordedFromWhereTheyGoOn) {
  const std::vector<std::uint8_t> bytes = save();
  const Frame start = read_saved_match(bytes).value().start.frame;
  const std::unique_ptr<Match> after = resume(bytes);
  std::vector<std::uint8_t> file;
  MachineRecorder<Toy> recorder(after->host(), file);
  after->add(profile(kGoodLine), client(2, before.machine(1).session.token()));
  after->add(profile(kGoodLine), client(1, before.machine(2).session.token()));
  ASSERT_TRUE(after->run_to(start + 300, 30 * kSecond));
  ASSERT_TRUE(recorder.recorder.finish().ok());
  EXPECT_EQ(recorder.recorder.first(), start);
  const Played<Toy> played = play(config_of(4, GetParam()), file, Toy(40));
  EXPECT_TRUE(played.events.empty());
  EXPECT_EQ(played.first, start);
  EXPECT_GE(played.hashes.size(), 300u);
  for (std::size_t f = 0; f < played.hashes.size(); ++f) ASSERT_EQ(played.hashes[f], after->host().hashes[f]);
}

}  // namespace saved_match_test
}  // namespace isostep::test
