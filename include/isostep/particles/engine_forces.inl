// ParticleEngine: the forces at the particles' present positions and velocities, as acceleration.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// Sums of many forces end at the format's ends.
template <class S> ISO_INLINE void ParticleEngine<S>::add_acceleration(std::uint32_t slot, Vec3<S> a) {
  Axes<S>& sum = scratch_.acceleration;
  sum.set(slot, saturating_add(sum[slot], a));
}
/// force / m along the direction.
template <class S>
ISO_INLINE void ParticleEngine<S>::push(std::uint32_t slot, InverseMass<S> inverse_mass, Vec3<U> direction, S force) {
  add_acceleration(slot, direction * saturate_to<S>(product(force, inverse_mass)));
}

template <class S> bool ParticleEngine<S>::has_forces() const {
  return !state_.springs.all().empty() || !state_.forces.all().empty() || !state_.cohesions.all().empty() ||
         !state_.pushes.empty();
}

template <class S> SpringRun<S> ParticleEngine<S>::spring_run() {
  SpringRows<S>& rows = spring_rows_;
  return {rows.a.data(),
          rows.b.data(),
          rows.stiffness.data(),
          rows.damping.data(),
          rows.rest_length.data(),
          rows.least_extension.data(),
          rows.of_a.data(),
          rows.of_b.data(),
          rows.places.data(),
          rows.pulls.data(),
          rows.paces.data(),
          view_of(scratch_.now),
          view_of(state_.velocity),
          view_of(scratch_.acceleration),
          rows.count,
          static_cast<std::uint32_t>(state_.material.size()),
          rows.damped};
}

/// In the order of kinds and slots, whatever the order of registration.
template <class S> void ParticleEngine<S>::add_forces() {
  if (spring_rows_.count > 0) kernels_->pull(spring_run());
  for (const ParticleForce<S>& force : state_.forces.all()) {
    if (force.particle) add_force(force);
  }
  std::size_t pair = 0;
  for (std::size_t i = 0; i < cohering_ends_.size(); ++i) {
    for (; pair < cohering_ends_[i]; ++pair) {
      const std::uint64_t both = cohering_[pair];
      add_cohesion(state_.cohesions.all()[i], static_cast<std::uint32_t>(both >> 32), static_cast<std::uint32_t>(both));
    }
  }
  for (const ParticlePush<S>& asked : state_.pushes) add_acceleration(asked.slot, asked.acceleration);
}

template <class S> void ParticleEngine<S>::add_force(const ParticleForce<S>& force) {
  const std::uint32_t slot = force.particle.slot;
  const InverseMass<S> w = state_.inverse_mass[slot];
  if (!(InverseMass<S>(0) < w)) return;
  if (force.type == ForceType::gravity) {
    add_acceleration(slot, force.acceleration);
  }
  if (force.type == ForceType::drag) {
    const Vec3<S> v = convert<S>(state_.velocity[slot]);
    const Direction<S> way = direction_of(v.x, v.y, v.z);
    const S coefficient = saturating_add(force.linear_drag, saturate_to<S>(product(force.quadratic_drag, way.length)));
    const S drag = saturate_to<S>(product(coefficient, way.length));
    push(slot, w, -Vec3<U>{way.x, way.y, way.z}, drag);
  }
  if (force.type == ForceType::buoyancy) {
    const Vec3<S> g = state_.settings.gravity;
    const Direction<S> down = direction_of(g.x, g.y, g.z);
    const Vec3<U> up = -Vec3<U>{down.x, down.y, down.z};
    const S sunk = force.surface_height + force.max_depth - dot(scratch_.now[slot], up);
    const S share = clamp(sunk / (force.max_depth + force.max_depth), S(0), S(1));
    const S displaced = saturate_to<S>(product(saturate_to<S>(product(force.density, force.volume)), share));
    push(slot, w, up, saturate_to<S>(product(displaced, down.length)));
  }
}

/// Once a step: which particles may come within each other's reach in it.
template <class S> void ParticleEngine<S>::find_cohering() {
  cohering_.clear();
  cohering_ends_.clear();
  for (const Cohesion<S>& cohesion : state_.cohesions.all()) {
    slots_.clear();
    reaches_.clear();
    const S half = cohesion.attract_end * S(0.5);
    for (std::uint32_t slot = 0; slot < state_.material.size() && cohesion.material; ++slot) {
      if (state_.material[slot] != cohesion.material.slot || !state_.particles.is_taken(slot)) continue;
      slots_.push_back(slot);
      reaches_.push_back(half + min(reach_of(slot), half));
    }
    const auto count = static_cast<std::uint32_t>(slots_.size());
    const std::uint32_t most = most_pairs(state_.settings.pairs, count);
    if (!grid_.find_pairs(state_.position, slots_.data(), reaches_.data(), count, cohering_, most))
      ++report_.lost_pairs;
    cohering_ends_.push_back(cohering_.size());
  }
}
template <class S> void ParticleEngine<S>::add_cohesion(const Cohesion<S>& cohesion, std::uint32_t i, std::uint32_t k) {
  const Vec3<S> d = scratch_.now[k] - scratch_.now[i];
  const Direction<S> way = direction_of(d.x, d.y, d.z);
  if (!(way.length <= cohesion.attract_end)) return;  // NaN is nowhere near
  S force = S(0);                                     // towards each other
  if (way.length < cohesion.repel_distance) {
    force = -(cohesion.repel_force * ((cohesion.repel_distance - way.length) / cohesion.repel_distance));
  } else if (cohesion.attract_start < way.length) {
    const S part = (way.length - cohesion.attract_start) / (cohesion.attract_end - cohesion.attract_start);
    force = cohesion.attract_force * part;
  }
  const Vec3<U> u = {way.x, way.y, way.z};
  push(i, state_.inverse_mass[i], u, force);
  push(k, state_.inverse_mass[k], -u, force);
}

}  // namespace isostep
