// Command logs over a toy's own list of commands: their bytes, playing them, and the recorder of any world that writes
// them.
// SPDX-License-Identifier: MIT
#include "isostep/state/command_log.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "isostep/state/command_recorder.hpp"
#include "random/splitmix64.hpp"
#include "toy_world.hpp"

namespace command_log_test {

using namespace isostep;
using namespace toy;

/// The commands that playing a log was told, and how far it came.
struct Heard {
  std::vector<ToyCommand> commands;
  std::vector<std::size_t> steps;  // after so many commands
  Result<void> result;

  explicit Heard(Bytes log, std::size_t accepted = 1000)
      : result(play_commands<EveryToyCommand>(
            log,
            [&](const ToyCommand& command) {
              commands.push_back(command);
              return commands.size() <= accepted;
            },
            [&] { steps.push_back(commands.size()); })) {}
};

TEST(CommandLog, ACommandIsItsPlaceInTheListAndItsFields) {
  Buffer log;
  Writer writer(log);
  write_command<EveryToyCommand>(writer, Clear{});
  EXPECT_EQ(log, (Buffer{1}));
  write_command<EveryToyCommand>(writer, Push{0x01020304, Q32_32(1.5)});
  EXPECT_EQ(log, (Buffer{1, 0, 0x84, 0x86, 0x88, 0x08, 0, 0, 0, 0x80, 1, 0, 0, 0}));
}

TEST(CommandLog, ANumberHasOneFormAndAnotherIsCorrupt) {
  const Buffer by(8, 0);
  for (const Buffer& to : {Buffer{0x80, 0x00}, Buffer{0x85, 0x80, 0x00}, Buffer{0xff, 0xff, 0xff, 0xff, 0x1f},
                           Buffer{0xff, 0xff, 0xff, 0xff, 0xff, 0x01}}) {
    Buffer log = {0};
    log.insert(log.end(), to.begin(), to.end());
    log.insert(log.end(), by.begin(), by.end());
    const Heard heard{log};
    EXPECT_EQ(heard.result.error().code, ErrorCode::corrupt);
    EXPECT_TRUE(heard.commands.empty());
  }
  EXPECT_TRUE(Heard(Buffer{0, 0xff, 0xff, 0xff, 0xff, 0x0f, 0, 0, 0, 0, 0, 0, 0, 0}).result.ok());
}

TEST(CommandLog, IsWhatItsCommandsAreWrittenAs) {
  // Any bytes that are read are those that writing the same commands gives: a frame has one log.
  std::uint64_t state = 7;
  std::uint32_t read = 0;
  for (int round = 0; round < 200000; ++round) {
    Buffer log(1 + isostep::test::splitmix64(state) % 24);
    for (std::uint8_t& byte : log) {
      const std::uint64_t word = isostep::test::splitmix64(state);
      byte = static_cast<std::uint8_t>(word % 4 == 0 ? word >> 8 : (word >> 8) % 4);
    }
    const Heard heard{log};
    if (!heard.result.ok() || !heard.steps.empty()) continue;
    Buffer again;
    Writer writer(again);
    for (const ToyCommand& command : heard.commands)
      std::visit([&](const auto& one) { write_command<EveryToyCommand>(writer, one); }, command);
    ASSERT_EQ(again, log);
    ++read;
  }
  EXPECT_GT(read, 1000u);
}

TEST(CommandLog, ACommandOfVaryingLengthWritesItself) {
  Buffer log;
  Writer writer(log);
  write_command<EveryToyCommand>(writer, Fill{{7, 0x0102}});
  EXPECT_EQ(log, (Buffer{2, 2, 0, 0, 0, 7, 0, 2, 1}));
}

TEST(CommandLog, IsPlayedFromFrontToBackWithTheStepsInTheirPlaces) {
  Buffer log;
  Writer writer(log);
  log.push_back(kStepMarker);
  write_command<EveryToyCommand>(writer, Push{3, Q32_32(-0.25)});
  write_command<EveryToyCommand>(writer, Fill{{5, 6, 7}});
  log.push_back(kStepMarker);
  log.push_back(kStepMarker);
  write_command<EveryToyCommand>(writer, Clear{});
  const Heard heard{log};
  ASSERT_TRUE(heard.result.ok());
  EXPECT_EQ(heard.steps, (std::vector<std::size_t>{0, 2, 2}));
  ASSERT_EQ(heard.commands.size(), 3u);
  EXPECT_EQ(std::get<Push>(heard.commands[0]).to, 3u);
  EXPECT_EQ(std::get<Push>(heard.commands[0]).by, Q32_32(-0.25));
  EXPECT_EQ(std::get<Fill>(heard.commands[1]).numbers, (std::vector<std::uint16_t>{5, 6, 7}));
  EXPECT_TRUE(std::holds_alternative<Clear>(heard.commands[2]));
  EXPECT_TRUE(Heard{Bytes{}}.result.ok());
}

TEST(CommandLog, ANumberThatNoCommandHasIsInvalid) {
  for (const std::uint8_t number : {3, 4, 0x7f, 0xfe}) {
    const Heard heard{Buffer{1, number, 1}};
    ASSERT_FALSE(heard.result.ok());
    EXPECT_EQ(heard.result.error().code, ErrorCode::invalid);
    EXPECT_EQ(heard.commands.size(), 1u) << "what comes before the error was done";
  }
}

TEST(CommandLog, ACommandThatIsCutOffIsNotCarriedOut) {
  Buffer whole;
  Writer writer(whole);
  write_command<EveryToyCommand>(writer, Push{1, 2});
  const std::size_t push = whole.size();
  write_command<EveryToyCommand>(writer, Fill{{1, 2, 3}});
  for (std::size_t size = 1; size < whole.size(); ++size) {
    const Heard heard{Bytes(whole).first(size)};
    EXPECT_EQ(heard.result.ok(), size == push) << size;
    EXPECT_EQ(heard.commands.size(), size < push ? 0u : 1u) << size;
  }
}

TEST(CommandLog, ACountAboveTheCommandsOwnCapIsRefused) {
  Buffer log;
  Writer writer(log);
  write_command<EveryToyCommand>(writer, Fill{std::vector<std::uint16_t>(kFillCap, 9)});
  EXPECT_TRUE(Heard{log}.result.ok());
  log.clear();
  write_command<EveryToyCommand>(writer, Fill{std::vector<std::uint16_t>(kFillCap + 1, 9)});
  const Heard heard{log};
  EXPECT_FALSE(heard.result.ok());
  EXPECT_TRUE(heard.commands.empty());
}

TEST(CommandLog, EndsAtACommandThatIsRefused) {
  const Heard heard(Buffer{1, kStepMarker, 1, kStepMarker, 1}, 1);
  EXPECT_EQ(heard.result.error().code, ErrorCode::corrupt);
  EXPECT_EQ(heard.commands.size(), 2u);
  EXPECT_EQ(heard.steps, (std::vector<std::size_t>{1}));
}

TEST(CommandLog, MayHaveSoManyStepsAndNotOneMore) {
  EXPECT_TRUE(Heard{Buffer(kFrameStepCap, kStepMarker)}.result.ok());
  const Heard heard{Buffer(kFrameStepCap + 1, kStepMarker)};
  EXPECT_EQ(heard.result.error().code, ErrorCode::limit);
  EXPECT_EQ(heard.result.error().message.view(), kTooManySteps);
  EXPECT_EQ(heard.steps.size(), kFrameStepCap);
}

// The recorder, over a world that is none of ours.

TEST(CommandRecorder, WhatItWritesIsPlayedAndVerified) {
  ToyWorld world;
  world.apply(Push{1, 2});
  Buffer file;
  CommandRecorder<ToyWorld> recorder(world, sink_to(file));
  ASSERT_TRUE(recorder.begin("a toy").ok());
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    world.apply(Push{frame, Q32_32(0.5)});
    if (frame % 7 == 0) world.apply(Fill{{1, static_cast<std::uint16_t>(frame)}});
    for (std::uint32_t i = 0; i < frame % 3; ++i) world.step();
    if (frame == 50) world.apply(Clear{});
    ASSERT_TRUE(recorder.end_frame().ok()) << frame;
  }
  ASSERT_TRUE(recorder.finish().ok());
  const ReplayReader replay(file);
  ASSERT_EQ(replay.frame_count(), 100u);
  EXPECT_EQ(replay.header().find(kFirstFrameKey), nullptr);
  EXPECT_EQ(identity_of(replay.header()).value().world, "toys");
  const ReplayHeader here = header_of_world(world.settings(), "a toy", 0).value();
  ToyWorld again;
  const VerifyResult result = verify_replay(replay, again, SameHeader{here});
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(again.tick(), world.tick());
}

