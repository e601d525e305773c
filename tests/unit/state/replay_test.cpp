// Replays of a toy game: what is recorded verifies, and what differs is named.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "recording.hpp"

namespace isostep {
namespace replay_test {

using toy::Buffer;

TEST(Replay, ARecordingVerifies) {
  for (const std::uint64_t frames : {0u, 1u, 59u, 60u, 61u, 120u, 500u}) {
    const Buffer file = toy::record(frames);
    const VerifyResult result = toy::verify_toy(file);
    EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
    EXPECT_EQ(result.frames, frames);
    EXPECT_EQ(exit_code(result.outcome), 0);
  }
}

TEST(Replay, EveryFrameIsFoundByItsNumber) {
  const Buffer file = toy::record(130, 7);
  const ReplayReader replay(file);
  ASSERT_EQ(replay.status(), ReplayStatus::complete);
  ASSERT_EQ(replay.frame_count(), 130u);
  toy::Game game;
  for (std::uint64_t i = 0; i < 130; ++i) {
    const Bytes input = replay.frame(i).input;
    EXPECT_EQ(Buffer(input.begin(), input.end()), toy::input_of(i));
    ASSERT_TRUE(game.step_recorded(input));
    EXPECT_EQ(replay.frame(i).hash, game.hash());
  }
}

TEST(Replay, WatchingTwiceWithOneSimulationGivesTheSame) {
  const Buffer file = toy::record(70);
  const ReplayReader replay(file);
  const ReplayHeader here = toy::header();
  toy::Game game;
  EXPECT_EQ(verify_replay(replay, game, SameHeader{here}).outcome, VerifyOutcome::verified);
  EXPECT_EQ(verify_replay(replay, game, SameHeader{here}).outcome, VerifyOutcome::verified);
}

TEST(Replay, EndsWhereItsCallerHasNoMoreTime) {
  const Buffer file = toy::record(200);
  const ReplayReader replay(file);
  const ReplayHeader here = toy::header();
  for (const int frames : {0, 1, 60, 199, 200}) {
    toy::Game game;
    int left = frames;
    VerifySpan span;
    span.go_on = [](void* user) { return (*static_cast<int*>(user))-- > 0; };
    span.user = &left;
    const VerifyResult result = verify_replay(replay, game, SameHeader{here}, span);
    if (frames == 200) {  // nobody is asked once all is done
      EXPECT_EQ(result.outcome, VerifyOutcome::verified);
      continue;
    }
    EXPECT_EQ(result.outcome, VerifyOutcome::stopped);
    EXPECT_EQ(result.frames, static_cast<std::uint64_t>(frames));
    EXPECT_EQ(exit_code(result.outcome), 5);
    EXPECT_EQ(describe(result), "STOPPED before frame " + std::to_string(frames));
  }
}

TEST(Replay, AnotherSimulationDivergesAtTheFrameWhereItDiffers) {
  const Buffer file = toy::record(200);
  const ReplayReader replay(file);
  const ReplayHeader here = toy::header();
  for (const std::uint64_t frame : {0u, 1u, 59u, 60u, 137u, 199u}) {
    toy::Game game;
    game.bug_at = frame;
    const VerifyResult result = verify_replay(replay, game, SameHeader{here});
    EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
    EXPECT_EQ(exit_code(result.outcome), 1);
    EXPECT_EQ(result.frames, frame);
    EXPECT_EQ(result.expected, replay.frame(frame).hash);
    EXPECT_EQ(result.actual, game.hash());
    EXPECT_NE(result.actual, result.expected);
  }
}

TEST(Replay, ACutFileWhosePrefixDivergesIsDiverged) {
  const Buffer file = toy::record(200, 0, false);
  const ReplayReader replay(file);
  ASSERT_EQ(replay.status(), ReplayStatus::truncated);
  const ReplayHeader here = toy::header();
  toy::Game game;
  EXPECT_EQ(verify_replay(replay, game, SameHeader{here}).outcome, VerifyOutcome::truncated);
  game.bug_at = 100;
  EXPECT_EQ(verify_replay(replay, game, SameHeader{here}).outcome, VerifyOutcome::diverged);
}

TEST(Replay, WithoutItsEndAFilePlaysItsWholeBlocks) {
  const Buffer file = toy::record(200, 0, false);
  const VerifyResult result = toy::verify_toy(file);
  EXPECT_EQ(result.outcome, VerifyOutcome::truncated);
  EXPECT_EQ(exit_code(result.outcome), 3);
  EXPECT_EQ(result.frames, 180u);
  EXPECT_EQ(result.offset, file.size());
}

TEST(Replay, KeyframesAreCheckedAgainstTheStateReached) {
  const Buffer file = toy::record(100, 25);
  const ReplayReader replay(file);
  ASSERT_EQ(replay.keyframes().size(), 4u);
  EXPECT_EQ(replay.keyframes()[1].frames, 50u);
  EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::verified);

