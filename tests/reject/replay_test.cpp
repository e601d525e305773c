// Damaged, cut, extended and forged replays: never VERIFIED, never a crash, and the outcome says what is wrong.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../unit/state/recording.hpp"

namespace isostep {
namespace replay_test {

using toy::Buffer;
using toy::Part;

const Buffer& small_replay() {
  static const Buffer file = toy::record(70, 35);
  return file;
}

TEST(RejectReplay, EveryByteChangedInAnyBitIsCorrupt) {
  Buffer file = small_replay();
  for (std::size_t at = 0; at < file.size(); ++at) {
    const std::uint8_t good = file[at];
    for (const unsigned flip : {0x01u, 0x02u, 0x04u, 0x08u, 0x10u, 0x20u, 0x40u, 0x80u, 0xffu}) {
      file[at] = static_cast<std::uint8_t>(good ^ flip);
      const VerifyResult result = toy::verify_toy(file);
      if (at + 1 == file.size() && file[at] == 0) continue;  // as if it had not been written: torn_replay_test.cpp
      ASSERT_EQ(result.outcome, VerifyOutcome::corrupt) << "byte " << at << " ^ " << flip << ": " << describe(result);
      ASSERT_EQ(exit_code(result.outcome), 4);
      ASSERT_LE(result.offset, at);
    }
    file[at] = good;
  }
  EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::verified);
}

TEST(RejectReplay, CutAtEveryLengthIsTruncatedWithItsWholeBlocks) {
  const Buffer& file = small_replay();
  const ReplayReader whole(file);
  std::uint64_t most = 0;
  for (std::size_t length = 0; length < file.size(); ++length) {
    const Buffer cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
    const VerifyResult result = toy::verify_toy(cut);
    ASSERT_EQ(result.outcome, VerifyOutcome::truncated) << length << ": " << describe(result);
    ASSERT_LE(result.offset, length);
    ASSERT_GE(result.frames, most);
    most = result.frames;
    const ReplayReader part(cut);
    for (std::uint64_t i = 0; i < part.frame_count(); ++i) ASSERT_EQ(part.frame(i).hash, whole.frame(i).hash);
  }
  EXPECT_EQ(most, 70u);
}

TEST(RejectReplay, BytesAfterTheEndAreCorrupt) {
  for (const unsigned filler : {0x01u, 0x5au, 0xffu}) {
    Buffer file = small_replay();
    const std::size_t end = file.size();
    for (int n = 1; n <= 16; ++n) {
      file.push_back(static_cast<std::uint8_t>(filler));
      const VerifyResult result = toy::verify_toy(file);
      ASSERT_EQ(result.outcome, VerifyOutcome::corrupt);
      ASSERT_EQ(result.offset, end);
    }
  }
  Buffer twice = small_replay();
  twice.insert(twice.end(), small_replay().begin(), small_replay().end());
  EXPECT_EQ(toy::verify_toy(twice).outcome, VerifyOutcome::corrupt);
}

TEST(RejectReplay, BytesTakenOutOrPutInAreNeverVerified) {
  for (std::size_t at = 0; at < small_replay().size(); ++at) {
    Buffer file = small_replay();
    file.erase(file.begin() + static_cast<std::ptrdiff_t>(at));
    ASSERT_NE(toy::verify_toy(file).outcome, VerifyOutcome::verified);
    file = small_replay();
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(at), 0);
    ASSERT_NE(toy::verify_toy(file).outcome, VerifyOutcome::verified);
  }
}

// Every checksum is right from here on: a forger can compute them as well as we can.

std::vector<Part> parts() { return toy::take_apart(small_replay()); }
VerifyOutcome outcome_of(const std::vector<Part>& forged) { return toy::verify_toy(toy::put_together(forged)).outcome; }

std::size_t find(const std::vector<Part>& all, std::uint32_t type) {
  std::size_t at = 0;
  while (all[at].type != type) ++at;
  return at;
}

