// Desync bundles: what one peer's world went through since all peers last agreed, as a replay.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/world/frame_history.hpp"
#include "isostep/world/recorder.hpp"

namespace isostep {

namespace replay_chunk {
/// A bundle's facts: see replays/README.md.
inline constexpr std::uint32_t kPeer = replay_chunk_type('p', 'E', 'E', 'R');
}  // namespace replay_chunk

/// What a replay has no place for.
struct BundleFacts {
  std::uint32_t player = 0;           // whose bundle it is; 0xff: the host's machine
  Frame first = 0;                    // the session's number of the file's frame 0
  Frame agreed = kNoFrame;            // the last state that all had alike; kNoFrame: not known
  std::vector<std::uint64_t> roots;   // of the whole game after each frame
  std::vector<std::uint64_t> stages;  // kTraceHashes for each frame, or none
};

ISO_INLINE void write_facts(Writer& writer, const BundleFacts& facts) {
  writer.write(facts.player);
  writer.write(facts.first);
  writer.write(facts.agreed);
  writer.write_array(facts.roots);
  writer.write_array(facts.stages);
}
/// `frames`: as many as the replay has.
ISO_INLINE Result<BundleFacts> read_facts(Bytes payload, std::uint64_t frames) {
  constexpr std::uint32_t most = kReplayUnknownCap / 8;
  BundleFacts facts;
  Reader reader(payload);
  reader.read(facts.player);
  reader.read(facts.first);
  reader.read(facts.agreed);
  reader.read_array(facts.roots, most);
  reader.read_array(facts.stages, most);
  reader.expect_end();
  const bool in_range = facts.first >= 0 && facts.first <= kLastFrame;
  if (!in_range) reader.fail(ErrorCode::invalid, "the first frame is out of range");
  if (facts.roots.size() != frames || (!facts.stages.empty() && facts.stages.size() != frames * kTraceHashes)) {
    reader.fail(ErrorCode::corrupt, "not as many roots or stage hashes as frames");
  }
  if (const Result<void> read = reader.result("pEER"); !read) return read.error();
  return facts;
}

struct BundleSettings {
  std::uint32_t player = 0;   // as in BundleFacts
  Frame agreed = kNoFrame;    // the desync event's: the bundle starts with this state, or with the oldest one kept
  std::uint32_t states = 16;  // written whole: those after so many of the first frames
};

/// Writes the confirmed frames that `history` keeps from `agreed` on, with the states that this peer really had. For
/// between two calls of `drive`, before a restart empties the history. Costs a world, and a portable form for every
/// state.
template <class S>
ISO_INLINE Result<void> write_bundle(ReplaySink sink, const FrameHistory<S>& history, std::string_view scene,
                                     const BundleSettings& settings) {
  const Frame end = history.last_confirmed() + 1;
  BundleFacts facts{settings.player, end, settings.agreed, {}, {}};
  const auto usable = [&](Frame frame) {
    const typename FrameHistory<S>::Kept* kept = history.find(frame);
    return kept != nullptr && kept->confirmed && history.state_before(frame) != nullptr;
  };
  while (facts.first > 0 && facts.first > settings.agreed && usable(facts.first - 1)) --facts.first;
  if (facts.first >= end) return Error{ErrorCode::invalid, "no confirmed frame with its state is kept", "bundle"};

  World<S> scratch(history.world().settings());
  scratch.load(*history.state_before(facts.first));
  const Result<ReplayHeader> header = make_replay_header(identity_of_world(scratch.settings(), scene));
  if (!header) return header.error();
  Recorder<World<S>> recorder(sink);
  Result<void> result = recorder.begin(scratch, header.value());
  for (Frame frame = facts.first; frame < end && result; ++frame) {
    const typename FrameHistory<S>::Kept& kept = *history.find(frame);
    facts.roots.push_back(kept.root);
    facts.stages.insert(facts.stages.end(), kept.stages.begin(), kept.stages.end());
    result = recorder.frame(kept.tape, kept.hash);
    if (!result || static_cast<std::uint32_t>(frame - facts.first) >= settings.states) continue;
    scratch.load(kept.state);
    result = recorder.keyframe(scratch);
  }
  if (!result) return result;
  if (facts.stages.size() != facts.roots.size() * kTraceHashes) facts.stages.clear();
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  write_facts(writer, facts);
  if (result = recorder.writer().ancillary(replay_chunk::kPeer, bytes); !result) return result;
  return recorder.finish();
}

}  // namespace isostep