  toy::Game seeker;
  Reader reader(replay.keyframes()[1].state);
  ASSERT_TRUE(seeker.read_portable(reader));
  for (std::uint64_t i = 50; i < 100; ++i) ASSERT_TRUE(seeker.step_recorded(replay.frame(i).input));
  EXPECT_EQ(seeker.hash(), replay.frame(99).hash);
}

TEST(Replay, APartOfItIsComparedFromAStateInTheMiddle) {
  const Buffer file = toy::record(100, 25);
  const ReplayReader replay(file);
  const ReplayHeader here = toy::header();
  const Bytes state = replay.keyframes()[1].state;  // after 50 frames
  toy::Game game;
  VerifyResult result = verify_replay(replay, game, SameHeader{here}, {.first = 50, .state = state});
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(result.frames, 50u);
  EXPECT_EQ(game.hash(), replay.frame(99).hash);
  result = verify_replay(replay, game, SameHeader{here}, {.first = 50, .count = 7, .state = state});
  EXPECT_EQ(result.frames, 7u);
  EXPECT_EQ(game.hash(), replay.frame(56).hash);
  result = verify_replay(replay, game, SameHeader{here}, {.count = 30});
  EXPECT_EQ(result.frames, 30u);
  EXPECT_EQ(game.hash(), replay.frame(29).hash);

  game.bug_at = 70;
  result = verify_replay(replay, game, SameHeader{here}, {.first = 50, .state = state});
  EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
  EXPECT_EQ(result.frames, 70u);
  result = verify_replay(replay, game, SameHeader{here}, {.first = 51, .state = state});
  EXPECT_EQ(result.outcome, VerifyOutcome::diverged) << "not the state there";
  EXPECT_EQ(result.where, VerifyResult::Where::start);
  EXPECT_EQ(result.frames, 51u);
  EXPECT_EQ(
      verify_replay(replay, game, SameHeader{here}, {.first = 50, .state = state.first(state.size() - 1)}).outcome,
      VerifyOutcome::corrupt);
  result = verify_replay(replay, game, SameHeader{here}, {.first = 101, .state = state});
  EXPECT_EQ(result.outcome, VerifyOutcome::truncated);
  EXPECT_EQ(result.frames, 100u);
}

TEST(Replay, EveryRequiredFieldOfTheHeaderIsNamedWhenItDiffers) {
  const Buffer file = toy::record(3);
  const ReplayReader replay(file);
  const ReplayHeader good = toy::header();
  int required = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    ReplayHeader here = good;
    ASSERT_TRUE(here.set(good[i].key.view(), "other", good[i].required));
    toy::Game game;
    const VerifyResult result = verify_replay(replay, game, SameHeader{here});
    if (!good[i].required) {
      EXPECT_EQ(result.outcome, VerifyOutcome::verified) << good[i].key.view();
      continue;
    }
    ++required;
    EXPECT_EQ(result.outcome, VerifyOutcome::incompatible);
    EXPECT_EQ(exit_code(result.outcome), 2);
    EXPECT_EQ(result.mismatch.key.view(), good[i].key.view());
    EXPECT_EQ(result.mismatch.in_file.view(), good[i].value.view());
    EXPECT_EQ(result.mismatch.here.view(), "other");
  }
  EXPECT_EQ(required, 9);
}

TEST(Replay, ARequiredFieldThatOnlyOneSideKnowsIsNamed) {
  ReplayHeader more = toy::header();
  ASSERT_TRUE(more.set("input", "v2", true));
  HeaderMismatch mismatch = compare_headers(more, toy::header());
  EXPECT_EQ(mismatch.key.view(), "input");
  EXPECT_TRUE(mismatch.here.empty());
  mismatch = compare_headers(toy::header(), more);
  EXPECT_EQ(mismatch.key.view(), "input");
  EXPECT_TRUE(mismatch.in_file.empty());
  ASSERT_TRUE(more.set("input", "v2", false));
  EXPECT_TRUE(compare_headers(more, toy::header()).key.empty());
}

TEST(Replay, TheIdentityComesBack) {
  const ReplayHeader header = toy::header();
  const Result<ReplayIdentity> read = identity_of(header);
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value().behaviour, 0x1122334455667788u);
  EXPECT_EQ(read.value().scalar, "q32.32");
  EXPECT_EQ(read.value().scalar_id, ScalarTraits<Q32_32>::kId);
  EXPECT_EQ(read.value().hz, 60u);
  EXPECT_EQ(read.value().substeps, 4u);
  EXPECT_EQ(read.value().solver, "soft_step");
  EXPECT_EQ(read.value().settings_digest, 0xabcdefu);
  EXPECT_EQ(read.value().scene, "toy");
  EXPECT_EQ(read.value().hash_algorithm, "xxh3-64");
  EXPECT_EQ(read.value().engine, kVersionText);
}

