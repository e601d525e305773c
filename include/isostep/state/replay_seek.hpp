// ReplaySeeker: any frame of a replay, forward and back, by states kept in memory while it plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/index.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {

struct SeekSettings {
  std::size_t states = 128;                    // kept at most, the start included
  std::size_t bytes = std::size_t{256} << 20;  // [bytes] that they may take, where snapshots tell their size
  std::uint64_t spacing = 15;                  // [frames] between two of them at first
};

/// Keeps the states after every `spacing` frames played so far. When the room is full, it drops every other one and
/// doubles the spacing. So a frame that was passed once costs at most one spacing of steps, whatever the length. It
/// trusts only what was played here, and ignores stored keyframes. `replay` and `sim` must outlive it, and nobody else
/// changes `sim` between calls.
template <class Sim>
requires ReplayableSimulation<Sim> && Rollbackable<Sim>
class ReplaySeeker {
 public:
  ISO_INLINE ReplaySeeker(const ReplayReader& replay, Sim& sim, const SeekSettings& settings = {})
      : replay_(replay), sim_(sim), settings_(settings), spacing_(settings.spacing == 0 ? 1 : settings.spacing) {}

  /// Brings `sim` to the state after so many frames; 0 is the start. If a frame cannot be applied, `sim` stays before
  /// that frame.
  ISO_INLINE Result<void> seek(std::uint64_t frames) {
    if (frames > replay_.frame_count()) return Error{ErrorCode::invalid, "past the replay's last frame", "seek"};
    if (keys_.empty()) {
      if (Result<void> started = start(); !started) return started;
    }
    std::uint64_t key = frames / spacing_;
    if (key >= keys_.size()) key = keys_.size() - 1;
    if (position_ > frames || position_ < key * spacing_) go_to(key);
    while (position_ < frames) {
      if (Result<void> stepped = advance(); !stepped) return stepped;
    }
    return {};
  }

  /// The number of frames that lead to the present state of `sim`.
  ISO_INLINE std::uint64_t position() const { return position_; }
  /// Returns true if the state has the hash recorded there. Only this tells if a replay still plays as it did.
  ISO_INLINE bool agrees() const {
    return sim_.hash() == (position_ == 0 ? replay_.state_hash() : replay_.frame(position_ - 1).hash);
  }
  ISO_INLINE std::uint64_t spacing() const { return spacing_; }
  ISO_INLINE std::size_t states() const { return keys_.size(); }

 private:
  ISO_INLINE Result<void> start() {
    if (!replay_.has_state()) return Error{ErrorCode::truncated, "the replay has no start", "seek"};
    Reader reader(replay_.state());
    Result<void> read = sim_.read_portable(reader);
    if (read) {
      reader.expect_end();
      read = reader.result("INIT");
    }
    if (!read) return read;
    position_ = 0;
    keep();
    return {};
  }
  ISO_INLINE void go_to(std::uint64_t key) {
    sim_.load(keys_[as_index(key)]);
    position_ = key * spacing_;
  }
  ISO_INLINE Result<void> advance() {
    Result<void> stepped = sim_.step_recorded(replay_.frame(position_).input);
    if (!stepped) {  // commands before the bad one were applied
      const std::uint64_t before = position_;
      go_to(before / spacing_ < keys_.size() ? before / spacing_ : keys_.size() - 1);
      while (position_ < before && sim_.step_recorded(replay_.frame(position_).input)) ++position_;
      return stepped;
    }
    ++position_;
    if (position_ == keys_.size() * spacing_) keep();
    return {};
  }

  ISO_INLINE static std::size_t size_of(const Snapshot<Sim>& state) {
    if constexpr (requires { state.bytes(); }) return state.bytes();
    return sizeof(state);
  }
  /// Keeps the state after keys_.size() spacings.
  ISO_INLINE void keep() {
    keys_.emplace_back();
    sim_.save(keys_.back());
    bytes_ += size_of(keys_.back());
    while (keys_.size() > 1 && (keys_.size() > settings_.states || bytes_ > settings_.bytes)) thin();
  }
  ISO_INLINE void thin() {
    std::size_t kept = 1;
    for (std::size_t i = 2; i < keys_.size(); i += 2) keys_[kept++] = std::move(keys_[i]);
    keys_.resize(kept);
    bytes_ = 0;
    for (const Snapshot<Sim>& state : keys_) bytes_ += size_of(state);
    spacing_ *= 2;
  }

  const ReplayReader& replay_;
  Sim& sim_;
  SeekSettings settings_;
  std::uint64_t spacing_;
  std::uint64_t position_ = 0;
  std::size_t bytes_ = 0;
  std::vector<Snapshot<Sim>> keys_;  // after 0, spacing_, 2 spacing_ ... frames
};

}  // namespace isostep
