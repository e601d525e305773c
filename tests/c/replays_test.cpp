// Commands as bytes, recordings that are played frame by frame, and what ends a recording.
// SPDX-License-Identifier: MIT
#include "game.hpp"

namespace isostep::test {
namespace replays_test {

TEST(CReplays, PlayFrameByFrame) {
  Q32Game game;
  game.step(5);
  const std::uint64_t start = iso_world_hash(game.world);
  const std::vector<std::uint8_t> file = recording_of(game, 80);
  iso_replay_info info;
  iso_replay_info_init(&info);
  ASSERT_EQ(iso_replay_about(file.data(), file.size(), &info), ISO_OK);
  EXPECT_EQ(info.frames, 80u);
  EXPECT_EQ(info.start_hash, start);
  EXPECT_EQ(info.behaviour, iso_behaviour_version());
  EXPECT_STREQ(info.scalar, "q32.32");
  EXPECT_STREQ(info.scene, "two crates");
  iso_replay* replay = nullptr;
  iso_world* world = nullptr;
  ASSERT_EQ(iso_replay_open(file.data(), file.size(), &replay), ISO_OK) << iso_last_error();
  ASSERT_EQ(iso_replay_create_world(replay, &world), ISO_OK) << iso_last_error();
  EXPECT_EQ(iso_world_hash(world), start);
  for (std::uint64_t i = 0; i < info.frames; ++i) {
    const void* commands = nullptr;
    std::size_t size = 0;
    std::uint64_t hash = 0;
    ASSERT_EQ(iso_replay_get_frame(replay, i, &commands, &size, &hash), ISO_OK);
    ASSERT_EQ(iso_world_apply(world, commands, size), ISO_OK) << iso_last_error();
    ASSERT_EQ(iso_world_hash(world), hash) << i;
  }
  EXPECT_EQ(iso_world_hash(world), iso_world_hash(game.world));
  EXPECT_NE(iso_world_hash(world), start);
  EXPECT_EQ(iso_world_destroy(world), ISO_OK);
  EXPECT_EQ(iso_replay_destroy(replay), ISO_OK);
}

TEST(CReplays, ALogLeadsAnotherWorldAlong) {
  Q32Game game, other;
  ASSERT_EQ(iso_world_keep_log(game.world, 1), ISO_OK);
  for (int i = 0; i < 30; ++i) {
    if (i == 10) game.create(8, ISO_BODY_TYPE_DYNAMIC);
    game.step(1);
    const void* log = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(iso_world_log(game.world, &log, &size), ISO_OK);
    ASSERT_GT(size, 0u);
    ASSERT_EQ(iso_world_apply(other.world, log, size), ISO_OK) << iso_last_error();
    ASSERT_EQ(iso_world_clear_log(game.world), ISO_OK);
    ASSERT_EQ(iso_world_hash(other.world), iso_world_hash(game.world)) << i;
  }
  const std::uint8_t rubbish[] = {0xfe, 1, 2};
  EXPECT_EQ(iso_world_apply(other.world, rubbish, sizeof rubbish), ISO_CORRUPT);
}

TEST(CReplays, OneTapeRecordsOnce) {
  Q32Game game, other;
  iso_tape *tape = nullptr, *second = nullptr;
  ASSERT_EQ(iso_tape_create(&tape), ISO_OK);
  ASSERT_EQ(iso_tape_create(&second), ISO_OK);
  EXPECT_EQ(iso_tape_end_frame(tape), ISO_FAULT_BAD_ARGUMENT) << "it records nothing yet";
  ASSERT_EQ(iso_world_record(game.world, tape, "one"), ISO_OK);
  EXPECT_EQ(iso_world_record(game.world, second, "two"), ISO_FAULT_BAD_ARGUMENT);
  EXPECT_EQ(iso_world_record(other.world, tape, "three"), ISO_FAULT_BAD_ARGUMENT);
  EXPECT_EQ(iso_world_keep_log(game.world, 1), ISO_FAULT_BAD_ARGUMENT);
  game.step(1);
  EXPECT_EQ(iso_tape_end_frame(tape), ISO_OK);
  EXPECT_EQ(iso_tape_keyframe(tape), ISO_OK);
  // A snapshot leads where commands do not.
  iso_snapshot* snapshot = nullptr;
  ASSERT_EQ(iso_snapshot_create(game.world, &snapshot), ISO_OK);
  ASSERT_EQ(iso_world_save(game.world, snapshot), ISO_OK);
  ASSERT_EQ(iso_world_load(game.world, snapshot), ISO_OK);
  EXPECT_EQ(iso_tape_end_frame(tape), ISO_FAULT_BAD_ARGUMENT);
  EXPECT_NE(std::string(iso_last_error()).find("loaded"), std::string::npos) << iso_last_error();
  ASSERT_EQ(iso_snapshot_destroy(snapshot), ISO_OK);
  // A tape outlives its world, and the other way round.
  {
    Q32Game short_lived;
    ASSERT_EQ(iso_world_record(short_lived.world, second, "short"), ISO_OK);
  }
  EXPECT_EQ(iso_tape_end_frame(second), ISO_FAULT_BAD_ARGUMENT);
  EXPECT_EQ(iso_tape_destroy(tape), ISO_OK);
  game.step(1);
  EXPECT_EQ(iso_tape_destroy(second), ISO_OK);
}

TEST(CReplays, ATapeIsWrittenAsItGrows) {
  Q32Game game;
  iso_tape* tape = nullptr;
  ASSERT_EQ(iso_tape_create(&tape), ISO_OK);
  ASSERT_EQ(iso_world_record(game.world, tape, "long"), ISO_OK);
  std::vector<std::uint8_t> file;
  const auto take = [&] {
    const void* bytes = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(iso_tape_bytes(tape, &bytes, &size), ISO_OK);
    file.insert(file.end(), static_cast<const std::uint8_t*>(bytes), static_cast<const std::uint8_t*>(bytes) + size);
    ASSERT_EQ(iso_tape_drop_bytes(tape), ISO_OK);
  };
  for (int i = 0; i < 150; ++i) {
    game.step(1);
    ASSERT_EQ(iso_tape_end_frame(tape), ISO_OK);
    take();
  }
  ASSERT_EQ(iso_tape_finish(tape), ISO_OK);
  take();
  ASSERT_EQ(iso_tape_destroy(tape), ISO_OK);
  iso_replay_result result;
  iso_replay_result_init(&result);
  ASSERT_EQ(iso_replay_verify(file.data(), file.size(), ISO_SIMD_SCALAR, 100, &result), ISO_OK);
  EXPECT_EQ(result.outcome, std::uint32_t{ISO_VERIFY_OUTCOME_VERIFIED}) << result.text;
  EXPECT_EQ(result.frames, 100u);
  EXPECT_STREQ(result.lanes, "scalar");
}

TEST(CReplays, WhatIsFlushedIsThereAfterACrash) {
  Q32Game game;
  iso_tape* tape = nullptr;
  ASSERT_EQ(iso_tape_create(&tape), ISO_OK);
  EXPECT_EQ(iso_tape_flush(tape), ISO_FAULT_BAD_ARGUMENT) << "it records nothing yet";
  EXPECT_EQ(iso_tape_flush(nullptr), ISO_NULL);
  ASSERT_EQ(iso_world_record(game.world, tape, "crash"), ISO_OK);
  for (std::uint64_t frames = 1; frames <= 130; ++frames) {
    game.step(1);
    ASSERT_EQ(iso_tape_end_frame(tape), ISO_OK);
    if (frames % 13 == 0) {
      ASSERT_EQ(iso_tape_flush(tape), ISO_OK);
    }
    const void* bytes = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(iso_tape_bytes(tape, &bytes, &size), ISO_OK);
    std::vector<std::uint8_t> file(static_cast<const std::uint8_t*>(bytes),
                                   static_cast<const std::uint8_t*>(bytes) + size);
    file.resize((size / 4096 + 1) * 4096);  // the page's rest, as a power failure leaves it
    iso_replay_info info;
    iso_replay_info_init(&info);
    ASSERT_EQ(iso_replay_about(file.data(), file.size(), &info), ISO_OK);
    EXPECT_EQ(info.file, std::uint32_t{ISO_VERIFY_OUTCOME_TRUNCATED});
    EXPECT_EQ(info.frames, frames / 13 * 13);
  }
  ASSERT_EQ(iso_tape_destroy(tape), ISO_OK);
}

TEST(CReplays, TracesTellEveryStage) {
  Q32Game game;
  ASSERT_EQ(iso_world_trace(game.world, 1), ISO_OK);
  game.step(1);
  const std::uint64_t between = iso_world_hash(game.world);
  game.step(1);
  const std::uint64_t* hashes = nullptr;
  std::size_t count = 0;
  ASSERT_EQ(iso_world_stage_hashes(game.world, &hashes, &count), ISO_OK);
  ASSERT_EQ(count, 2u * (ISO_STAGE_MOVE_CHARACTERS + 2));
  EXPECT_EQ(hashes[count / 2], between);
  EXPECT_NE(hashes[0], between);
  ASSERT_EQ(iso_world_clear_trace(game.world), ISO_OK);
  ASSERT_EQ(iso_world_trace(game.world, 0), ISO_OK);
  game.step(1);
  ASSERT_EQ(iso_world_stage_hashes(game.world, &hashes, &count), ISO_OK);
  EXPECT_EQ(count, 0u);
}

}  // namespace replays_test
}  // namespace isostep::test