TEST(Replay, TheKindOfWorldIsNamedAndRequiredWhereItIsNotRigidBodies) {
  EXPECT_EQ(toy::header().find("world"), nullptr);
  EXPECT_TRUE(identity_of(toy::header()).value().world.empty());
  ReplayIdentity identity = toy::identity();
  identity.world = "particles";
  const ReplayHeader particles = make_replay_header(identity).value();
  ASSERT_NE(particles.find("world"), nullptr);
  EXPECT_TRUE(particles.find("world")->required);
  EXPECT_EQ(identity_of(particles).value().world, "particles");
  EXPECT_EQ(compare_headers(particles, toy::header()).key.view(), "world");
  EXPECT_EQ(compare_headers(toy::header(), particles).key.view(), "world");
}

TEST(Replay, AHeaderWithoutAKindOfWorldIsByteForByteWhatItWasBeforeThereWereKinds) {
  Buffer expected;
  Writer writer(expected);
  writer.write(std::uint32_t{12});
  const auto field = [&](std::uint8_t required, std::string_view key, std::string_view value) {
    writer.write(required);
    writer.write_text(key);
    writer.write_text(value);
  };
  field(0, "engine", kVersionText);
  field(1, "behaviour", "1122334455667788");
  field(1, "scalar", "q32.32");
  field(1, "scalar_id", std::to_string(2u << 16 | 64u << 8 | 32u));
  field(1, "hz", "60");
  field(1, "substeps", "4");
  field(1, "solver", "soft_step");
  field(1, "settings", "0000000000abcdef");
  field(1, "hash", "xxh3-64");
  field(1, "scene", "toy");
  field(0, "compiler", compiler_name());
  field(0, "architecture", architecture_name());
  Buffer written;
  write_replay_header(toy::header(), written);
  EXPECT_EQ(written, expected);
}

TEST(Replay, AnIdentityThatIsNotOneNamesTheField) {
  for (const char* value : {"sixty", "-1", "60.0", "4294967296", "99999999999999999999", "0x10"}) {
    ReplayHeader header = toy::header();
    ASSERT_TRUE(header.set("hz", value, true));
    const Result<ReplayIdentity> read = identity_of(header);
    ASSERT_FALSE(read) << value;
    EXPECT_EQ(read.error().place.view(), "HEAD hz");
  }
  for (const char* value : {"12", "00000000000000zz", "00000000000000AB"}) {
    ReplayHeader header = toy::header();
    ASSERT_TRUE(header.set("settings", value, true));
    ASSERT_FALSE(identity_of(header)) << value;
    EXPECT_EQ(identity_of(header).error().place.view(), "HEAD settings");
  }
  ReplayIdentity nameless = toy::identity();
  nameless.scene = "";
  EXPECT_FALSE(make_replay_header(nameless));
}

TEST(Replay, AHeaderTakesOnlyShortPrintableFieldsAndNotTooMany) {
  ReplayHeader header;
  EXPECT_FALSE(header.set("", "x", true));
  EXPECT_FALSE(header.set("x", "", true));
  EXPECT_FALSE(header.set("line\n", "x", true));
  EXPECT_FALSE(header.set("x", "caf\xc3\xa9", true));
  EXPECT_FALSE(header.set(std::string(kReplayKeyCap + 1, 'k'), "x", true));
  EXPECT_FALSE(header.set("x", std::string(kReplayValueCap + 1, 'v'), true));
  for (std::size_t i = 0; i < kReplayFieldCap; ++i) EXPECT_TRUE(header.set(std::to_string(i), "x", true));
  EXPECT_FALSE(header.set("one more", "x", true));
  EXPECT_TRUE(header.set("7", "replaced", true));
  EXPECT_EQ(header.size(), kReplayFieldCap);
}

TEST(Replay, OutcomesAreDescribedInOneLine) {
  const Buffer file = toy::record(130);
  EXPECT_EQ(describe(toy::verify_toy(file)), "VERIFIED 130 frames");
  EXPECT_EQ(describe(toy::verify_toy(Bytes(file).first(file.size() - 1))),
            "TRUNCATED at frame 130: the file ends inside a chunk (byte " + std::to_string(file.size() - 32) + ")");
  const ReplayReader replay(file);
  ReplayHeader here = toy::header();
  ASSERT_TRUE(here.set("hz", "120", true));
  toy::Game game;
  EXPECT_EQ(describe(verify_replay(replay, game, SameHeader{here})),
            "INCOMPATIBLE: hz is \"60\" in the replay, \"120\" here");
}

}  // namespace replay_test
}  // namespace isostep
