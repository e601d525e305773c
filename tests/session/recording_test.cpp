// Recordings that begin in the middle: by who joins late, watches, or comes back by a snapshot.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/session/preset.hpp"
#include "session/match_checks.hpp"
#include "session/recorded_play.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace recording_test {

/// A match of which the first inputs are gone when somebody comes: it is sent a snapshot.
struct JoinedMatch {
  SessionConfig config;
  std::unique_ptr<VirtualMatch<Toy>> match;

  explicit JoinedMatch(SessionMode mode) {
    config.mode = mode;
    config.players = 3;
    config.history = 200;
    match = std::make_unique<VirtualMatch<Toy>>(
        config, [] { return std::make_unique<Toy>(100); },
        [](int player, Frame frame) { return toy_input(41, player, frame); });
    match->add(profile("wifi"));
    match->run(kSecond, [] { return false; });
    match->host().session.start(match->now());
    EXPECT_TRUE(match->run_to(400, 60 * kSecond));
  }
  /// Expects that the file, played again from where it begins, is all what the host had.
  void expect_verified(const std::vector<std::uint8_t>& file, Frame first, Frame frames) const {
    const Played<Toy> played = play(config, file, Toy(100));
    EXPECT_TRUE(played.events.empty());
    EXPECT_EQ(played.phase, SessionPhase::over);
    EXPECT_EQ(played.first, first);
    ASSERT_EQ(played.hashes.size(), static_cast<std::size_t>(frames));
    for (std::size_t f = 0; f < played.hashes.size(); ++f) {
      ASSERT_EQ(played.hashes[f], match->host().hashes[static_cast<std::size_t>(first) + f]);
    }
  }
};

/// The size of a minute of a match on disk, its first state and header left out.
struct Size {
  Genre genre;
  int players;
  std::size_t bytes;  // what match_recorder.hpp says, and a tenth more
};
class RecordingSize : public testing::TestWithParam<Size> {};
INSTANTIATE_TEST_SUITE_P(Genres, RecordingSize,
                         testing::Values(Size{Genre::fighting, 2, 54000}, Size{Genre::brawler, 4, 56000},
                                         Size{Genre::racing, 8, 61000}, Size{Genre::strategy, 8, 61000},
                                         Size{Genre::sandbox, 4, 56000}));

TEST_P(RecordingSize, IsWhatThePageSays) {
  const SessionConfig config = preset(GetParam().genre, GetParam().players);
  VirtualMatch<Toy> match(
      config, [] { return std::make_unique<Toy>(); },
      [](int player, Frame frame) { return toy_input(7, 0, (frame + 3 * player) / 4); });  // holds each for 20 frames
  std::vector<std::uint8_t> file;
  MachineRecorder<Toy> recorder(match.host(), file);
  for (int p = 1; p < config.players; ++p) match.add(profile("latency=30,jitter=5,loss=0.5"));
  ASSERT_TRUE(match.run_to(1200, 60 * kSecond));
  const std::size_t before = file.size();
  const Frame first = recorder.recorder.frames();
  ASSERT_TRUE(match.run_to(1200 + 3600, 100 * kSecond));
  const Frame frames = recorder.recorder.frames() - first;
  ASSERT_TRUE(recorder.recorder.finish().ok());
  const std::size_t minute = (file.size() - before) * 3600 / static_cast<std::size_t>(frames);
  EXPECT_LE(minute, GetParam().bytes);
  EXPECT_GE(minute, GetParam().bytes * 8 / 10) << "the page says more than it is";
  const Played<Toy> played = play(config, file, Toy());
  EXPECT_TRUE(played.events.empty());
  ASSERT_EQ(played.hashes.size(), static_cast<std::size_t>(recorder.recorder.frames()));
  for (std::size_t f = 0; f < played.hashes.size(); ++f) ASSERT_EQ(played.hashes[f], match.host().hashes[f]) << f;
}

class LateRecording : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, LateRecording, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(LateRecording, BeginsWithTheSnapshotThatWasJoined) {
  JoinedMatch joined(GetParam());
  SessionConfig watcher = joined.config;
  watcher.mode = SessionMode::spectator;
  Machine<Toy>& player = joined.match->add(profile("wifi"));
  Machine<Toy>& spectator = joined.match->add(profile("mobile"), watcher);
  std::vector<std::uint8_t> files[2];
  MachineRecorder<Toy> first(player, files[0]), second(spectator, files[1]);
  ASSERT_TRUE(joined.match->run_to(900, 60 * kSecond));
  EXPECT_TRUE(player.played(player.end() - 1, 2)) << "the joiner's own inputs are in its recording";
  std::size_t i = 0;
  for (MachineRecorder<Toy>* each : {&first, &second}) {
    ASSERT_TRUE(each->recorder.finish().ok());
    EXPECT_GE(each->recorder.first(), 350);
    EXPECT_GE(each->recorder.first() + each->recorder.frames(), 900);
    joined.expect_verified(files[i++], each->recorder.first(), each->recorder.frames());
  }
}

