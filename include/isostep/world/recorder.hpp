// WorldRecorder: records every command that a world accepts, so that the stock tool replays any game without its code.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/version.hpp"
#include "isostep/state/record.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

/// Of everything in the settings that a replay's header does not name by itself.
template <class S> ISO_INLINE std::uint64_t settings_digest(const Settings<S>& settings) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(settings.gravity);
  writer.write(settings.allow_sleep);
  return hash_bytes(bytes.data(), bytes.size());
}

ISO_INLINE const char* solver_name(SolverName solver) {
  return solver == SolverName::soft_step ? "soft_step" : "unknown";
}

/// What must be equal where a recording of such a world is replayed. `scene` is kept by reference.
template <class S> ISO_INLINE ReplayIdentity identity_of_world(const Settings<S>& settings, std::string_view scene) {
  ReplayIdentity identity{};
  identity.behaviour = behaviour_version();
  identity.scalar = ScalarTraits<S>::kName;
  identity.scalar_id = ScalarTraits<S>::kId;
  identity.hz = static_cast<std::uint32_t>(settings.hz);
  identity.substeps = static_cast<std::uint32_t>(settings.substeps);
  identity.solver = solver_name(settings.solver);
  identity.settings_digest = settings_digest(settings);
  identity.scene = scene;
  return identity;
}

/// `begin`; then for every frame any commands, one step, and `end_frame`; then `finish`. The world must outlive it and
/// records to nothing else meanwhile. Commands may come before and after the step of their frame. Loading a snapshot
/// ends a recording, for commands alone do not lead there: a game that rolls back is recorded by SessionRecorder
/// (session_recorder.hpp), which waits until frames are confirmed. Without `finish` the file is truncated, its whole
/// blocks still play.
template <class S> class WorldRecorder {
 public:
  ISO_INLINE WorldRecorder(World<S>& world, ReplaySink sink) : world_(world), recorder_(sink) {}
  ISO_INLINE ~WorldRecorder() { world_.record_to(nullptr); }
  WorldRecorder(const WorldRecorder&) = delete;
  WorldRecorder& operator=(const WorldRecorder&) = delete;

  /// The world as it is now, whatever it holds, is the recording's first state.
  ISO_INLINE Result<void> begin(std::string_view scene) {
    const Result<ReplayHeader> header = make_replay_header(identity_of_world(world_.settings(), scene));
    if (!header) return header.error();
    tape_.clear();
    loads_ = world_.loads();
    tick_ = world_.tick();
    world_.record_to(&tape_);
    return recorder_.begin(world_, header.value());
  }
  /// `hash` is the world's now: callers that have it need not compute it twice.
  ISO_INLINE Result<void> end_frame(std::uint64_t hash) {
    if (!world_.records_to(&tape_) || world_.loads() != loads_) {
      return Error{ErrorCode::invalid, "the world was loaded or replaced while it was recorded", "recorder"};
    }
    if (world_.tick() != ++tick_) return Error{ErrorCode::invalid, "a frame is exactly one step", "recorder"};
    const Result<void> result = recorder_.frame(tape_, hash);
    tape_.clear();
    return result;
  }
  ISO_INLINE Result<void> end_frame() { return end_frame(world_.hash()); }
  ISO_INLINE Result<void> finish() { return recorder_.finish(); }

 private:
  World<S>& world_;
  Recorder<World<S>> recorder_;
  std::vector<std::uint8_t> tape_;
  std::uint64_t loads_ = 0;
  std::uint64_t tick_ = 0;  // of the last whole frame
};

}  // namespace isostep
