// A recorded toy game, and the means to take its file apart and forge it, for the tests of replays.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "isostep/core/crc32c.hpp"
#include "toy.hpp"

namespace toy {

using Buffer = std::vector<std::uint8_t>;

inline ReplayIdentity identity() {
  ReplayIdentity id{};
  id.behaviour = 0x1122334455667788u;
  id.scalar = ScalarTraits<Q32_32>::kName;
  id.scalar_id = ScalarTraits<Q32_32>::kId;
  id.hz = 60;
  id.substeps = 4;
  id.solver = "soft_step";
  id.settings_digest = 0xabcdefu;
  id.scene = "toy";
  return id;
}
inline ReplayHeader header() { return make_replay_header(identity()).value(); }

/// The inputs of frame i: two players, or three now and then.
inline Buffer input_of(std::uint64_t i) {
  Buffer bytes = {static_cast<std::uint8_t>(i * 7), static_cast<std::uint8_t>(i % 5 == 0), 3, 0};
  if (i % 11 == 10) bytes.insert(bytes.end(), {200, 1});
  return bytes;
}

/// `keyframe_every` 0: none.
inline Buffer record(std::uint64_t frames, std::uint64_t keyframe_every = 0, bool finish = true) {
  Buffer file;
  Game game;
  Recorder<Game> recorder(sink_to(file));
  bool ok = recorder.begin(game, header()).ok();
  for (std::uint64_t i = 0; i < frames; ++i) {
    const Buffer input = input_of(i);
    ok = game.step_recorded(input).ok() && recorder.frame(input, game.hash()).ok() && ok;
    if (keyframe_every != 0 && (i + 1) % keyframe_every == 0) ok = recorder.keyframe(game).ok() && ok;
  }
  if (finish) ok = recorder.finish().ok() && ok;
  if (!ok) __builtin_trap();
  return file;
}

inline VerifyResult verify_toy(Bytes file) {
  const ReplayReader replay(file);
  const ReplayHeader here = header();
  Game game;
  return verify_replay(replay, game, SameHeader{here});
}

struct Part {
  std::uint32_t type;
  Buffer payload;
};

/// The chunks of a well-formed file.
inline std::vector<Part> take_apart(const Buffer& file) {
  std::vector<Part> parts;
  for (std::size_t at = kReplayPreambleSize; at < file.size();) {
    const auto length = load_le<std::uint32_t>(&file[at + 4]);
    const auto* payload = &file[at] + 12;
    parts.push_back({load_le<std::uint32_t>(&file[at]), Buffer(payload, payload + length)});
    at += 16 + length;
  }
  return parts;
}

inline void put_part(Buffer& file, const Part& part) {
  const std::size_t start = file.size();
  Writer writer(file);
  writer.write(part.type);
  writer.write(static_cast<std::uint32_t>(part.payload.size()));
  writer.write(static_cast<std::uint32_t>(part.payload.size()));
  writer.write_raw(part.payload);
  writer.write(crc32c(Bytes(file).subspan(start)));
}

/// A file of these chunks with every checksum right, and DONE's digest too: what a forger would make.
inline Buffer put_together(const std::vector<Part>& parts) {
  const Buffer empty = record(0);
  Buffer file(empty.begin(), empty.begin() + kReplayPreambleSize);
  for (Part part : parts) {
    if (part.type == replay_chunk::kDone && part.payload.size() == 16) {
      store_le(&part.payload[8], hash_bytes(file.data(), file.size()));
    }
    put_part(file, part);
  }
  return file;
}

}  // namespace toy
