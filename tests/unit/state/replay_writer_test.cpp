// A replay writer meets sinks, crashes, blocks and calls out of order.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "recording.hpp"

namespace isostep {
namespace replay_writer_test {

using toy::Buffer;

TEST(ReplayWriter, WritesTheSameBytesWhateverTheSinkIs) {
  struct Counter {
    Buffer bytes;
    std::size_t calls = 0;
  } counter;
  const ReplaySink sink = {[](void* context, const std::uint8_t* bytes, std::size_t size) {
                             auto& c = *static_cast<Counter*>(context);
                             c.bytes.insert(c.bytes.end(), bytes, bytes + size);
                             ++c.calls;
                             return true;
                           },
                           &counter};
  toy::Game game;
  Recorder<toy::Game> recorder(sink);
  ASSERT_TRUE(recorder.begin(game, toy::header()));
  for (std::uint64_t i = 0; i < 70; ++i) {
    ASSERT_TRUE(game.step_recorded(toy::input_of(i)));
    ASSERT_TRUE(recorder.frame(toy::input_of(i), game.hash()));
  }
  ASSERT_TRUE(recorder.finish());
  EXPECT_EQ(counter.bytes, toy::record(70));
  EXPECT_GT(counter.calls, 6u);
}

TEST(ReplayWriter, ARefusingSinkEndsTheRecordingAndLeavesAValidBeginning) {
  struct Disk {
    Buffer bytes;
    std::size_t room;
  };
  const std::size_t full = toy::record(70).size();
  for (std::size_t room = 0; room < full; room += 13) {
    Disk disk{{}, room};
    const ReplaySink sink = {[](void* context, const std::uint8_t* bytes, std::size_t size) {
                               auto& d = *static_cast<Disk*>(context);
                               if (d.bytes.size() + size > d.room) return false;
                               d.bytes.insert(d.bytes.end(), bytes, bytes + size);
                               return true;
                             },
                             &disk};
    toy::Game game;
    Recorder<toy::Game> recorder(sink);
    bool ok = recorder.begin(game, toy::header()).ok();
    for (std::uint64_t i = 0; i < 70; ++i) {
      ASSERT_TRUE(game.step_recorded(toy::input_of(i)));
      ok = recorder.frame(toy::input_of(i), game.hash()).ok() && ok;
    }
    const Result<void> finished = recorder.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, ErrorCode::sink);
    EXPECT_EQ(toy::verify_toy(disk.bytes).outcome, VerifyOutcome::truncated);
  }
}

/// A buffer in the process, as stdio has one: what is in it a crash takes along.
struct BufferedDisk {
  Buffer held, safe;
  bool refuses = false;
  static bool write(void* context, const std::uint8_t* bytes, std::size_t size) {
    auto& disk = *static_cast<BufferedDisk*>(context);
    disk.held.insert(disk.held.end(), bytes, bytes + size);
    return true;
  }
  static bool flush(void* context) {
    auto& disk = *static_cast<BufferedDisk*>(context);
    if (disk.refuses) return false;
    disk.safe.insert(disk.safe.end(), disk.held.begin(), disk.held.end());
    disk.held.clear();
    return true;
  }
  ReplaySink sink() { return {write, this, flush}; }
};

TEST(ReplayWriter, ACrashCostsAtMostASecondAtEveryRate) {
  for (const std::uint32_t hz : {1u, 2u, 10u, 20u, 30u, 59u, 60u, 61u, 144u, 1000u}) {
    ReplayIdentity identity = toy::identity();
    identity.hz = hz;
    BufferedDisk disk;
    ReplayWriter writer(disk.sink());
    ASSERT_TRUE(writer.begin(make_replay_header(identity).value(), Buffer(8), 0));
    for (std::uint64_t i = 1; i <= 4 * hz; ++i) {
      ASSERT_TRUE(writer.frame(toy::input_of(i), i));
      const ReplayReader after_crash(disk.safe);
      ASSERT_EQ(after_crash.status(), ReplayStatus::truncated);
      ASSERT_TRUE(after_crash.has_state());
      ASSERT_LT(i - after_crash.frame_count(), hz == 1 ? 1u : hz) << hz << " Hz";
    }
  }
}

TEST(ReplayWriter, ASettingSaysHowManyFramesACrashMayCost) {
  for (const std::uint32_t most : {1u, 2u, 7u, 60u}) {
    BufferedDisk disk;
    Recorder<toy::Game> recorder(disk.sink(), most);
    toy::Game game;
    ASSERT_TRUE(recorder.begin(game, toy::header()));
    for (std::uint64_t i = 1; i <= 130; ++i) {
      ASSERT_TRUE(game.step_recorded(toy::input_of(i)));
      ASSERT_TRUE(recorder.frame(toy::input_of(i), game.hash()));
      ASSERT_EQ(ReplayReader(disk.safe).frame_count(), i / most * most);
    }
    ASSERT_TRUE(recorder.finish());
    EXPECT_EQ(toy::verify_toy(disk.safe).outcome, VerifyOutcome::verified);
    EXPECT_TRUE(disk.held.empty());
  }
  Buffer file;
  ReplayWriter refused(sink_to(file), kReplayBlockFrames + 1);
  const Result<void> begun = refused.begin(toy::header(), {}, 0);
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().code, ErrorCode::limit);
}

