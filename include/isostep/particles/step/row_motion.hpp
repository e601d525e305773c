// The relative motion of a constraint's two sides: how fast they part, what forces add to that, and impulses on both.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/axes.hpp"
#include "isostep/particles/constraint.hpp"
#include "isostep/particles/limits.hpp"

namespace isostep::detail {

/// Returns n.(v_b - v_a) [m/s], below 0 while the sides close.
template <class S>
ISO_INLINE Velocity<S> separating_speed(const ParticleConstraint<S>& row, const Axes<Velocity<S>>& velocity) {
  using V = Velocity<S>;
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : velocity[row.b];
  return saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, velocity[row.a]));
}

/// Returns [m/s] what accelerations add to the closing speed in a sub-step.
template <class S>
ISO_INLINE Velocity<S> closing_gain(const ParticleConstraint<S>& row, const Axes<S>& acceleration, Step<S> h) {
  using V = Velocity<S>;
  const V of_a = saturate_to<V>(product(saturate_to<S>(dot_sum(row.normal, acceleration[row.a])), h));
  const V of_b = row.b == kNoParticle
                     ? saturate_to<V>(dot_sum(row.normal, row.surface_gain))
                     : saturate_to<V>(product(saturate_to<S>(dot_sum(row.normal, acceleration[row.b])), h));
  return saturating_subtract(of_a, of_b);
}

/// Gives each side its share of a change of relative velocity. Equal masses get exactly opposite halves.
template <class S> ISO_INLINE void give(ParticleConstraint<S>& row, Axes<Velocity<S>>& velocity, Vec3<Velocity<S>> j) {
  using V = Velocity<S>;
  const V most = passing_speed<S>();
  const Vec3<V> a = saturating_subtract(velocity[row.a], j * row.share_a);
  velocity.set(row.a, held_within(a, most));
  const Vec3<V> other = row.b == kNoParticle ? row.surface_velocity : velocity[row.b];
  const Vec3<V> b = held_within(saturating_add(other, j * row.share_b), most);
  if (row.b != kNoParticle) return velocity.set(row.b, b);
  row.surface_velocity = b;
  row.total = saturating_add(row.total, j);
}

}  // namespace isostep::detail
