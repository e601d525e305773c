// libFuzzer target: any bytes as a replay, as they are and with every checksum made right, so that what lies behind the
// checksums is reached too; and as a command log of a world and the facts of a bundle.
// SPDX-License-Identifier: MIT
//
// clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -Dalways_inline= -Iscalar/include -Iinclude
//         tests/fuzz/replay_fuzz.cpp src/isostep/{geometry,state}/*.cpp scalar/src/*.cpp build/release/libisostep.a
//         -o replay_fuzz

#include <cstddef>
#include <cstdint>

#include "../unit/state/recording.hpp"
#include "isostep/replay/desync_bundle.hpp"

namespace {

using namespace isostep;
using toy::Buffer;

void require(bool condition) {
  if (!condition) __builtin_trap();
}

/// Makes lengths, checksums and digest agree as far as the chunks can be followed.
void seal(Buffer& file) {
  if (file.size() < kReplayPreambleSize) file.resize(kReplayPreambleSize);
  std::memcpy(file.data(), kReplayMagic, sizeof kReplayMagic);
  store_le(&file[28], crc32c(Bytes(file).first(28)));
  for (std::size_t at = kReplayPreambleSize; file.size() - at >= 16;) {
    const std::uint32_t type = load_le<std::uint32_t>(&file[at]);
    const std::size_t length = load_le<std::uint32_t>(&file[at + 4]);
    if (length > file.size() - at - 16) return;
    store_le(&file[at + 8], static_cast<std::uint32_t>(length));
    if (type == replay_chunk::kDone && length == 16) store_le(&file[at + 20], hash_bytes(file.data(), at));
    store_le(&file[at + 12 + length], crc32c(Bytes(file).subspan(at, 12 + length)));
    at += 16 + length;
  }
}

/// Facts that are accepted are what a writer would write, and fit their frames.
void check_facts(Bytes payload, std::uint64_t frames) {
  const Result<BundleFacts> facts = read_facts(payload, frames);
  if (!facts) return;
  require(facts.value().game_hashes.size() == frames);
  Buffer again;
  Writer writer(again);
  write_facts(writer, facts.value());
  require(isostep::detail::same_bytes(again, payload));
}

template <class S> void check_command_log(Bytes log) {
  std::uint32_t commands = 0, steps = 0;
  const Result<void> played = play_commands<EveryCommand<S>>(
      log, [&](const auto&) { return ++commands != 1000; }, [&] { ++steps; });
  require(steps <= kFrameStepCap && commands <= 1000 && commands + steps <= log.size());
  if (played) require(log.empty() == (commands + steps == 0));
}

/// Everything the reader hands out must lie inside the file; its memory was checked by the sanitizer on the way.
void read_all(const ReplayReader& replay, Bytes file) {
  std::uint64_t last = 0;
  for (std::uint64_t i = 0; i < replay.frame_count(); ++i) {
    const ReplayFrame frame = replay.frame(i);
    const std::size_t at = replay.offset_of(frame.input);
    require(at > last && at <= file.size() && frame.input.size() <= file.size() - at);
    last = at;
  }
  for (const ReplayKeyframe& key : replay.keyframes()) require(key.frames <= replay.frame_count());
  for (const ReplayAncillary& chunk : replay.ancillaries()) check_facts(chunk.payload, replay.frame_count());
  require((replay.status() == ReplayStatus::complete) == replay.error().message.empty());
  require(replay.place() <= file.size());
  if (replay.has_header()) (void)identity_of(replay.header()).ok();
}

void check(const Buffer& file) {
  static const ReplayHeader here = toy::header();
  const ReplayReader replay(file);
  read_all(replay, file);

  toy::Game game;
  const VerifyResult result = verify_replay(replay, game, SameHeader{here});
  (void)describe(result);
  require(result.frames <= replay.frame_count());
  if (result.outcome == VerifyOutcome::verified) require(replay.status() == ReplayStatus::complete);
  if (replay.status() != ReplayStatus::complete) return;

  Buffer longer = file;
  longer.push_back(0);  // what a power failure leaves
  require(ReplayReader(longer).status() == ReplayStatus::truncated);
  require(ReplayReader(longer).frame_count() == replay.frame_count());
  longer.back() = 1;
  require(ReplayReader(longer).status() == ReplayStatus::corrupt);
  require(ReplayReader(Bytes(file).first(file.size() - 1)).status() == ReplayStatus::truncated);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Buffer file(data, data + size);
  check(file);
  seal(file);
  check(file);

  // The other readers of strange bytes: a header alone, a command log, facts of as many frames as they say, state of
  // the toy's own.
  (void)read_replay_header({data, size}).ok();
  check_command_log<float>({data, size});
  check_command_log<Q32_32>({data, size});
  check_facts({data, size}, size < 12 ? 0 : load_le<std::uint32_t>(data + 8));
  toy::Game game;
  Reader reader({data, size});
  (void)game.read_portable(reader).ok();
  return 0;
}
