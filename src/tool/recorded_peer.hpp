// RecordedPeer<S>: one side of a desync: what its file recorded, and what its frames come out as when played here.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "diff_input.hpp"
#include "isostep/world/desync_bundle.hpp"
#include "stage_trace.hpp"

namespace isostep::tool {

/// Null when there is none: the file is the recording of a whole match.
inline const ReplayAncillary* facts_chunk(const ReplayReader& replay) {
  for (const ReplayAncillary& chunk : replay.ancillaries()) {
    if (chunk.type == replay_chunk::kPeer) return &chunk;
  }
  return nullptr;
}

/// Frames are counted as the session counted them.
template <class S> class RecordedPeer {
 public:
  explicit RecordedPeer(const Input& input) : path_(input.path), replay_(input.bytes) {
    if (const ReplayAncillary* chunk = facts_chunk(replay_)) {
      const Result<BundleFacts> facts = read_facts(chunk->payload, replay_.frame_count());
      if (!facts) refuse(path_, VerifyOutcome::corrupt, facts.error());
      facts_ = facts.value();
      first_ = facts_->first;
    }
    tick_ = decode(replay_.state()).tick();
  }

  const ReplayHeader& header() const { return replay_.header(); }
  const std::optional<BundleFacts>& facts() const { return facts_; }
  Frame first() const { return first_; }
  Frame end() const { return first_ + static_cast<Frame>(replay_.frame_count()); }
  /// A world's tick grows by one a frame: a recording without facts is placed by it.
  void align(const RecordedPeer& other) {
    if (facts_) return;
    const std::int64_t first = other.first_ + static_cast<std::int64_t>(tick_ - other.tick_);
    if (first < -kLastFrame || first > kLastFrame) {
      refuse(path_, VerifyOutcome::corrupt, {ErrorCode::corrupt, "starts at a tick that no frame can have", "INIT"});
    }
    first_ = static_cast<Frame>(first);
  }

  Bytes tape(Frame frame) const { return at(frame).input; }
  std::uint64_t hash_after(Frame frame) const { return at(frame).hash; }
  std::uint64_t hash_before(Frame frame) const {
    return frame == first_ ? replay_.state_hash() : hash_after(frame - 1);
  }
  std::optional<std::uint64_t> root_after(Frame frame) const {
    if (!facts_) return std::nullopt;
    return facts_->roots[index(frame)];
  }
  /// Empty when they were not traced.
  std::span<const std::uint64_t> stages(Frame frame) const {
    if (!facts_ || facts_->stages.empty()) return {};
    return std::span(facts_->stages).subspan(index(frame) * kTraceHashes, kTraceHashes);
  }

  /// The state before a frame or after the last, as the peer had it: stored, or played; nothing when neither has the
  /// recorded hash.
  std::optional<World<S>> state_before(Frame frame) const {
    for (const ReplayKeyframe& key : replay_.keyframes()) {
      if (key.frames != index(frame)) continue;
      World<S> stored = decode(key.state);
      if (stored.hash() == hash_before(frame)) return stored;
    }
    World<S> world = decode(replay_.state());
    for (Frame f = first_; f < frame; ++f) {
      stop_if_interrupted();
      if (!world.step_recorded(tape(f))) return std::nullopt;
    }
    if (world.hash() != hash_before(frame)) return std::nullopt;
    return world;
  }

  struct Again {
    bool as_recorded = false;
    std::vector<WorldState<S>> trace;
  };
  /// One frame, played here from the state that the peer had before it.
  Again play_again(Frame frame) const {
    std::optional<World<S>> world = state_before(frame);
    if (!world) return {};
    Again again;
    again.trace = trace_frame(*world, tape(frame));
    again.as_recorded = world->hash() == hash_after(frame);
    return again;
  }

 private:
  std::size_t index(Frame frame) const { return static_cast<std::size_t>(frame - first_); }
  ReplayFrame at(Frame frame) const { return replay_.frame(index(frame)); }
  World<S> decode(Bytes state) const {
    World<S> world;
    Reader reader(state);
    const Result<void> read = world.read_portable(reader);
    if (!read) refuse(path_, VerifyOutcome::corrupt, read.error());
    return world;
  }

  const std::string& path_;
  ReplayReader replay_;
  std::optional<BundleFacts> facts_;
  Frame first_ = 0;
  std::uint64_t tick_ = 0;  // of the start
};

}  // namespace isostep::tool
