// Recordings of sessions that roll back are those of a match that never did; the history keeps what was last true.
// SPDX-License-Identifier: MIT
#include "isostep/replay/session_recorder.hpp"

#include "isostep/replay/desync_bundle.hpp"
#include "isostep/state/verify.hpp"
#include "played_session.hpp"

namespace isostep::test {
namespace session_recorder_test {

/// The history first, as a driver would call both.
template <class S> struct Recording {
  FrameHistory<S>& history;
  SessionRecorder<S>& recorder;

  void before_step(Frame frame) { history.before_step(frame), recorder.before_step(frame); }
  void after_step(Frame frame) { history.after_step(frame); }
  void rolled_back(Frame frame) { history.rolled_back(frame), recorder.rolled_back(frame); }
  void confirmed(Frame frame, std::uint64_t hash) {
    history.confirmed(frame, hash);
    recorder.confirmed(frame, hash);
  }
  void restarted(Frame frame) { history.restarted(frame), recorder.restarted(frame); }
};

template <class S> std::vector<std::uint8_t> straight_recording(Arena<S>& arena, Frame first, Frame end) {
  std::vector<std::uint8_t> file;
  WorldRecorder<S> recorder(arena.world, sink_to(file));
  bool ok = recorder.begin("arena", first).ok();
  for (Frame frame = first; frame < end; ++frame) {
    play_frame(arena, frame, input_of(frame));
    ok = recorder.end_frame().ok() && ok;
  }
  EXPECT_TRUE(recorder.finish().ok() && ok);
  return file;
}
template <class S> VerifyResult verify_world(const std::vector<std::uint8_t>& file) {
  const ReplayReader replay(file);
  World<S> world;
  return verify_replay(replay, world, SameHeader{replay.header()});
}

template <class S> class SessionRecording : public ::testing::Test {
 protected:
  Arena<S> arena, other;
  FrameHistory<S> history{arena.world, {.frames = 16, .states = false}};
  std::vector<std::uint8_t> file;
  SessionRecorder<S> recorder{history, sink_to(file), "arena"};
  Recording<S> both{history, recorder};
};
TYPED_TEST_SUITE(SessionRecording, AllScalars);

TYPED_TEST(SessionRecording, is_byte_for_byte_that_of_a_match_without_rollback) {
  play_session(this->arena, 0, 130, this->both);
  ASSERT_TRUE(this->recorder.finish().ok());
  EXPECT_EQ(this->recorder.frames(), 130);
  EXPECT_NE(this->arena.world.tick(), 130u) << "frames of no step and of two were meant to be among them";
  EXPECT_EQ(this->file, straight_recording(this->other, 0, 130));
  const VerifyResult result = verify_world<TypeParam>(this->file);
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(result.frames, 130u);
}

TYPED_TEST(SessionRecording, of_a_late_joiner_starts_with_the_state_that_was_joined) {
  for (Frame frame = 0; frame < 47; ++frame) play_frame(this->other, frame, input_of(frame));
  const std::vector<std::uint8_t> joined = bytes_of(this->other.world);
  Reader reader(joined);
  ASSERT_TRUE(this->arena.world.read_portable(reader).ok());
  this->both.restarted(47);
  play_session(this->arena, 47, 90, this->both);
  ASSERT_TRUE(this->recorder.finish().ok());
  EXPECT_EQ(this->file, straight_recording(this->other, 47, 90));
  EXPECT_EQ(ReplayReader(this->file).header().number("first_frame").value(), 47u);
}

TYPED_TEST(SessionRecording, ends_whole_where_the_session_restarts) {
  play_session(this->arena, 0, 24, this->both);
  this->both.restarted(100);
  EXPECT_FALSE(this->recorder.recording());
  play_session(this->arena, 100, 112, this->both);
  ASSERT_TRUE(this->recorder.finish().ok());
  EXPECT_EQ(this->file, straight_recording(this->other, 0, 24));
}

TYPED_TEST(SessionRecording, holds_no_frame_that_was_not_confirmed) {
  play_session(this->arena, 0, 12, this->both);
  this->both.before_step(12);
  play_frame(this->arena, 12, 3);
  this->both.after_step(12);
  ASSERT_TRUE(this->recorder.finish().ok());
  EXPECT_EQ(this->recorder.frames(), 12);
  EXPECT_EQ(verify_world<TypeParam>(this->file).frames, 12u);
}

TYPED_TEST(SessionRecording, says_when_the_history_is_too_short) {
  FrameHistory<TypeParam> few(this->arena.world, {.frames = 5, .states = false});
  SessionRecorder<TypeParam> poor(few, sink_to(this->file), "arena");
  Recording<TypeParam> pair{few, poor};
  play_session(this->arena, 0, 6, pair);
  EXPECT_FALSE(poor.finish().ok());
  EXPECT_FALSE(poor.recording());
}

TYPED_TEST(SessionRecording, says_when_a_frame_was_left_out) {
  for (const Frame frame : {0, 1, 2}) {
    this->both.before_step(frame);
    play_frame(this->arena, frame, 0);
    this->both.after_step(frame);
    if (frame != 1) this->both.confirmed(frame, 0);
  }
  EXPECT_FALSE(this->recorder.finish().ok());
  EXPECT_EQ(this->recorder.frames(), 1);
}

TYPED_TEST(SessionRecording, takes_frames_of_no_step_and_of_as_many_as_the_cap) {
  const std::uint32_t steps[] = {0, 1, 2, kFrameStepCap, 0};
  Frame frame = 0;
  for (const std::uint32_t n : steps) {
    this->both.before_step(frame);
    for (std::uint32_t i = 0; i < n; ++i) this->arena.world.step();
    this->both.after_step(frame);
    this->both.confirmed(frame++, 1);
  }
  ASSERT_TRUE(this->recorder.finish().ok());
  const VerifyResult result = verify_world<TypeParam>(this->file);
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(result.frames, 5u);
}

TYPED_TEST(SessionRecording, says_when_a_frame_has_more_steps_than_the_cap) {
  this->both.before_step(0);
  for (std::uint32_t i = 0; i <= kFrameStepCap; ++i) this->arena.world.step();
  this->both.after_step(0);
  this->both.confirmed(0, 1);
  EXPECT_EQ(this->recorder.finish().error().message.view(), kTooManySteps);
}

TYPED_TEST(SessionRecording, says_when_a_confirmed_frame_was_not_stepped_to_its_end) {
  this->both.before_step(0);
  this->arena.world.step();
  this->both.confirmed(0, 1);
  EXPECT_FALSE(this->recorder.finish().ok());
}

TYPED_TEST(SessionRecording, says_when_the_game_loads_its_world_inside_a_step) {
  typename World<TypeParam>::Snapshot snapshot;
  this->arena.world.save(snapshot);
  this->both.before_step(0);
  this->arena.world.load(snapshot);
  this->arena.world.step();
  this->both.after_step(0);
  this->both.confirmed(0, 1);
  EXPECT_FALSE(this->recorder.finish().ok());
}

TYPED_TEST(SessionRecording, leaves_the_command_log_alone_between_frames) {
  play_session(this->arena, 0, 6, this->both);
  std::vector<std::uint8_t> log;
  EXPECT_TRUE(this->arena.world.records_to(nullptr));
  this->arena.world.record_to(&log);
  play_frame(this->arena, 6, 0);
  EXPECT_FALSE(log.empty());
}

template <class S> class Bundles : public ::testing::Test {
 protected:
  Arena<S> arena;
  FrameHistory<S> history{arena.world, {.frames = 32, .states = true, .stages = true}};
  std::vector<std::uint8_t> file;

  Result<void> write(Frame agreed) {
    file.clear();
    return write_bundle(sink_to(file), history, "arena", {.player = 3, .agreed = agreed, .states = 4});
  }
  BundleFacts facts(const ReplayReader& replay) {
    EXPECT_EQ(replay.ancillaries().size(), 1u);
    EXPECT_EQ(replay.ancillaries()[0].type, replay_chunk::kPeer);
    return read_facts(replay.ancillaries()[0].payload, replay.frame_count()).value();
  }
  std::uint64_t first(const ReplayReader& replay) { return replay.header().number(kFirstFrameKey).value(); }
};
TYPED_TEST_SUITE(Bundles, AllScalars);

TYPED_TEST(Bundles, are_replays_of_the_frames_since_the_last_agreed_state) {
  play_session(this->arena, 0, 60, this->history);
  ASSERT_TRUE(this->write(50).ok());
  const VerifyResult result = verify_world<TypeParam>(this->file);
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  const ReplayReader replay(this->file);
  EXPECT_EQ(replay.frame_count(), 10u);
  EXPECT_EQ(replay.keyframes().size(), 4u);
  const BundleFacts facts = this->facts(replay);
  EXPECT_EQ(this->first(replay), 50u);
  EXPECT_EQ(facts.player, 3u);
  EXPECT_EQ(facts.agreed, 50);
  ASSERT_EQ(facts.game_hashes.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(facts.game_hashes[i], ~replay.frame(i).hash);
  EXPECT_EQ(facts.steps, (std::vector<std::uint32_t>{1, 1, 1, 0, 1, 1, 1, 1, 0, 1}));
  EXPECT_EQ(facts.stages.size(), 8u * kTraceHashes);
}

TYPED_TEST(Bundles, tell_a_frame_that_paused_from_one_that_was_not_traced) {
  FrameHistory<TypeParam> untraced(this->arena.world, {.frames = 8});
  play_session(this->arena, 0, 4, untraced);
  ASSERT_TRUE(write_bundle(sink_to(this->file), untraced, "arena", {}).ok());
  EXPECT_TRUE(this->facts(ReplayReader(this->file)).steps.empty());
  play_session(this->arena, 3, 5, this->history);
  ASSERT_TRUE(this->write(kNoFrame).ok());
  const BundleFacts facts = this->facts(ReplayReader(this->file));
  EXPECT_EQ(facts.steps, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(facts.stages.size(), 2 * kTraceHashes);
}

TYPED_TEST(Bundles, hold_a_frame_that_cannot_be_played_as_it_was) {
  this->history.before_step(0);
  for (std::uint32_t i = 0; i <= kFrameStepCap; ++i) this->arena.world.step();
  this->history.after_step(0);
  this->history.confirmed(0, 1);
  ASSERT_TRUE(this->write(kNoFrame).ok());
  EXPECT_EQ(this->facts(ReplayReader(this->file)).steps, (std::vector<std::uint32_t>{kFrameStepCap + 1}));
  const VerifyResult result = verify_world<TypeParam>(this->file);
  EXPECT_EQ(result.outcome, VerifyOutcome::corrupt) << describe(result);
  EXPECT_EQ(result.error.message.view(), kTooManySteps);
}

TYPED_TEST(Bundles, start_with_the_oldest_state_kept_when_the_agreed_one_is_gone) {
  play_session(this->arena, 0, 60, this->history);
  ASSERT_TRUE(this->write(kNoFrame).ok());
  EXPECT_EQ(this->first(ReplayReader(this->file)), 60u - 32 + 1);
  EXPECT_EQ(verify_world<TypeParam>(this->file).outcome, VerifyOutcome::verified);
}

TYPED_TEST(Bundles, start_with_the_first_state_of_a_young_match) {
  play_session(this->arena, 5, 10, this->history);
  ASSERT_TRUE(this->write(kNoFrame).ok());
  EXPECT_EQ(this->first(ReplayReader(this->file)), 5u);
  EXPECT_EQ(verify_world<TypeParam>(this->file).frames, 5u);
}

TYPED_TEST(Bundles, hold_no_predicted_frame_and_are_refused_without_any_other) {
  EXPECT_FALSE(this->write(kNoFrame).ok());
  this->history.before_step(0);
  play_frame(this->arena, 0, 0);
  this->history.after_step(0);
  EXPECT_FALSE(this->write(kNoFrame).ok());
  this->history.confirmed(0, 1);
  EXPECT_TRUE(this->write(kNoFrame).ok());
  EXPECT_TRUE(this->write(0).ok());
  EXPECT_FALSE(this->write(1).ok());
  this->history.restarted(0);
  EXPECT_FALSE(this->write(kNoFrame).ok());
}

TYPED_TEST(Bundles, keep_what_was_confirmed_when_a_sync_test_goes_behind_it) {
  play_session(this->arena, 0, 60, this->history);
  this->history.rolled_back(57);
  EXPECT_NE(this->history.find(59), nullptr);
  this->history.before_step(60);
  this->history.after_step(60);
  this->history.rolled_back(57);
  EXPECT_EQ(this->history.find(60), nullptr);
  EXPECT_EQ(this->history.last_confirmed(), 59);
  ASSERT_TRUE(this->write(54).ok());
  EXPECT_EQ(ReplayReader(this->file).frame_count(), 6u);
}

TYPED_TEST(Bundles, refuse_facts_that_are_cut_short_or_followed_by_more) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  write_facts(writer, {1, 3, {4}, {1}, std::vector<std::uint64_t>(kTraceHashes), {}});
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) EXPECT_FALSE(read_facts({bytes.data(), cut}, 1).ok()) << cut;
  EXPECT_TRUE(read_facts(bytes, 1).ok());
  bytes.push_back(0);
  EXPECT_FALSE(read_facts(bytes, 1).ok());
  bytes.insert(bytes.end(), 3, 0);  // a list that nobody writes
  EXPECT_FALSE(read_facts(bytes, 1).ok());
}

TYPED_TEST(Bundles, refuse_facts_that_do_not_fit_their_frames) {
  BundleFacts facts;
  facts.game_hashes = {1, 2};
  const auto read = [&](std::uint64_t frames) {
    std::vector<std::uint8_t> bytes;
    Writer writer(bytes);
    write_facts(writer, facts);
    return read_facts(bytes, frames).ok();
  };
  EXPECT_TRUE(read(2));
  EXPECT_FALSE(read(3));
  facts.stages.resize(2 * kTraceHashes);
  EXPECT_FALSE(read(2));
  facts.steps = {0, 2};
  EXPECT_TRUE(read(2));
  facts.steps = {2};
  EXPECT_FALSE(read(2));
  facts.steps = {0xffffffffu, 3};
  EXPECT_FALSE(read(2));
  facts.steps = {0, 2};
  facts.stages.pop_back();
  EXPECT_FALSE(read(2));
  facts.stages.push_back(0);
  for (const Frame agreed : {-2, kLastFrame + 1}) {
    facts.agreed = agreed;
    EXPECT_FALSE(read(2)) << agreed;
  }
}

TYPED_TEST(SessionRecording, what_is_flushed_or_older_than_a_second_survives_a_crash) {
  play_session(this->arena, 0, 95, this->both);
  ASSERT_GT(this->recorder.frames(), 60);
  EXPECT_LT(this->recorder.frames() - static_cast<Frame>(ReplayReader(this->file).frame_count()), 60);
  ASSERT_TRUE(this->recorder.flush().ok());
  const VerifyResult result = verify_world<TypeParam>(this->file);
  EXPECT_EQ(result.outcome, VerifyOutcome::truncated) << describe(result);
  EXPECT_EQ(result.frames, static_cast<std::uint64_t>(this->recorder.frames()));
}

}  // namespace session_recorder_test
}  // namespace isostep::test