TEST(ForgedReplay, ToolsOfThisTestPutAFileTogetherAsItWas) { EXPECT_EQ(toy::put_together(parts()), small_replay()); }

TEST(ForgedReplay, EveryByteOfEveryPayloadStillCounts) {
  const std::vector<Part> good = parts();
  for (std::size_t p = 0; p < good.size(); ++p) {
    for (std::size_t at = 0; at < good[p].payload.size(); ++at) {
      std::vector<Part> forged = good;
      forged[p].payload[at] ^= 0x01;
      const Buffer file = toy::put_together(forged);
      if (file == small_replay()) continue;  // DONE's digest, made right again
      const VerifyResult result = toy::verify_toy(file);
      if (result.outcome == VerifyOutcome::verified) {
        // What may change without being noticed is what is said to be informative.
        ASSERT_EQ(good[p].type, replay_chunk::kHead);
        const ReplayReader replay(file);
        ASSERT_TRUE(compare_headers(replay.header(), toy::header()).key.empty());
      }
    }
  }
}

TEST(ForgedReplay, AnotherHashIsDivergedAtItsFrame) {
  std::vector<Part> forged = parts();
  forged[find(forged, replay_chunk::kHash)].payload[12 + 8 * 20] ^= 1;
  const VerifyResult result = toy::verify_toy(toy::put_together(forged));
  EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
  EXPECT_EQ(result.where, VerifyResult::Where::frame);
  EXPECT_EQ(result.frames, 20u);
  EXPECT_EQ(result.expected ^ result.actual, 1u);
}

TEST(ForgedReplay, AnotherInputIsDiverged) {
  std::vector<Part> forged = parts();
  forged[find(forged, replay_chunk::kInput)].payload[12 + 4] ^= 2;  // frame 0, first player's push
  const VerifyResult result = toy::verify_toy(toy::put_together(forged));
  EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
  EXPECT_EQ(result.frames, 0u);
}

TEST(ForgedReplay, AnInputThatTheSimulationRefusesIsCorruptAtItsPlace) {
  std::vector<Part> forged = parts();
  forged[find(forged, replay_chunk::kInput)].payload[12 + 4 + 1] = 77;
  const Buffer file = toy::put_together(forged);
  const VerifyResult result = toy::verify_toy(file);
  EXPECT_EQ(result.outcome, VerifyOutcome::corrupt);
  EXPECT_EQ(file[result.offset + 1], 77);
  EXPECT_EQ(result.error.message.view(), "spawn is 0 or 1");
}

TEST(ForgedReplay, AnotherStartIsDivergedOrCorrupt) {
  std::vector<Part> forged = parts();
  const std::size_t init = find(forged, replay_chunk::kInit);
  forged[init].payload[8] ^= 1;
  VerifyResult result = toy::verify_toy(toy::put_together(forged));
  EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
  EXPECT_EQ(result.where, VerifyResult::Where::start);
  forged = parts();
  forged[init].payload.push_back(0);
  EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  forged = parts();
  forged[init].payload.pop_back();
  EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  for (std::size_t size = 0; size < 8; ++size) {
    forged[init].payload.resize(size);
    const Buffer file = toy::put_together(forged);
    const ReplayReader replay(file);
    EXPECT_EQ(replay.status(), ReplayStatus::corrupt);
    EXPECT_FALSE(replay.has_state());
  }
}

TEST(ForgedReplay, AKeyframeThatIsNotTheStateIsDiverged) {
  const std::size_t key = find(parts(), replay_chunk::kKeyframe);
  for (const std::size_t at : {8u, 16u, 60u}) {  // its hash, and two places of its state
    std::vector<Part> forged = parts();
    forged[key].payload[at] ^= 1;
    const VerifyResult result = toy::verify_toy(toy::put_together(forged));
    EXPECT_EQ(result.outcome, VerifyOutcome::diverged);
    EXPECT_EQ(result.where, VerifyResult::Where::keyframe);
    EXPECT_EQ(result.frames, 35u);
  }
  std::vector<Part> forged = parts();
  forged[key].payload[0] ^= 1;
  EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  forged = parts();
  forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(key), forged[key]);
  EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
}