TEST(CommandRecorder, AKeyframeIsTheStateAfterTheLastFrame) {
  ToyWorld world;
  Buffer file;
  CommandRecorder<ToyWorld> recorder(world, sink_to(file));
  ASSERT_TRUE(recorder.begin("a toy").ok());
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    world.apply(Push{frame, Q32_32(0.5)});
    world.step();
    ASSERT_TRUE(recorder.end_frame().ok());
    if (frame == 2) {
      ASSERT_TRUE(recorder.keyframe().ok());
    }
  }
  ASSERT_TRUE(recorder.keyframe().ok() && recorder.finish().ok());
  const ReplayReader replay(file);
  ASSERT_EQ(replay.keyframes().size(), 2u);
  EXPECT_EQ(replay.keyframes()[0].frames, 3u);
  EXPECT_EQ(replay.keyframes()[1].hash, world.hash());
  const ReplayHeader here = header_of_world(world.settings(), "a toy", 0).value();
  ToyWorld again;
  EXPECT_EQ(verify_replay(replay, again, SameHeader{here}).outcome, VerifyOutcome::verified);

  Buffer other;
  CommandRecorder<ToyWorld> early(world, sink_to(other));
  ASSERT_TRUE(early.begin("a toy").ok());
  world.apply(Push{1, 1});
  EXPECT_FALSE(early.keyframe().ok()) << "in the middle of a frame";
}

