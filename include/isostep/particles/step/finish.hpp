// ParticleFinish: where particles end a step: positions take the displacements, within the scalar's limits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/step/free_flight.hpp"

namespace isostep {

template <class S> class ParticleFinish {
 public:
  ParticleFinish(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight);

  /// Finishes a step. Nothing leaves the scalar's range and no NaN enters the state: what would is cut, put back or
  /// stopped, and reported.
  void finalise();

 private:
  using V = Velocity<S>;

  ISO_INLINE void finish(std::uint32_t slot);
  void hold_at_edge(std::uint32_t slot, Vec3<S> position);
  void forget_broken_impulses();

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  FreeFlight<S>& flight_;
};

#define ISO_PARTICLE_FINISH_OF(extern, S) extern template class ParticleFinish<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_FINISH_OF)

}  // namespace isostep
