// FreeFlight: materials as kernels need them, and the run of a step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/step/free_flight.hpp"

namespace isostep {

template <class S>
FreeFlight<S>::FreeFlight(ParticleState<S>& state, ParticleStep<S>& step)
    : state_(state), step_(step), kernels_(flight_kernels<S>(Simd::best)) {}

template <class S> void FreeFlight<S>::prepare() {
  const Vec3<S> g = state_.settings.gravity;
  const S most = ParticleLimits<S>::acceleration();
  rows_.resize(state_.materials.all().size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ParticleMaterial<S>& m = state_.materials.all()[i];
    const auto scaled = [&](S part) { return clamp(saturate_to<S>(product(part, m.gravity_scale)), -most, most); };
    rows_[i] = {{scaled(g.x), scaled(g.y), scaled(g.z)},
                m.linear_drag,
                m.quadratic_drag,
                power_to<Step<S>>(m.damping, step_.h)};
  }
}

template <class S> FlightRun<S> FreeFlight<S>::run(std::uint32_t first) {
  return {rows_.data(),
          state_.material.data(),
          state_.inverse_mass.data(),
          view_of(state_.position),
          view_of(step_.now),
          view_of(state_.velocity),
          view_of(step_.displacement),
          view_of(step_.acceleration),
          first,
          static_cast<std::uint32_t>(state_.material.size()),
          step_.h,
          step_.rate,
          state_.settings.substeps,
          state_.settings.integrator == Integrator::explicit_euler};
}

}  // namespace isostep
