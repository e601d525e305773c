// ParticleRecorder: the CommandRecorder of a particle world; and what such a world says of itself in a replay's header.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/version.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/state/command_recorder.hpp"

namespace isostep {

/// The name of particle worlds in a replay's header.
inline constexpr char kParticleWorldName[] = "particles";

/// The identity that must be equal where a recording of such a world is replayed. `scene` is kept by reference.
template <class S>
ISO_INLINE ReplayIdentity identity_of_world(const ParticleSettings<S>& settings, std::string_view scene) {
  ReplayIdentity identity{};
  identity.world = kParticleWorldName;
  identity.behaviour = behaviour_version();
  identity.scalar = ScalarTraits<S>::kName;
  identity.scalar_id = ScalarTraits<S>::kId;
  identity.hz = static_cast<std::uint32_t>(settings.hz);
  identity.substeps = static_cast<std::uint32_t>(settings.substeps);
  identity.solver = kParticleSolverNames[static_cast<std::uint32_t>(settings.solver)];
  identity.settings_digest = settings_digest(settings);
  identity.scene = scene;
  return identity;
}

template <class S> using ParticleRecorder = CommandRecorder<ParticleWorld<S>>;

}  // namespace isostep
