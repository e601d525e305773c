// The step of a particle world as a list of named stages: the divergence finder and the README speak of these.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

enum class ParticleStage : std::uint32_t {
  find_contacts,
  solve_substeps,
  restitution,
  store_impulses,
  finalise_particles,
  yield_springs,
  expire_particles,
};
inline constexpr std::uint32_t kParticleStages = 7;
inline constexpr const char* kParticleStageNames[kParticleStages] = {
    "find_contacts",      "solve_substeps", "restitution",     "store_impulses",
    "finalise_particles", "yield_springs",  "expire_particles"};

class StageView;  // state/fields.hpp

/// An observer of stages. `after` is called after each stage of a step; it sees the world and what the stage left for
/// the next ones, and changes nothing.
struct ParticleStageObserver {
  void (*after)(void* user, ParticleStage stage, const StageView& left) = nullptr;
  void* user = nullptr;
};

}  // namespace isostep
