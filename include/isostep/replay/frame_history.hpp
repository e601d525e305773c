// FrameHistory: what a world inside a session went through over the last frames: commands, hashes, states, stages.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

struct HistorySettings {
  std::size_t frames = 64;  // kept; more than a session may predict, and for bundles than it takes to notice a desync
  bool states = true;       // the state after each: for bundles; costs a save a frame
  bool stages = false;      // the hash after each stage: for the stage of a desync; costs kTraceHashes hashes a step
};

/// Observes `drive` for SessionRecorder and write_bundle. The world is the one that the game steps, at most
/// kFrameStepCap times a frame. It must outlive this, and records to nothing else meanwhile. Nothing is allocated once
/// the kept command logs and snapshots have grown.
template <class S> class FrameHistory {
 public:
  struct Kept {
    Frame frame = kNoFrame;       // kNoFrame: nothing is kept here
    bool confirmed = false;       // `game_hash` is known, and nothing here will change
    bool changed_before = false;  // since the frame before, by what no rollback repeats; known where stages are kept
    const char* flaw = nullptr;  // why the commands do not lead from the state before to the state after; null: it does
    std::uint64_t hash = 0;      // of the world after the frame
    std::uint64_t game_hash = 0;  // of the whole game after it, as the session compares
    std::vector<std::uint8_t> commands;
    std::vector<std::uint64_t> stages;  // kTraceHashes a step, or none
    typename World<S>::Snapshot state;  // after it, if states are kept
  };

  ISO_INLINE explicit FrameHistory(World<S>& world, const HistorySettings& settings = {})
      : world_(world), settings_(settings), ring_(settings.frames == 0 ? 1 : settings.frames) {}
  ISO_INLINE ~FrameHistory() { let_go(); }
  FrameHistory(const FrameHistory&) = delete;
  FrameHistory& operator=(const FrameHistory&) = delete;

  ISO_INLINE void before_step(Frame frame) {
    Kept& kept = at(frame);
    kept.confirmed = kept.confirmed && kept.frame == frame;
    kept.flaw = "the frame was not stepped to its end";
    kept.frame = frame;
    const Kept* const previous = settings_.stages ? find(frame - 1) : nullptr;
    kept.changed_before = previous != nullptr && previous->hash != world_.hash();
    kept.commands.clear();
    kept.stages.clear();
    if (first_ == kNoFrame) {
      first_ = frame;
      if (settings_.states) world_.save(start_);
    }
    commands_ = &kept.commands;
    began_ = CommandLogStart<World<S>>(world_);
    world_.record_to(commands_);
    if (settings_.stages) world_.trace_to(&kept.stages);
  }
  ISO_INLINE void after_step(Frame frame) {
    Kept& kept = at(frame);
    if (kept.frame != frame || commands_ != &kept.commands) return;
    kept.flaw = began_.flaw(world_, kept.commands);
    kept.hash = world_.hash();
    if (settings_.states) world_.save(kept.state);
    let_go();
  }
  /// A sync test also goes back behind confirmed frames, which stay confirmed.
  ISO_INLINE void rolled_back(Frame frame) {
    for (Kept& kept : ring_) {
      if (kept.frame >= frame && !kept.confirmed) kept.frame = kNoFrame;
    }
  }
  ISO_INLINE void confirmed(Frame frame, std::uint64_t hash) {
    Kept& kept = at(frame);
    if (kept.frame != frame) return;
    kept.confirmed = true;
    kept.game_hash = hash;
    confirmed_ = frame;
  }
  /// The session has another past: forgets all frames.
  ISO_INLINE void restarted(Frame) {
    for (Kept& kept : ring_) kept.frame = kNoFrame;
    first_ = confirmed_ = kNoFrame;
  }

  ISO_INLINE const World<S>& world() const { return world_; }
  ISO_INLINE const HistorySettings& settings() const { return settings_; }
  /// Returns null if the frame is not kept, or no longer kept.
  ISO_INLINE const Kept* find(Frame frame) const {
    if (frame < 0) return nullptr;
    const Kept& kept = ring_[static_cast<std::size_t>(frame) % ring_.size()];
    return kept.frame == frame ? &kept : nullptr;
  }
  /// Returns null if the frame is not kept, or no longer kept, or if states are not.
  ISO_INLINE const typename World<S>::Snapshot* state_before(Frame frame) const {
    if (!settings_.states) return nullptr;
    if (frame != kNoFrame && frame == first_) return &start_;
    const Kept* before = find(frame - 1);
    return before == nullptr ? nullptr : &before->state;
  }
  ISO_INLINE Frame last_confirmed() const { return confirmed_; }

 private:
  ISO_INLINE Kept& at(Frame frame) { return ring_[static_cast<std::size_t>(frame) % ring_.size()]; }
  ISO_INLINE void let_go() {
    if (commands_ == nullptr) return;
    if (world_.records_to(commands_)) world_.record_to(nullptr);
    if (settings_.stages) world_.trace_to(nullptr);
    commands_ = nullptr;
  }

  World<S>& world_;
  HistorySettings settings_;
  std::vector<Kept> ring_;  // by frame, modulo its length
  Frame first_ = kNoFrame;  // that was ever stepped
  Frame confirmed_ = kNoFrame;
  typename World<S>::Snapshot start_;              // before it
  std::vector<std::uint8_t>* commands_ = nullptr;  // of the frame being stepped
  CommandLogStart<World<S>> began_;                // it
};

}  // namespace isostep
