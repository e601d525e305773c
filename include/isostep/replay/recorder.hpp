// WorldRecorder: the CommandRecorder of a rigid world; and what such a world says of itself in a replay's header.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/version.hpp"
#include "isostep/state/command_recorder.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

ISO_INLINE const char* solver_name(SolverName solver) {
  const auto index = static_cast<std::uint32_t>(solver);
  return index < kSolvers ? kSolverNames[index] : "unknown";
}

/// Returns what must be equal where a recording of such a world is replayed. `scene` is kept by reference.
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

/// A game that rolls back is recorded by SessionRecorder (session_recorder.hpp), which waits until frames are
/// confirmed.
template <class S> using WorldRecorder = CommandRecorder<World<S>>;

}  // namespace isostep
