// The particle engine for a scalar: ISO_INSTANTIATE_PARTICLES(it), inside namespace isostep.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/instantiate.inl"
#include "isostep/particles/engine_fields.inl"
#include "isostep/particles/engine_step.inl"
#include "isostep/particles/flight_kernel.inl"
#include "isostep/particles/grid.inl"
#include "isostep/particles/implicit_springs.inl"
#include "isostep/particles/particle_world.inl"
#include "isostep/particles/solvers/worst_first.inl"
#include "isostep/particles/stiff_spring.inl"

/// ParticleWorld<S> and what it draws on, with the flight kernels of one lane.
#define ISO_INSTANTIATE_PARTICLES(S)                                                \
  ISO_DECLARE_FLIGHT_KERNELS(S)                                                     \
  ISO_DEFINE_SCALAR_FLIGHT_KERNELS(S)                                               \
  template <> const FlightKernels<S>* flight_kernels<S>(Simd simd) {                \
    const bool here = simd == Simd::best || simd == Simd::scalar;                   \
    return here ? detail::kernel_table<FlightKernels<S>, Simd::scalar>() : nullptr; \
  }                                                                                 \
  template class ParticleGrid<S>;                                                   \
  template class WorstFirst<S>;                                                     \
  ISO_IMPLICIT_SPRINGS_OF(, S)                                                      \
  ISO_STIFF_SPRING_OF(, S)                                                          \
  ISO_INSTANTIATE_PARTICLE_STEP(S)                                                  \
  ISO_INSTANTIATE_PARTICLE_WORLD(S)                                                 \
  ISO_INSTANTIATE_PARTICLE_BODIES(S)