TEST(ReplayWriter, WhatIsFlushedOnRequestSurvivesACrash) {
  BufferedDisk disk;
  Recorder<toy::Game> recorder(disk.sink());
  toy::Game game;
  ASSERT_TRUE(recorder.begin(game, toy::header()));
  for (std::uint64_t i = 1; i <= 50; ++i) {
    ASSERT_TRUE(game.step_recorded(toy::input_of(i)));
    ASSERT_TRUE(recorder.frame(toy::input_of(i), game.hash()));
    if (i % 17 != 0) continue;
    ASSERT_TRUE(recorder.flush());
    EXPECT_EQ(ReplayReader(disk.safe).frame_count(), i);
  }
  ASSERT_TRUE(recorder.keyframe(game));
  ASSERT_TRUE(recorder.flush());
  EXPECT_EQ(ReplayReader(disk.safe).keyframes().size(), 1u) << "no frames since, and yet something to flush";
  disk.refuses = true;
  const Result<void> flushed = recorder.flush();
  ASSERT_FALSE(flushed);
  EXPECT_EQ(flushed.error().code, ErrorCode::sink);
  EXPECT_FALSE(recorder.finish()) << "errors stay";
}

TEST(ReplayWriter, RefusesCallsOutOfOrder) {
  Buffer file;
  ReplayWriter early(sink_to(file));
  EXPECT_FALSE(early.frame({}, 0));
  EXPECT_FALSE(early.begin(toy::header(), {}, 0));
  ReplayWriter twice(sink_to(file));
  EXPECT_TRUE(twice.begin(toy::header(), {}, 0));
  EXPECT_FALSE(twice.begin(toy::header(), {}, 0));
  ReplayWriter late(sink_to(file));
  EXPECT_TRUE(late.begin(toy::header(), {}, 0));
  EXPECT_TRUE(late.finish());
  EXPECT_FALSE(late.frame({}, 0));
}

TEST(ReplayWriter, LargeInputsEndABlockEarlyAndTooLargeOnesAreRefused) {
  Buffer file;
  ReplayWriter writer(sink_to(file));
  ASSERT_TRUE(writer.begin(toy::header(), {}, 0));
  const Buffer large(kReplayFrameInputCap, 0x5a);
  for (std::uint64_t i = 0; i < 5; ++i) ASSERT_TRUE(writer.frame(large, i));
  ASSERT_TRUE(writer.finish());
  const ReplayReader replay(file);
  EXPECT_EQ(replay.status(), ReplayStatus::complete);
  ASSERT_EQ(replay.frame_count(), 5u);
  for (std::uint64_t i = 0; i < 5; ++i) {
    EXPECT_EQ(replay.frame(i).input.size(), large.size());
    EXPECT_EQ(replay.frame(i).hash, i);
  }
  ReplayWriter refuses(sink_to(file));
  ASSERT_TRUE(refuses.begin(toy::header(), {}, 0));
  const Result<void> result = refuses.frame(Buffer(kReplayFrameInputCap + 1), 0);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::limit);
}

TEST(ReplayWriter, AChunkOfTheCallersOwnChangesNoOutcomeAndIsThereToBeRead) {
  Buffer file;
  toy::Game game;
  Recorder<toy::Game> recorder(sink_to(file));
  ASSERT_TRUE(recorder.begin(game, toy::header()));
  for (std::uint64_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(game.step_recorded(toy::input_of(i)));
    ASSERT_TRUE(recorder.frame(toy::input_of(i), game.hash()));
    const Buffer chat = {'h', 'i'};
    if (i % 10 == 0) {
      ASSERT_TRUE(recorder.writer().ancillary(replay_chunk_type('c', 'H', 'A', 'T'), chat));
    }
  }
  ASSERT_TRUE(recorder.finish());
  EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::verified);
  const ReplayReader replay(file);
  ASSERT_EQ(replay.ancillaries().size(), 10u);
  EXPECT_EQ(replay.ancillaries()[9].type, replay_chunk_type('c', 'H', 'A', 'T'));
  EXPECT_EQ(replay.ancillaries()[9].payload[1], 'i');
  for (const std::uint32_t type : {replay_chunk_type('C', 'H', 'A', 'T'), replay_chunk_type('c', 'H', 'A', '1'), 0u}) {
    Buffer other;
    ReplayWriter writer(sink_to(other));
    ASSERT_TRUE(writer.begin(toy::header(), {}, 0));
    EXPECT_FALSE(writer.ancillary(type, {}));
  }
}

}  // namespace replay_writer_test
}  // namespace isostep
