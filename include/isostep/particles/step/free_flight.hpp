// FreeFlight: gravity and drag as materials have them, and how velocities and positions follow, by kernels over lanes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/flight.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/step/step.hpp"

namespace isostep {

/// Calls the kernels of flight.hpp for all particles of a world.
template <class S> class FreeFlight {
 public:
  FreeFlight(ParticleState<S>& state, ParticleStep<S>& step);

  /// Takes kernels of this width from now on.
  ISO_INLINE void use(const FlightKernels<S>& kernels) { kernels_ = &kernels; }
  ISO_INLINE const FlightKernels<S>& kernels() const { return *kernels_; }

  /// Computes the numbers of materials for a sub-step of this step.
  void prepare();
  /// Sets the accelerations to those of gravity and drag.
  ISO_INLINE void accelerate() { kernels_->accelerate(run()); }
  /// Advances velocities and displacements by one sub-step.
  ISO_INLINE void advance() { kernels_->advance(run()); }
  /// Computes all sub-steps at once, for particles that nothing joins.
  ISO_INLINE void fly() { kernels_->fly(run()); }
  /// Updates the positions `now` from the displacements.
  ISO_INLINE void place() { kernels_->place(run()); }
  /// Moves the positions of the state by the displacements, from slot `first` on. Returns the begin of the first block
  /// in which anything leaves the range or is no number, or the number of slots.
  ISO_INLINE std::uint32_t finish(std::uint32_t first) { return kernels_->finish(run(first)); }

  /// Sets the velocity of a particle that moves freely, with its material's damping.
  ISO_INLINE void keep_velocity(std::uint32_t slot, Vec3<Velocity<S>> velocity) {
    if (!(InverseMass<S>(0) < state_.inverse_mass[slot])) return;
    const Step<S> keep = rows_[state_.material[slot]].keep;
    state_.velocity.set(slot, {velocity.x * keep, velocity.y * keep, velocity.z * keep});
  }

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  FlightRun<S> run(std::uint32_t first = 0);

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  const FlightKernels<S>* kernels_;
  std::vector<FlightRow<S>> rows_;  // by material
};

#define ISO_FREE_FLIGHT_OF(extern, S) extern template class FreeFlight<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_FREE_FLIGHT_OF)

}  // namespace isostep