TEST(ForgedReplay, ChunksLeftOutDoubledOrSwappedAreNeverVerified) {
  const std::vector<Part> good = parts();
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<Part> forged = good;
    forged.erase(forged.begin() + static_cast<std::ptrdiff_t>(i));
    const VerifyOutcome without = outcome_of(forged);
    if (good[i].type == replay_chunk::kKeyframe) {
      EXPECT_EQ(without, VerifyOutcome::verified);
    } else if (good[i].type == replay_chunk::kDone) {
      EXPECT_EQ(without, VerifyOutcome::truncated);
    } else {
      EXPECT_EQ(without, VerifyOutcome::corrupt);
    }
    forged = good;
    forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(i), good[i]);
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
    for (std::size_t j = i + 1; j < good.size(); ++j) {
      forged = good;
      std::swap(forged[i], forged[j]);
      EXPECT_NE(outcome_of(forged), VerifyOutcome::verified) << i << " " << j;
    }
  }
}

TEST(ForgedReplay, AnUnknownAncillaryChunkIsSkippedAnywhereAndACriticalOneRefused) {
  const std::vector<Part> good = parts();
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<Part> forged = good;
    const Part news{replay_chunk_type('n', 'E', 'W', 'S'), {1, 2, 3}};
    forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(i), news);
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::verified);
    forged[i].type = replay_chunk_type('N', 'E', 'W', 'S');
    const VerifyResult result = toy::verify_toy(toy::put_together(forged));
    EXPECT_EQ(result.outcome, VerifyOutcome::incompatible);
    EXPECT_EQ(result.mismatch.key.view(), "format");
    forged[i].type = replay_chunk_type('n', '0', 'W', 'S');
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  }
  std::vector<Part> after = good;
  after.push_back({replay_chunk_type('n', 'E', 'W', 'S'), {}});
  EXPECT_EQ(outcome_of(after), VerifyOutcome::corrupt);
}

TEST(ForgedReplay, LengthsAboveTheirCapsAreRefusedUnread) {
  using namespace replay_chunk;
  const std::uint32_t unknown = replay_chunk_type('n', 'E', 'W', 'S');
  for (const std::uint32_t type : {kHead, kInit, kInput, kHash, kKeyframe, kDone, unknown}) {
    Buffer file(small_replay().begin(), small_replay().begin() + kReplayPreambleSize);
    Writer writer(file);
    writer.write(type);
    writer.write(replay_payload_cap(type) + 1);
    writer.write(replay_payload_cap(type) + 1);
    const ReplayReader above(file);
    EXPECT_EQ(above.status(), ReplayStatus::corrupt);
    EXPECT_EQ(above.place(), kReplayPreambleSize + 4);
    store_le(&file[kReplayPreambleSize + 4], replay_payload_cap(type));
    store_le(&file[kReplayPreambleSize + 8], replay_payload_cap(type));
    const ReplayReader at(file);
    EXPECT_EQ(at.status(), ReplayStatus::truncated);
  }
}

