// ParticleEngine: one step, stage by stage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"

namespace isostep {

template <class S> ParticleReport ParticleEngine<S>::step(const ParticleStageObserver& observer) {
  const auto after = [&](ParticleStage stage) {
    if (observer.after != nullptr) observer.after(observer.user, stage, view(static_cast<std::uint32_t>(stage)));
    journal_.trace(*this);
  };
  journal_.trace(*this);
  begin_step();
  find_contacts();
  after(ParticleStage::find_contacts);
  solve_substeps();
  after(ParticleStage::solve_substeps);
  if (is_soft()) restitute();
  after(ParticleStage::restitution);
  store_impulses();
  after(ParticleStage::store_impulses);
  finalise_particles();
  after(ParticleStage::finalise_particles);
  yield_springs();
  after(ParticleStage::yield_springs);
  ++state_.tick;
  expire_particles();
  after(ParticleStage::expire_particles);
  return report_;
}

template <class S> StageView ParticleEngine<S>::view(std::uint32_t stage) {
  const auto hash = [](const void* engine) { return static_cast<const ParticleEngine*>(engine)->hash(); };
  return {{this, hash, &ParticleEngine::walk_leaves}, stage};
}

template <class S> void ParticleEngine<S>::begin_step() {
  events_.clear();
  report_ = {};
  const std::size_t count = state_.material.size();
  scratch_.acceleration.resize(count);
  scratch_.displacement.assign(count, V(0));
  for (const ParticlePush<S>& push : state_.pushes) {
    if (push.cut != 0) note_cut_force(push.slot);
  }
  looks_left_ = most_looks(state_.settings.looks, count);
  prepare_flight();
  contact_softness_ = soften(detail::kParticleContactAngle<S>, detail::kParticleContactDamping<S>, rate_);
  link_softness_ = soften(detail::kLinkAngle<S>, detail::kLinkDamping<S>, rate_);
}

template <class S> void ParticleEngine<S>::solve_substeps() {
  prepare_springs();
  const bool joined = has_forces() || !rows_.empty();
  const Integrator integrator = state_.settings.integrator;
  const bool plain = integrator == Integrator::semi_implicit_euler || integrator == Integrator::explicit_euler;
  // The book's resolver stands between velocities and positions, which rounds once more: then everywhere, so that what
  // flies alone does not know whether others touch.
  const bool resolves = !is_soft() && state_.settings.stepping == Stepping::fixed;
  if (!joined && plain && !resolves) return fly_free();
  scratch_.now = state_.position;
  find_cohering();
  for (std::int32_t i = 0; i < state_.settings.substeps; ++i) {
    hurry_surfaces();
    if (rows_.empty() && !resolves) fly_joined();
    else if (is_soft()) soften_substep();
    else resolve_substep();
    move_surfaces();
    renew_positions();
  }
}

template <class S> void ParticleEngine<S>::hurry_surfaces() {
  for (std::size_t i = first_touch_; i < rows_.size(); ++i) {
    ParticleConstraint<S>& row = rows_[i];
    row.surface_velocity = saturating_add(row.surface_velocity, row.surface_gain);
  }
}
/// What is touched goes on at its own pace, as the impulses changed it.
template <class S> void ParticleEngine<S>::move_surfaces() {
  for (std::size_t i = first_touch_; i < rows_.size(); ++i) {
    ParticleConstraint<S>& row = rows_[i];
    const V pace = saturate_to<V>(dot_sum(row.normal, row.surface_velocity));
    row.surface_moved = saturating_add(row.surface_moved, pace * h_);
  }
}

template <class S> void ParticleEngine<S>::store_impulses() {
  for (std::uint32_t i = 0; i < first_contact_ && is_soft(); ++i)
    state_.link_impulses[rows_[i].other] = rows_[i].impulse;
  std::size_t kept = 0, old = 0;
  for (std::uint32_t i = first_contact_; i < first_touch_; ++i) {
    const ParticleConstraint<S>& row = rows_[i];
    ParticleContact<S> contact = state_.contacts[i - first_contact_];
    if (is_soft()) {  // the book's resolver begins anew every time
      contact.impulse = row.impulse;
      contact.friction_impulse = row.friction_impulse;
    }
    if (!(V(0) < row.impulse_seen)) continue;
    while (old < old_contacts_.size() && old_contacts_[old].key() < contact.key()) ++old;
    if (old == old_contacts_.size() || old_contacts_[old].key() != contact.key()) tell_contact(contact, row);
    state_.contacts[kept++] = contact;
  }
  state_.contacts.resize(kept);
  for (std::size_t i = first_touch_; i < rows_.size(); ++i) {
    const ParticleTouch<S>& touch = state_.touches[i - first_touch_];
    // Both sides' masses: what a heavy side gained is nothing but rounding.
    const InverseMass<S> both = saturating_add(state_.inverse_mass[rows_[i].a], touch.inverse_mass);
    const Vec3<V> total = rows_[i].total;
    const auto part = [&](V j) { return InverseMass<S>(0) < both ? divide_to<S>(j, both) : S(0); };
    events_.touch_impulses.push_back({part(total.x), part(total.y), part(total.z)});
  }
  state_.touches.clear();
  state_.pushes.clear();
}

template <class S>
void ParticleEngine<S>::tell_contact(const ParticleContact<S>& contact, const ParticleConstraint<S>& row) {
  ParticleContactBegin<S> begin = {};
  begin.a = state_.particles.template id_of<ParticleId>(contact.a);
  const bool scenery = (contact.b & ParticleContact<S>::kCollider) != 0;
  const std::uint32_t slot = contact.b & ~ParticleContact<S>::kCollider;
  if (scenery) begin.collider = state_.colliders.slots().template id_of<ColliderId>(slot);
  else begin.b = state_.particles.template id_of<ParticleId>(slot);
  begin.speed = convert<S>(-row.approach);
  events_.contact_begin.push_back(begin);
}

template <class S> void ParticleEngine<S>::finalise_particles() {
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  const auto width = static_cast<std::uint32_t>(kernels_->width);
  for (std::uint32_t slot = 0; slot < count;) {
    slot = kernels_->finish(flight(slot));
    for (const std::uint32_t end = min(slot + width, count); slot < end; ++slot) finish_particle(slot);
  }
  if (report_.stopped == 0) return;
  // What held a stopped particle bears impulses that are no numbers either.
  for (V& impulse : state_.link_impulses) {
    if (!is_finite(impulse)) impulse = V(0);
  }
  std::erase_if(state_.contacts, [](const ParticleContact<S>& contact) {
    return !is_finite(contact.impulse) || !is_finite(contact.friction_impulse);
  });
}

/// Nothing leaves the scalar's range and no NaN enters the state: what would is cut, put back or stopped, and reported.
template <class S> ISO_INLINE void ParticleEngine<S>::finish_particle(std::uint32_t slot) {
  const Vec3<S> p = state_.position[slot] + convert<S>(scratch_.displacement[slot]);
  const Vec3<V> v = state_.velocity[slot];
  if (!is_finite(p) || !is_finite(v)) {
    state_.velocity.set(slot, Vec3<V>::zero());
    ++report_.stopped;
    return;
  }
  state_.position.set(slot, p);
  const V speed = convert<V>(ParticleLimits<S>::speed());
  if (speed < max_abs(v)) {
    state_.velocity.set(slot, held_within(v, speed));
    ++report_.clamped_speed;
  }
  const S edge = ParticleLimits<S>::position();
  if (edge < max_abs(p)) {
    for (int axis = 0; axis < 3; ++axis) {
      if (detail::lies_within(p[axis], edge)) continue;
      Vec3<V> stopped = state_.velocity[slot];
      Vec3<S> held = state_.position[slot];
      stopped[axis] = V(0);
      held[axis] = clamp(p[axis], -edge, edge);
      state_.velocity.set(slot, stopped);
      state_.position.set(slot, held);
    }
    ++report_.clamped_position;
  }
}

/// Beyond its elastic limit a spring stays deformed: its rest length follows (Millington, ch. 6.1.2).
template <class S> void ParticleEngine<S>::yield_springs() {
  if (!springs_yield_) return;
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
    const SpringId id = state_.springs.slots().template id_of<SpringId>(slot);
    state_.springs.change(id).rest_length = rest;
    events_.yielded.push_back(id);
  }
}

template <class S> void ParticleEngine<S>::expire_particles() {
  for (const ParticleLifetime& lifetime : state_.lifetimes) {
    if (state_.tick < lifetime.last_tick) continue;
    const std::uint32_t slot = lifetime.slot;
    events_.expired.push_back({state_.particles.template id_of<ParticleId>(slot),
                               state_.materials.slots().template id_of<ParticleMaterialId>(state_.material[slot]),
                               state_.position[slot], convert<S>(state_.velocity[slot])});
  }
  if (events_.expired.empty()) return;
  doomed_.clear();
  for (const ParticleExpired<S>& gone : events_.expired) doomed_.push_back(gone.particle.slot);
  bury_doomed();
}

}  // namespace isostep
