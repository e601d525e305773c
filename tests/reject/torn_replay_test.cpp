// A recording after a power failure: a beginning, and zeros where bytes were not written yet. It is cut, not damaged:
// whole blocks before the zeros play.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../unit/state/recording.hpp"

namespace isostep {
namespace torn_replay_test {

using toy::Buffer;

constexpr std::size_t kPage = 4096;  // [bytes]

/// Inputs of `size` bytes of noise without a zero, so that files have as many pages as a test wants.
Buffer long_replay(std::uint64_t frames, std::size_t size, bool finish) {
  Buffer file, input(size);
  ReplayWriter writer(sink_to(file));
  bool ok = writer.begin(toy::header(), Buffer(40, 7), 1).ok();
  std::uint32_t noise = 1;
  for (std::uint64_t i = 0; i < frames; ++i) {
    for (std::uint8_t& byte : input) {
      noise = noise * 1664525u + 1013904223u;
      byte = static_cast<std::uint8_t>(1 + noise % 255);
    }
    ok = writer.frame(input, i).ok() && ok;
  }
  if (finish) ok = writer.finish().ok() && ok;
  EXPECT_TRUE(ok);
  return file;
}

/// Expects TRUNCATED, with the frames of the blocks that are whole before `intact`.
void expect_torn(const Buffer& file, std::size_t intact, const char* what, std::size_t at) {
  const ReplayReader whole(Bytes(file).first(intact < file.size() ? intact : file.size()));
  const ReplayReader torn(file);
  ASSERT_EQ(torn.status(), ReplayStatus::truncated) << what << " " << at << ": " << torn.error().message.view();
  ASSERT_GE(torn.frame_count(), whole.frame_count()) << what << " " << at;
  ASSERT_LE(torn.place(), intact) << what << " " << at;
  ASSERT_EQ(torn.has_state(), whole.has_state()) << what << " " << at;
}

TEST(TornReplay, CutAtEveryByteWithZerosBehindPlaysItsWholeBlocks) {
  const Buffer file = toy::record(200, 70);
  const ReplayReader whole(file);
  std::uint64_t most = 0;
  for (std::size_t cut = 0; cut <= file.size(); ++cut) {
    for (const std::size_t zeros : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{7}, std::size_t{12},
                                    std::size_t{16}, std::size_t{100}, kPage - cut % kPage, 3 * kPage}) {
      Buffer torn(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(cut));
      torn.resize(cut + zeros);
      if (torn == file) continue;  // the byte cut off was a zero
      expect_torn(torn, cut, "zeros after byte", cut);
      const VerifyResult result = toy::verify_toy(torn);
      ASSERT_EQ(result.outcome, VerifyOutcome::truncated) << cut << " + " << zeros << ": " << describe(result);
      ASSERT_EQ(result.frames, ReplayReader(torn).frame_count());
      most = result.frames;
    }
  }
  EXPECT_EQ(most, whole.frame_count());
}

TEST(TornReplay, ZeroedFromEveryByteToTheEndOfItsPageOrOfTheFile) {
  const Buffer file = long_replay(110, 90, true);
  ASSERT_GT(file.size(), 2 * kPage);
  for (std::size_t from = kReplayPreambleSize; from < file.size(); ++from) {
    Buffer torn = file;
    std::fill(torn.begin() + static_cast<std::ptrdiff_t>(from), torn.end(), std::uint8_t{0});
    if (torn != file) expect_torn(torn, from, "zeros from", from);
    // The page alone: what lies behind was written. So few zeros say nothing where they end the page.
    const std::size_t end = (from / kPage + 1) * kPage;
    if (end > file.size() || end - from < 64) continue;
    torn = file;
    std::fill(torn.begin() + static_cast<std::ptrdiff_t>(from), torn.begin() + static_cast<std::ptrdiff_t>(end), 0);
    expect_torn(torn, from, "a page from", from);
  }
}

TEST(TornReplay, PagesThatWereNotWrittenWhateverWasBehindThem) {
  const Buffer file = long_replay(900, 90, false);
  const std::size_t pages = file.size() / kPage;
  ASSERT_GT(pages, 16u);
  for (std::uint32_t mask = 1; mask < 1u << 12; mask += 7) {  // pages 1 to 12, in any order
    Buffer torn = file;
    std::size_t first = 0;
    for (std::size_t page = 12; page >= 1; --page) {
      if ((mask >> (page - 1) & 1u) == 0) continue;
      std::fill_n(torn.begin() + static_cast<std::ptrdiff_t>(page * kPage), kPage, std::uint8_t{0});
      first = page * kPage;
    }
    expect_torn(torn, first, "pages", mask);
  }
}

TEST(TornReplay, WhatIsDamagedBeforeTheZerosIsCorrupt) {
  const Buffer file = toy::record(130, 0, false);
  for (std::size_t at = 0; at < file.size(); ++at) {
    Buffer torn = file;
    torn.resize(file.size() + kPage);
    torn[at] ^= 0x40;
    if (torn[at] == 0 && at + 4 >= file.size()) continue;  // its last bytes: as if they had not been written
    const ReplayReader replay(torn);
    ASSERT_EQ(replay.status(), ReplayStatus::corrupt) << at;
  }
}

TEST(TornReplay, OtherBytesThanZerosBehindItAreCorrupt) {
  for (const bool finish : {false, true}) {
    for (const std::uint8_t last : {1, 0x5a, 0xff}) {
      Buffer file = toy::record(130, 0, finish);
      file.resize(file.size() + 40);
      file.back() = last;
      EXPECT_EQ(toy::verify_toy(file).outcome, VerifyOutcome::corrupt);
    }
  }
}

TEST(TornReplay, OfASparseFileWithoutAnyDataNothingIsThere) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{31}, std::size_t{32}, kPage, 100 * kPage}) {
    const ReplayReader replay(Buffer(size, 0));
    EXPECT_EQ(replay.status(), ReplayStatus::truncated) << size;
    EXPECT_FALSE(replay.has_header());
  }
}

}  // namespace torn_replay_test
}  // namespace isostep
