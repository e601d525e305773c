// ParticleSprings: rows for the kernel that pulls, and plastic deformation.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/checks.hpp"
#include "isostep/particles/step/springs.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S>
ParticleSprings<S>::ParticleSprings(ParticleState<S>& state, ParticleStep<S>& step) : state_(state), step_(step) {}

template <class S> void ParticleSprings<S>::prepare() {
  rows_.begin(state_.springs.all().size());
  may_yield_ = false;
  const auto particles = static_cast<std::uint32_t>(state_.material.size());
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a || spring.type == SpringType::stiff) continue;
    const InverseMass<S> of_a = state_.inverse_mass[spring.a.slot];
    const InverseMass<S> of_b = spring.b ? state_.inverse_mass[spring.b.slot] : InverseMass<S>(0);
    if (S(0) < spring.elastic_limit) may_yield_ = true;
    if (InverseMass<S>(0) < saturating_add(of_a, of_b)) rows_.add(spring, particles, of_a, of_b);
  }
  if (rows_.count > 0) rows_.place_anchors(particles);
}

template <class S> void ParticleSprings<S>::pull(const FlightKernels<S>& kernels) {
  if (rows_.count == 0) return;
  kernels.pull({rows_.a.data(), rows_.b.data(), rows_.stiffness.data(), rows_.damping.data(), rows_.rest_length.data(),
                rows_.least_extension.data(), rows_.of_a.data(), rows_.of_b.data(), rows_.places.data(),
                rows_.pulls.data(), rows_.paces.data(), view_of(step_.now), view_of(state_.velocity),
                view_of(step_.acceleration), rows_.count, static_cast<std::uint32_t>(state_.material.size()),
                rows_.damped});
}

template <class S> void ParticleSprings<S>::yield() {
  if (!may_yield_) return;
  for (std::uint32_t slot = 0; slot < state_.springs.all().size(); ++slot) {
    const Spring<S>& spring = state_.springs.all()[slot];
    if (!spring.a || !(S(0) < spring.elastic_limit)) continue;
    const Vec3<S> other = spring.b ? state_.position[spring.b.slot] : spring.anchor;
    const Vec3<S> d = state_.position[spring.a.slot] - other;
    const S now = length(d);
    const S extension = now - spring.rest_length;
    const bool slack = spring.type == SpringType::bungee && extension < S(0);
    if (slack || detail::lies_within(extension, spring.elastic_limit)) continue;
    const S wanted = extension < S(0) ? now + spring.elastic_limit : now - spring.elastic_limit;
    const S rest = clamp(wanted, S(0), ParticleLimits<S>::position());
    if (rest == spring.rest_length) continue;  // it cannot give more
    const SpringId id = state_.springs.slot_map().template id_of<SpringId>(slot);
    state_.springs.change(id).rest_length = rest;
    step_.events.yielded.push_back(id);
  }
}

}  // namespace isostep
