// ParticleStep: what the systems of a step share: its time, where particles are within it, and what it reports.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/particles/axes.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/particle_events.hpp"
#include "isostep/particles/settings.hpp"

namespace isostep {

namespace detail {
/// Returns v + a h, saturated to the format.
template <class S> ISO_INLINE Velocity<S> pushed(Velocity<S> v, S a, Step<S> h) {
  using V = Velocity<S>;
  const V limit = passing_speed<S>();
  const V speed = convert<V>(ParticleLimits<S>::speed());
  const V most = speed + speed;
  return clamp(v + clamp(saturate_to<V>(product(a, h)), -most, most), -limit, limit);
}
template <class S> ISO_INLINE Vec3<Velocity<S>> pushed(Vec3<Velocity<S>> v, Vec3<S> a, Step<S> h) {
  return {pushed<S>(v.x, a.x, h), pushed<S>(v.y, a.y, h), pushed<S>(v.z, a.z, h)};
}
template <class S> ISO_INLINE Vec3<Velocity<S>> travelled(Vec3<Velocity<S>> v, Step<S> h) {
  return {v.x * h, v.y * h, v.z * h};
}
}  // namespace detail

/// The shared data of a step. Arrays are by slot.
template <class S> struct ParticleStep {
  using V = Velocity<S>;

  Step<S> h = Step<S>(0);  // [s] a sub-step
  S rate = S(0);           // [1/s] 1/h
  Axes<V> displacement;    // [m] since the step began: finer than positions where S is narrow
  Axes<S> now;             // [m] position + displacement
  Axes<S> acceleration;    // [m/s^2]
  ParticleEvents<S> events;
  ParticleReport report;

  ISO_INLINE void begin(const ParticleSettings<S>& settings, std::size_t particles) {
    forget_results();
    acceleration.resize(particles);
    displacement.assign(particles, V(0));
    rate = S(settings.hz * settings.substeps);
    h = divide_to<Step<S>>(S(1), rate);
  }
  ISO_INLINE void forget_results() {
    events.clear();
    report = {};
  }

  /// Adds an acceleration. Sums of many forces end at the format's ends.
  ISO_INLINE void add_acceleration(std::uint32_t slot, Vec3<S> a) {
    acceleration.set(slot, saturating_add(acceleration[slot], a));
  }
  ISO_INLINE void move_on(std::uint32_t slot, Vec3<V> way) {
    displacement.set(slot, held_within(saturating_add(displacement[slot], way), passing_distance<S>()));
  }
  /// Moves displacements by the change that constraints made to velocities; `before` are the velocities without it.
  ISO_INLINE void follow_constraints(const Axes<V>& velocity, const Axes<V>& before) {
    for (std::uint32_t i = 0; i < velocity.size(); ++i)
      move_on(i, detail::travelled<S>(saturating_subtract(velocity[i], before[i]), h));
  }
};

}  // namespace isostep
