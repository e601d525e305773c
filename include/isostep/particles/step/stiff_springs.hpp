// StiffSprings: springs that take their exact motion over a sub-step, or that of backward Euler, and are no forces.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/step/rows.hpp"
#include "isostep/particles/step/step.hpp"
#include "isostep/particles/stiff_spring.hpp"

namespace isostep {

/// Moves the ends of stiff springs after everything else moved them as if the spring were not there, by the difference
/// to the spring's motion. That is the exact motion if nothing else holds its ends. A constraint would undo the end
/// velocity of the exact motion, which says nothing about the way, and give back the energy as displacement: then the
/// spring moves by backward Euler, whose end velocity is that of the way.
template <class S> class StiffSprings {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;

  StiffSprings(ParticleState<S>& state, ParticleStep<S>& step);

  /// Chooses the motion of each spring, once a step, by whether constraints or other stiff springs hold its ends too.
  void prepare(std::span<const ParticleConstraint<S>> rows);
  /// Changes velocities and displacements of all ends, after the integration of a sub-step.
  void swing();
  /// Adds them as forces, which they otherwise are not.
  void pull();

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  void count_holds(std::span<const ParticleConstraint<S>> rows);
  ISO_INLINE void swing(const Spring<S>& spring, const OscillatorStep<S>& motion);
  ISO_INLINE void move_end(std::uint32_t slot, Vec3<V> way, Vec3<V> change);

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  std::vector<std::uint32_t> slots_;            // ascending
  std::vector<OscillatorStep<S>> oscillators_;  // of those
  std::vector<std::uint32_t> holds_;            // by particle's slot: stiff springs and constraints, 2 for more
};

#define ISO_STIFF_SPRINGS_OF(extern, S) extern template class StiffSprings<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_STIFF_SPRINGS_OF)

}  // namespace isostep
