// Desync bundles: what one peer's world went through since all peers last agreed, as a replay.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/replay/frame_history.hpp"
#include "isostep/replay/recorder.hpp"

namespace isostep {

namespace replay_chunk {
/// A bundle's facts: see replays/README.md.
inline constexpr std::uint32_t kPeer = replay_chunk_type('p', 'E', 'E', 'R');
}  // namespace replay_chunk

/// The facts that a replay has no place for.
struct BundleFacts {
  std::uint32_t player = 0;                // the owner of the bundle; 0xff: the host's machine
  Frame agreed = kNoFrame;                 // the last state that all had alike; kNoFrame: not known
  std::vector<std::uint64_t> game_hashes;  // of the whole game after each frame
  std::vector<std::uint32_t> steps;        // that were traced in each frame; none: trace was off
  std::vector<std::uint64_t> stages;       // kTraceHashes for each of them
  std::vector<Frame> changed_before;       // before whose step, after the frame before, something changed the world
};

ISO_INLINE void write_facts(Writer& writer, const BundleFacts& facts) {
  writer.write(facts.player);
  writer.write(facts.agreed);
  writer.write_array(facts.game_hashes);
  writer.write_array(facts.steps);
  writer.write_array(facts.stages);
  if (!facts.changed_before.empty()) writer.write_array(facts.changed_before);
}
/// Reads the facts. `frames`: how many the replay has. `trace_hashes`: those of one step, by the kind of world.
ISO_INLINE Result<BundleFacts> read_facts(Bytes payload, std::uint64_t frames,
                                          std::uint32_t trace_hashes = kTraceHashes) {
  BundleFacts facts;
  Reader reader(payload);
  reader.read(facts.player);
  reader.read(facts.agreed);
  reader.read_array(facts.game_hashes, kReplayUnknownCap / 8);
  reader.read_array(facts.steps, kReplayUnknownCap / 4);
  reader.read_array(facts.stages, kReplayUnknownCap / 8);
  if (reader.remaining() != 0) {
    reader.read_array(facts.changed_before, kReplayUnknownCap / 4);
    if (facts.changed_before.empty()) reader.fail(ErrorCode::corrupt, "a list of changes that holds none");
  }
  reader.expect_end();
  std::uint64_t steps = 0;  // fewer than 2^22 summands below 2^32
  for (const std::uint32_t n : facts.steps) steps += n;
  const bool in_range = facts.agreed >= kNoFrame && facts.agreed <= kLastFrame;
  if (!in_range) reader.fail(ErrorCode::invalid, "the agreed state is out of range");
  if (facts.game_hashes.size() != frames || (!facts.steps.empty() && facts.steps.size() != frames)) {
    reader.fail(ErrorCode::corrupt, "not as many hashes or step counts as frames");
  }
  if (facts.stages.size() != steps * trace_hashes) {
    reader.fail(ErrorCode::corrupt, "not as many stage hashes as the steps have");
  }
  if (const Result<void> read = reader.result("pEER"); !read) return read.error();
  return facts;
}

struct BundleSettings {
  std::uint32_t player = 0;   // as in BundleFacts
  Frame agreed = kNoFrame;    // the desync event's: the bundle starts with this state, or with the oldest one kept
  std::uint32_t states = 16;  // written whole: those after so many of the first frames; `frame - agreed` of the desync
                              // event are enough for `isostep diff` to have the one in which the peers part
};

/// Writes the confirmed frames that `history` keeps from `agreed` on, with the states that this peer really had. Call
/// it between two calls of `drive`, before a restart empties the history. It costs a world, and a portable form for
/// every state.
template <class S>
ISO_INLINE Result<void> write_bundle(ReplaySink sink, const FrameHistory<S>& history, std::string_view scene,
                                     const BundleSettings& settings) {
  const Frame end = history.last_confirmed() + 1;
  Frame first = end;
  const auto usable = [&](Frame frame) {
    const typename FrameHistory<S>::Kept* kept = history.find(frame);
    return kept != nullptr && kept->confirmed && history.state_before(frame) != nullptr;
  };
  while (first > 0 && first > settings.agreed && usable(first - 1)) --first;
  if (first >= end) return Error{ErrorCode::invalid, "no confirmed frame with its state is kept", "bundle"};

  World<S> scratch(history.world().settings());
  scratch.load(*history.state_before(first));
  const Result<ReplayHeader> header = header_of_world(scratch.settings(), scene, first);
  if (!header) return header.error();
  Recorder<World<S>> recorder(sink);
  Result<void> result = recorder.begin(scratch, header.value());
  BundleFacts facts{settings.player, settings.agreed, {}, {}, {}, {}};
  for (Frame frame = first; frame < end && result; ++frame) {
    const typename FrameHistory<S>::Kept& kept = *history.find(frame);
    facts.game_hashes.push_back(kept.game_hash);
    if (kept.changed_before) facts.changed_before.push_back(frame);
    if (history.settings().stages) facts.steps.push_back(static_cast<std::uint32_t>(kept.stages.size()) / kTraceHashes);
    facts.stages.insert(facts.stages.end(), kept.stages.begin(), kept.stages.end());
    result = recorder.frame(kept.commands, kept.hash);
    if (!result || static_cast<std::uint32_t>(frame - first) >= settings.states) continue;
    scratch.load(kept.state);
    result = recorder.keyframe(scratch);
  }
  if (!result) return result;
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  write_facts(writer, facts);
  if (result = recorder.writer().ancillary(replay_chunk::kPeer, bytes); !result) return result;
  return recorder.finish();
}

}  // namespace isostep
