// ParticleRows: where constraints stand.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/scenery.hpp"
#include "isostep/particles/step/rows.hpp"

namespace isostep {

template <class S>
ParticleRows<S>::ParticleRows(const ParticleState<S>& state, const ParticleStep<S>& step)
    : state_(state), step_(step) {}

template <class S> void ParticleRows<S>::clear() {
  rows_.clear();
  first_contact_ = first_touch_ = 0;
}

template <class S> void ParticleRows<S>::look() {
  for (Row& row : links()) look_at_link(row);
  for (Row& row : contacts()) look_at_contact(row);
  for (Row& row : touches()) look_at_touch(row);
}
template <class S> ISO_INLINE void ParticleRows<S>::look_at_link(Row& row) const {
  const Link<S>& link = state_.links.all()[row.other];
  const Vec3<S> b = row.b == kNoParticle ? link.anchor : step_.now[row.b];
  const Vec3<S> d = b - step_.now[row.a];
  const Heading<S> way = heading_of(d);
  const bool rod = row.kind == ConstraintKind::rod;
  // Upwards a rod opens whose ends are in one place, as particles part that are.
  const Vec3<U> n = rod && way.length == S(0) ? Vec3<U>{U(0), U(1), U(0)} : way.direction;
  row.normal = rod ? n : -n;
  row.separation = rod ? way.length - link.length : link.length - way.length;
}
template <class S> ISO_INLINE void ParticleRows<S>::look_at_contact(Row& row) const {
  const Vec3<S> a = step_.now[row.a];
  if (row.b == kNoParticle) {
    const SceneryDistance<S> met = distance_to(state_.colliders.all()[row.other], a);
    row.normal = -met.normal;
    row.separation = met.distance - row.radius;
    return;
  }
  const Vec3<S> d = step_.now[row.b] - a;
  const Heading<S> way = heading_of(d);
  // Particles in one place go apart upwards: any direction does, if it is the same everywhere.
  row.normal = way.length == S(0) ? Vec3<U>{U(0), U(1), U(0)} : way.direction;
  row.separation = way.length - row.radius;
}
/// Keeps a touched surface's normal for the step.
template <class S> ISO_INLINE void ParticleRows<S>::look_at_touch(Row& row) const {
  const V moved = saturate_to<V>(-dot_sum(row.normal, step_.displacement[row.a]));
  row.separation = -row.radius + convert<S>(saturating_add(moved, row.surface_moved));
}

template <class S> void ParticleRows<S>::accelerate_surfaces() {
  for (Row& row : touches()) row.surface_velocity = saturating_add(row.surface_velocity, row.surface_gain);
}
template <class S> void ParticleRows<S>::move_surfaces() {
  for (Row& row : touches()) {
    const V pace = saturate_to<V>(dot_sum(row.normal, row.surface_velocity));
    row.surface_moved = saturating_add(row.surface_moved, pace * step_.h);
  }
}

}  // namespace isostep
