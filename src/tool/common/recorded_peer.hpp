// RecordedPeer<W>: one side of a desync: what its file recorded, and what its frames come out as when played here.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "isostep/replay/desync_bundle.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "recorded_file.hpp"
#include "tool.hpp"

namespace isostep::tool {

/// Returns null when there is none: the file is the recording of a whole match.
inline const ReplayAncillary* facts_chunk(const ReplayReader& replay) {
  for (const ReplayAncillary& chunk : replay.ancillaries()) {
    if (chunk.type == replay_chunk::kPeer) return &chunk;
  }
  return nullptr;
}

/// Frames are counted as the session counted them.
template <class W> class RecordedPeer {
 public:
  explicit RecordedPeer(const Input& input) : path_(input.path), replay_(input.replay) {
    if (const ReplayAncillary* chunk = facts_chunk(replay_)) {
      Result<BundleFacts> facts = read_facts(chunk->payload, replay_.frame_count(), kHashes);
      if (!facts) refuse(path_, VerifyOutcome::corrupt, facts.error());
      facts_ = std::move(facts.value());
    }
    if (header().find(kFirstFrameKey) == nullptr) return;
    const Result<std::uint64_t> first = header().number(kFirstFrameKey);
    if (!first) refuse(path_, VerifyOutcome::corrupt, first.error());
    if (first.value() > kLastFrame) {
      refuse(path_, VerifyOutcome::corrupt, {ErrorCode::corrupt, "no frame has this number", "HEAD first_frame"});
    }
    first_ = static_cast<Frame>(first.value());
  }

  const ReplayHeader& header() const { return replay_.header(); }
  const std::optional<BundleFacts>& facts() const { return facts_; }
  Frame first() const { return first_; }
  Frame end() const { return first_ + static_cast<Frame>(replay_.frame_count()); }

  Bytes commands(Frame frame) const { return at(frame).input; }
  std::uint64_t hash_after(Frame frame) const { return at(frame).hash; }
  std::uint64_t hash_before(Frame frame) const {
    return frame == first_ ? replay_.state_hash() : hash_after(frame - 1);
  }
  std::optional<std::uint64_t> game_hash_after(Frame frame) const {
    if (!facts_) return std::nullopt;
    return facts_->game_hashes[index(frame)];
  }
  /// Something changed the world between the frame before and this one; false where it was not traced.
  bool changed_before(Frame frame) const {
    return facts_ && std::find(facts_->changed_before.begin(), facts_->changed_before.end(), frame) !=
                         facts_->changed_before.end();
  }
  /// The hashes of a frame, as many for each step as the world has; nothing when they were not traced.
  std::optional<std::span<const std::uint64_t>> stages(Frame frame) const {
    if (!facts_ || facts_->steps.empty()) return std::nullopt;
    const auto steps = facts_->steps.begin() + static_cast<std::ptrdiff_t>(index(frame));
    const std::size_t before = std::accumulate(facts_->steps.begin(), steps, std::size_t{0});
    return std::span<const std::uint64_t>(facts_->stages).subspan(before * kHashes, *steps * kHashes);
  }

  /// The start, then frame by frame: what this machine makes of the recording, or, where that is not what was recorded
  /// and the peer's own state is stored, that one.
  W start() const { return decode(replay_.state()); }
  void play(W& world, Frame frame) const {
    const Result<void> stepped = world.step_recorded(commands(frame));
    if (!stepped) refuse(path_, VerifyOutcome::corrupt, stepped.error());
    if (world.hash() == hash_after(frame)) return;
    for (const ReplayKeyframe& key : replay_.keyframes()) {
      if (key.frames != index(frame) + 1) continue;
      W stored = decode(key.state);
      if (stored.hash() == hash_after(frame)) world = std::move(stored);
    }
  }

  /// The state before a frame or after the last, as the peer had it: stored, or played; nothing when neither has the
  /// recorded hash.
  std::optional<W> state_before(Frame frame) const {
    for (const ReplayKeyframe& key : replay_.keyframes()) {
      if (key.frames != index(frame)) continue;
      W stored = decode(key.state);
      if (stored.hash() == hash_before(frame)) return stored;
    }
    W world = decode(replay_.state());
    for (Frame f = first_; f < frame; ++f) {
      stop_if_interrupted();
      if (!world.step_recorded(commands(f))) return std::nullopt;
    }
    if (world.hash() != hash_before(frame)) return std::nullopt;
    return world;
  }

 private:
  static constexpr std::uint32_t kHashes = 1 + WorldTraits<W>::kStages.size();

  std::size_t index(Frame frame) const { return static_cast<std::size_t>(frame - first_); }
  ReplayFrame at(Frame frame) const { return replay_.frame(index(frame)); }
  W decode(Bytes state) const {
    W world;
    Reader reader(state);
    const Result<void> read = world.read_portable(reader);
    if (!read) refuse(path_, VerifyOutcome::corrupt, read.error());
    return world;
  }

  const std::string& path_;
  const ReplayReader& replay_;
  std::optional<BundleFacts> facts_;
  Frame first_ = 0;
};

}  // namespace isostep::tool
