// WorldRecorder: records every command that a world accepts, so that the stock tool replays any game without its code.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/short_text.hpp"
#include "isostep/core/version.hpp"
#include "isostep/session/frame.hpp"
#include "isostep/state/record.hpp"
#include "isostep/world/command_codec.hpp"
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

/// In a header, where it is not 0: the number that the game gives to the file's frame 0.
inline constexpr char kFirstFrameKey[] = "first_frame";

/// The header of a recording of such a world from frame `first` on.
template <class S>
ISO_INLINE Result<ReplayHeader> header_of_world(const Settings<S>& settings, std::string_view scene, Frame first) {
  Result<ReplayHeader> header = make_replay_header(identity_of_world(settings, scene));
  if (header && first > 0) {
    header.value().set(kFirstFrameKey, ShortText<20>().append_number(static_cast<std::uint64_t>(first)).view(), false);
  }
  return header;
}

/// Where a frame's tape began.
template <class S> struct TapeStart {
  std::uint64_t loads = 0, tick = 0;

  TapeStart() = default;
  ISO_INLINE explicit TapeStart(const World<S>& world) : loads(world.loads()), tick(world.tick()) {}
  /// Why the tape does not lead from the state then to the state now; null: it does.
  ISO_INLINE const char* flaw(const World<S>& world, const std::vector<std::uint8_t>& tape) const {
    if (!world.records_to(&tape) || world.loads() != loads) {
      return "the world was loaded or replaced while it was recorded";
    }
    return world.tick() - tick > kFrameStepCap ? kTooManySteps : nullptr;
  }
};

/// `begin`; then for every frame commands and steps, in any number and order, and `end_frame`; then `finish`. A frame
/// without a step is a pause; one has at most kFrameStepCap. The world must outlive it and records to nothing else
/// meanwhile. Loading a snapshot ends a recording, for commands alone do not lead there: a game that rolls back is
/// recorded by SessionRecorder (session_recorder.hpp), which waits until frames are confirmed. Without `finish` the
/// file is truncated, its whole blocks still play.
template <class S> class WorldRecorder {
 public:
  ISO_INLINE WorldRecorder(World<S>& world, ReplaySink sink) : world_(world), recorder_(sink) {}
  ISO_INLINE ~WorldRecorder() { world_.record_to(nullptr); }
  WorldRecorder(const WorldRecorder&) = delete;
  WorldRecorder& operator=(const WorldRecorder&) = delete;

  /// The world as it is now, whatever it holds, is the recording's first state, before the game's frame `first`.
  ISO_INLINE Result<void> begin(std::string_view scene, Frame first = 0) {
    const Result<ReplayHeader> header = header_of_world(world_.settings(), scene, first);
    if (!header) return header.error();
    start_frame();
    world_.record_to(&tape_);
    return recorder_.begin(world_, header.value());
  }
  /// `hash` is the world's now: callers that have it need not compute it twice.
  ISO_INLINE Result<void> end_frame(std::uint64_t hash) {
    if (const char* flaw = start_.flaw(world_, tape_)) return Error{ErrorCode::invalid, flaw, "recorder"};
    const Result<void> result = recorder_.frame(tape_, hash);
    start_frame();
    return result;
  }
  ISO_INLINE Result<void> end_frame() { return end_frame(world_.hash()); }
  ISO_INLINE Result<void> finish() { return recorder_.finish(); }

 private:
  ISO_INLINE void start_frame() {
    tape_.clear();
    start_ = TapeStart<S>(world_);
  }

  World<S>& world_;
  Recorder<World<S>> recorder_;
  std::vector<std::uint8_t> tape_;
  TapeStart<S> start_;
};

}  // namespace isostep
