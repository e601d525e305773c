// ParticleSprings: springs and bungees as forces, and those that yield; stiff springs are another system's.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/flight.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/spring_rows.hpp"
#include "isostep/particles/step/step.hpp"

namespace isostep {

template <class S> class ParticleSprings {
 public:
  ParticleSprings(ParticleState<S>& state, ParticleStep<S>& step);

  /// Lists the springs that pull, once a step.
  void prepare();
  /// Adds the accelerations of springs to their ends, at the current positions.
  void pull(const FlightKernels<S>& kernels);
  /// Deforms springs beyond their elastic limit: their rest length follows (Millington, ch. 6.1.2). Events tell.
  void yield();

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  SpringRows<S> rows_;
  bool may_yield_ = false;  // any of the world's
};

#define ISO_PARTICLE_SPRINGS_OF(extern, S) extern template class ParticleSprings<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_SPRINGS_OF)

}  // namespace isostep