TEST(CommandRecorder, TheGamesFirstFrameIsInTheHeader) {
  ToyWorld world;
  Buffer file;
  CommandRecorder<ToyWorld> recorder(world, sink_to(file));
  ASSERT_TRUE(recorder.begin("a toy", 120).ok() && recorder.finish().ok());
  EXPECT_EQ(ReplayReader(file).header().number(kFirstFrameKey).value(), 120u);
  EXPECT_FALSE(ReplayReader(file).header().find(kFirstFrameKey)->required);
}

TEST(CommandRecorder, EndsWhereTheWorldWasLoadedOrSteppedTooOften) {
  ToyWorld loaded, hasty, silent;
  Buffer files[3];
  CommandRecorder<ToyWorld> of_loaded(loaded, sink_to(files[0])), of_hasty(hasty, sink_to(files[1])),
      of_silent(silent, sink_to(files[2]));
  ASSERT_TRUE(of_loaded.begin("a").ok() && of_hasty.begin("b").ok() && of_silent.begin("c").ok());
  Buffer bytes;
  Writer writer(bytes);
  loaded.write_portable(writer);
  Reader reader(bytes);
  ASSERT_TRUE(loaded.read_portable(reader).ok());
  EXPECT_FALSE(of_loaded.end_frame().ok());
  for (std::uint32_t i = 0; i <= kFrameStepCap; ++i) hasty.step();
  EXPECT_EQ(of_hasty.end_frame().error().message.view(), kTooManySteps);
  silent.record_to(nullptr);
  EXPECT_FALSE(of_silent.end_frame().ok());
}

TEST(CommandRecorder, ACrashCostsWhatTheSettingSaysAndNothingThatWasFlushed) {
  for (const std::uint32_t block_frames : {0u, 1u, 9u}) {
    ToyWorld world;
    Buffer file;
    CommandRecorder<ToyWorld> recorder(world, sink_to(file), block_frames);
    ASSERT_TRUE(recorder.begin("a toy").ok());
    const std::uint32_t most = block_frames != 0 ? block_frames : world.settings().hz;
    for (std::uint32_t frame = 1; frame <= 100; ++frame) {
      world.apply(Push{frame, Q32_32(0.5)});
      world.step();
      ASSERT_TRUE(recorder.end_frame().ok());
      ASSERT_EQ(ReplayReader(file).frame_count(), frame / most * most);
    }
    ASSERT_TRUE(recorder.flush().ok());
    EXPECT_EQ(ReplayReader(file).frame_count(), 100u);
  }
}

}  // namespace command_log_test