TEST_P(LateRecording, EndsWholeWhereTheSessionRestartsAndTheNextBeginsThere) {
  JoinedMatch joined(GetParam());
  Machine<Toy>& late = joined.match->add(profile("wifi"));
  std::vector<std::uint8_t> files[2];
  MachineRecorder<Toy> before(late, files[0]);
  ASSERT_TRUE(joined.match->run_to(700, 60 * kSecond));
  const Frame last = late.end();
  late.plays = false;  // until the inputs that it lacks are gone
  joined.match->run(8 * kSecond, [] { return false; });
  late.plays = late.returns = true;
  ASSERT_TRUE(joined.match->run(20 * kSecond, [&] { return late.restarts == 2; }));
  EXPECT_FALSE(before.recorder.recording());
  EXPECT_TRUE(before.recorder.result().ok());
  MachineRecorder<Toy> after(late, files[1]);
  joined.match->run(5 * kSecond, [] { return false; });
  std::size_t i = 0;
  for (MachineRecorder<Toy>* each : {&before, &after}) {
    ASSERT_TRUE(each->recorder.finish().ok());
    EXPECT_GT(each->recorder.frames(), 100);
    joined.expect_verified(files[i++], each->recorder.first(), each->recorder.frames());
  }
  EXPECT_GE(before.recorder.first() + before.recorder.frames(), last);
  EXPECT_GT(after.recorder.first(), last + 200);
}

TEST(LateRecordings, OfAFirstFrameThatCannotBeAreRefused) {
  JoinedMatch joined(SessionMode::rollback);
  Machine<Toy>& late = joined.match->add(profile("wifi"));
  std::vector<std::uint8_t> file;
  MachineRecorder<Toy> recorder(late, file);
  ASSERT_TRUE(joined.match->run_to(600, 60 * kSecond));
  ASSERT_TRUE(recorder.recorder.finish().ok());
  const ReplayReader whole(file);
  for (const char* number : {"1073741824", "99999999999999999999", "x", "-1"}) {
    SCOPED_TRACE(number);
    ReplayHeader header = whole.header();
    header.set(kFirstFrameKey, number, false);
    std::vector<std::uint8_t> other;
    ReplayWriter writer(sink_to(other));
    ASSERT_TRUE(writer.begin(header, whole.state(), whole.state_hash()).ok());
    ASSERT_TRUE(writer.frame(whole.frame(0).input, whole.frame(0).hash).ok());
    ASSERT_TRUE(writer.finish().ok());
    const Played<Toy> played = play(joined.config, other, Toy(100));
    ASSERT_EQ(played.events.size(), 1u);
    EXPECT_EQ(played.events[0].field.key.view(), kFirstFrameKey);
    EXPECT_TRUE(played.hashes.empty());
  }
}

TEST(FlushedRecording, ACrashCostsASecondOrWhatTheSettingSaysOrNothingThatWasFlushed) {
  for (const int hz : {20, 60}) {
    for (const std::uint32_t block_frames : {0u, 1u, 5u}) {
      SessionConfig config;
      config.players = 2;
      config.hz = hz;
      VirtualMatch<Toy> match(
          config, [] { return std::make_unique<Toy>(100); },
          [](int player, Frame frame) { return toy_input(43, player, frame); });
      match.add(profile("wifi"));
      std::vector<std::uint8_t> file;
      MachineRecorder<Toy> recorder(match.host(), file, kLastFrame, block_frames);
      const Frame most = block_frames != 0 ? static_cast<Frame>(block_frames) : hz;
      for (Frame frame = 10; frame <= 200; frame += 10) {
        ASSERT_TRUE(match.run_to(frame, 60 * kSecond));
        const auto left = static_cast<Frame>(ReplayReader(file).frame_count());
        ASSERT_LT(recorder.recorder.frames() - left, most) << hz << " Hz, blocks of " << block_frames;
      }
      ASSERT_TRUE(recorder.recorder.flush().ok());
      const Played<Toy> played = play(config, file, Toy(100));
      EXPECT_EQ(played.hashes.size(), static_cast<std::size_t>(recorder.recorder.frames()));
      for (std::size_t f = 0; f < played.hashes.size(); ++f) ASSERT_EQ(played.hashes[f], match.host().hashes[f]);
      ASSERT_TRUE(recorder.recorder.finish().ok());
    }
  }
}

}  // namespace recording_test
}  // namespace isostep::test
