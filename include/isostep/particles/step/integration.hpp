// ParticleIntegration: the five integrators.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/implicit_springs.hpp"
#include "isostep/particles/step/forces.hpp"
#include "isostep/particles/step/free_flight.hpp"
#include "isostep/particles/step/stiff_springs.hpp"

namespace isostep {

/// Each takes velocities and displacements over one sub-step as if nothing held the particles; constraints correct both
/// afterwards. `constrained`: whether there are any.
template <class S> class ParticleIntegration {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;

  ParticleIntegration(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight, ParticleForces<S>& forces,
                      StiffSprings<S>& stiff_springs);

  /// Computes the velocities with which particles move through the sub-step, and moves displacements by them.
  /// Constraints work on these velocities; arrive() then sets those of the sub-step's end. A second stage, computed at
  /// positions that forces alone would reach, would add energy to a spring beside a rod.
  void integrate(bool constrained);
  /// Returns true if the method's velocities at the end differ from those of the way.
  ISO_INLINE bool arrives() const {
    const Integrator integrator = state_.settings.integrator;
    return integrator == Integrator::velocity_verlet || integrator == Integrator::rk4;
  }
  /// Sets the velocities of the sub-step's end, for such a method.
  void arrive(bool constrained);
  /// Computes a sub-step of particles that springs and forces join, but no constraint.
  void fly();

  /// Updates the positions `now` from the displacements.
  ISO_INLINE void place() { flight_.place(); }
  /// Computes all forces at the displaced positions, those of stiff springs too.
  void accelerate_all();
  /// Returns true if there are forces besides those of materials.
  ISO_INLINE bool has_forces() const { return forces_.any(); }

 private:
  void drift_verlet();
  void arrive_verlet();
  void drift_rk4();
  void add_stage(int stage);
  void turn_end();
  void integrate_implicit();

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  FreeFlight<S>& flight_;
  ParticleForces<S>& forces_;
  StiffSprings<S>& stiff_springs_;
  ImplicitSprings<S> implicit_springs_;
  Axes<V> start_, first_displacement_;  // where the sub-step began
  Axes<S> first_;                       // [m/s^2] acceleration there
  Axes<S> sum_;                         // [m/s^2] weighted mean of the stages' accelerations
  Axes<V> mean_, end_;                  // [m/s] weighted mean of their velocities; the velocity after the sub-step
};

#define ISO_PARTICLE_INTEGRATION_OF(extern, S) extern template class ParticleIntegration<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_INTEGRATION_OF)

}  // namespace isostep
