// ParticleFinish: blocks of particles that are well, and each of those that are not.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/checks.hpp"
#include "isostep/particles/step/finish.hpp"

namespace isostep {

template <class S>
ParticleFinish<S>::ParticleFinish(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight)
    : state_(state), step_(step), flight_(flight) {}

template <class S> void ParticleFinish<S>::finalise() {
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  const auto width = static_cast<std::uint32_t>(flight_.kernels().width);
  for (std::uint32_t slot = 0; slot < count;) {
    slot = flight_.finish(slot);
    for (const std::uint32_t end = min(slot + width, count); slot < end; ++slot) finish(slot);
  }
  if (step_.report.stopped != 0) forget_broken_impulses();
}

template <class S> ISO_INLINE void ParticleFinish<S>::finish(std::uint32_t slot) {
  const Vec3<S> p = state_.position[slot] + convert<S>(step_.displacement[slot]);
  const Vec3<V> v = state_.velocity[slot];
  if (!is_finite(p) || !is_finite(v)) {
    state_.velocity.set(slot, Vec3<V>::zero());
    ++step_.report.stopped;
    return;
  }
  state_.position.set(slot, p);
  const V speed = convert<V>(ParticleLimits<S>::speed());
  if (speed < max_abs(v)) {
    state_.velocity.set(slot, held_within(v, speed));
    ++step_.report.clamped_speed;
  }
  if (ParticleLimits<S>::position() < max_abs(p)) hold_at_edge(slot, p);
}
template <class S> void ParticleFinish<S>::hold_at_edge(std::uint32_t slot, Vec3<S> p) {
  const S edge = ParticleLimits<S>::position();
  for (int axis = 0; axis < 3; ++axis) {
    if (detail::lies_within(p[axis], edge)) continue;
    Vec3<V> stopped = state_.velocity[slot];
    Vec3<S> held = state_.position[slot];
    stopped[axis] = V(0);
    held[axis] = clamp(p[axis], -edge, edge);
    state_.velocity.set(slot, stopped);
    state_.position.set(slot, held);
  }
  ++step_.report.clamped_position;
}
/// Sets impulses that are no numbers to 0: constraints of a stopped particle may have them.
template <class S> void ParticleFinish<S>::forget_broken_impulses() {
  for (V& impulse : state_.link_impulses) {
    if (!is_finite(impulse)) impulse = V(0);
  }
  std::erase_if(state_.contacts, [](const ParticleContact<S>& contact) {
    return !is_finite(contact.impulse) || !is_finite(contact.friction_impulse);
  });
}

}  // namespace isostep