TEST(ForgedReplay, CountsThatDoNotFitTheirChunkAreCorrupt) {
  const std::size_t input = find(parts(), replay_chunk::kInput);
  const std::size_t hash = find(parts(), replay_chunk::kHash);
  for (const std::uint32_t count : {0u, 1u, 34u, 36u, 60u, 61u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    std::vector<Part> forged = parts();
    store_le(&forged[input].payload[8], count);
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
    store_le(&forged[hash].payload[8], count);
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
    forged = parts();
    store_le(&forged[input].payload[12], count + 1000);  // the first frame's length
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
    forged = parts();
    store_le(&forged[0].payload[0], count);  // fields of HEAD
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  }
  for (const std::uint64_t first : {std::uint64_t{1}, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
    std::vector<Part> forged = parts();
    store_le(&forged[input].payload[0], first);
    store_le(&forged[hash].payload[0], first);
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  }
}

TEST(ForgedReplay, ABlockHoldsOneToSixtyFrames) {
  for (const std::uint32_t count : {0u, 1u, 60u, 61u}) {
    Part input{replay_chunk::kInput, Buffer(12 + 4 * count)};
    Part hash{replay_chunk::kHash, Buffer(12 + 8 * count)};
    Part done{replay_chunk::kDone, Buffer(16)};
    for (Part* part : {&input, &hash}) store_le(&part->payload[8], count);
    store_le(done.payload.data(), std::uint64_t{count});
    const Buffer file = toy::put_together({parts()[0], parts()[1], input, hash, done});
    const bool good = count >= 1 && count <= 60;
    EXPECT_EQ(ReplayReader(file).status(), good ? ReplayStatus::complete : ReplayStatus::corrupt) << count;
  }
}

TEST(ForgedReplay, DoneMustCountTheFramesAndDigestTheBytes) {
  std::vector<Part> forged = parts();
  forged.back().payload[0] += 1;
  EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  Buffer file = toy::put_together(parts());
  file.resize(file.size() - 32);
  Part done = parts().back();
  done.payload[8] ^= 1;
  toy::put_part(file, done);
  EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::corrupt);
}

TEST(ForgedReplay, HeadersWithDoubledEmptyOrUnprintableFieldsAreCorrupt) {
  const struct {
    const char *key_a, *key_b, *value;
  } rows[] = {{"hz", "hz", "60"}, {"hz", "", "60"}, {"hz", "sub\n", "60"}, {"hz", "substeps", ""}};
  for (const auto& row : rows) {
    std::vector<Part> forged = parts();
    Buffer& head = forged[0].payload;
    head.clear();
    Writer writer(head);
    writer.write_count(2);
    for (const char* key : {row.key_a, row.key_b}) {
      writer.write(true);
      writer.write_text(key);
      writer.write_text(row.value);
    }
    EXPECT_EQ(outcome_of(forged), VerifyOutcome::corrupt);
  }
}

TEST(ForgedReplay, OtherFormatVersionsAndFlagsAreIncompatible) {
  const struct {
    std::size_t at;
    std::uint8_t value;
    VerifyOutcome outcome;
  } rows[] = {{8, 1, VerifyOutcome::incompatible},
              {9, 1, VerifyOutcome::incompatible},
              {12, 64, VerifyOutcome::incompatible},
              {16, 1, VerifyOutcome::incompatible},
              {27, 1, VerifyOutcome::incompatible}};
  for (const auto& row : rows) {
    Buffer file = small_replay();
    file[row.at] = row.value;
    store_le(&file[28], crc32c(Bytes(file).first(28)));
    EXPECT_EQ(toy::verify_toy(file).outcome, row.outcome) << row.at;
  }
  // A later minor version is read; here DONE's digest, which covers the preamble, is made right as well.
  Buffer minor = small_replay();
  minor[10] = 9;
  store_le(&minor[28], crc32c(Bytes(minor).first(28)));
  minor.resize(minor.size() - 32);
  Part done = parts().back();
  store_le(&done.payload[8], hash_bytes(minor.data(), minor.size()));
  toy::put_part(minor, done);
  EXPECT_EQ(toy::verify_toy(minor).outcome, VerifyOutcome::verified);
}

TEST(RejectReplay, ATransferAsTextIsSeenAtOnce) {
  Buffer file = small_replay();
  file.erase(file.begin() + 4);  // CR LF to LF
  EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::corrupt);
  EXPECT_EQ(toy::verify_toy(file).offset, 0u);
  const Buffer png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  EXPECT_EQ(toy::verify_toy(png).outcome, VerifyOutcome::corrupt);
}

}  // namespace replay_test
}  // namespace isostep
