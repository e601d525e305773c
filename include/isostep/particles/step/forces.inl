// ParticleForces: what each kind of force does.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/checks.hpp"
#include "isostep/particles/step/forces.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S>
ParticleForces<S>::ParticleForces(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight,
                                  ParticleSprings<S>& springs)
    : state_(state), step_(step), flight_(flight), springs_(springs) {}

template <class S> void ParticleForces<S>::begin_step() {
  for (const ParticlePush<S>& push : state_.pushes) {
    if (push.cut != 0) note_cut(push.slot);
  }
}
/// Counts each particle once a step.
template <class S> void ParticleForces<S>::note_cut(std::uint32_t slot) {
  if (step_.report.clamped_force == 0) cut_.clear();
  if (cut_.insert(slot)) ++step_.report.clamped_force;
}

template <class S> bool ParticleForces<S>::any() const {
  return !state_.springs.all().empty() || !state_.forces.all().empty() || !state_.cohesions.all().empty() ||
         !state_.pushes.empty();
}

namespace detail {
/// Returns true if a vector is as long as the format allows: it, or a sum, was cut.
template <class S> ISO_INLINE bool is_cut(Vec3<S> a) {
  const S most = highest<S>();
  if (lies_within(a, most * S(0.5))) return false;  // the largest component of such a length is above 0.57 of it
  return !(length(a) < most - most * S(1.0 / 1024));
}
}  // namespace detail

template <class S> void ParticleForces<S>::accelerate() {
  flight_.accelerate();
  if (!any()) return;
  springs_.pull(flight_.kernels());
  for (const ParticleForce<S>& force : state_.forces.all()) {
    if (force.particle) add(force);
  }
  add_cohesions();
  for (const ParticlePush<S>& asked : state_.pushes) step_.add_acceleration(asked.slot, asked.acceleration);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    if (detail::is_cut(step_.acceleration[i])) note_cut(i);
  }
}

/// Adds force / m along the direction.
template <class S>
ISO_INLINE void ParticleForces<S>::push(std::uint32_t slot, InverseMass<S> inverse_mass, Vec3<U> direction, S force) {
  step_.add_acceleration(slot, direction * saturate_to<S>(product(force, inverse_mass)));
}
template <class S> void ParticleForces<S>::add(const ParticleForce<S>& force) {
  const std::uint32_t slot = force.particle.slot;
  const InverseMass<S> w = state_.inverse_mass[slot];
  if (!(InverseMass<S>(0) < w)) return;
  if (force.type == ForceType::gravity) {
    step_.add_acceleration(slot, force.acceleration);
  }
  if (force.type == ForceType::drag) {
    const Vec3<S> v = convert<S>(state_.velocity[slot]);
    const Heading<S> way = heading_of(v);
    const S coefficient = saturating_add(force.linear_drag, saturate_to<S>(product(force.quadratic_drag, way.length)));
    const S drag = saturate_to<S>(product(coefficient, way.length));
    push(slot, w, -way.direction, drag);
  }
  if (force.type == ForceType::buoyancy) {
    const Vec3<S> g = state_.settings.gravity;
    const Heading<S> down = heading_of(g);
    const Vec3<U> up = -down.direction;
    const S sunk = force.surface_height + force.max_depth - dot(step_.now[slot], up);
    const S share = clamp(sunk / (force.max_depth + force.max_depth), S(0), S(1));
    const S displaced = saturate_to<S>(product(saturate_to<S>(product(force.density, force.volume)), share));
    push(slot, w, up, saturate_to<S>(product(displaced, down.length)));
  }
}

// ---- cohesion

template <class S> void ParticleForces<S>::find_cohering(PairSearch<S>& search) {
  cohering_.clear();
  cohering_ends_.clear();
  for (const Cohesion<S>& cohesion : state_.cohesions.all()) {
    search.clear();
    const S half = cohesion.attract_end * S(0.5);
    for (std::uint32_t slot = 0; slot < state_.material.size() && cohesion.material; ++slot) {
      if (state_.material[slot] != cohesion.material.slot || !state_.particles.is_taken(slot)) continue;
      search.add(slot, half + min(search.reach_of(slot), half));
    }
    search.find(cohering_);
    cohering_ends_.push_back(cohering_.size());
  }
}
template <class S> void ParticleForces<S>::add_cohesions() {
  std::size_t pair = 0;
  for (std::size_t i = 0; i < cohering_ends_.size(); ++i) {
    for (; pair < cohering_ends_[i]; ++pair) {
      const std::uint64_t both = cohering_[pair];
      add(state_.cohesions.all()[i], static_cast<std::uint32_t>(both >> 32), static_cast<std::uint32_t>(both));
    }
  }
}
template <class S> void ParticleForces<S>::add(const Cohesion<S>& cohesion, std::uint32_t i, std::uint32_t k) {
  const Vec3<S> d = step_.now[k] - step_.now[i];
  const Heading<S> way = heading_of(d);
  if (!(way.length <= cohesion.attract_end)) return;  // NaN is nowhere near
  S force = S(0);                                     // towards each other
  if (way.length < cohesion.repel_distance) {
    force = -(cohesion.repel_force * ((cohesion.repel_distance - way.length) / cohesion.repel_distance));
  } else if (cohesion.attract_start < way.length) {
    const S part = (way.length - cohesion.attract_start) / (cohesion.attract_end - cohesion.attract_start);
    force = cohesion.attract_force * part;
  }
  const Vec3<U> u = way.direction;
  push(i, state_.inverse_mass[i], u, force);
  push(k, state_.inverse_mass[k], -u, force);
}

}  // namespace isostep
