// ParticleContacts: finding, merging with the last step's, and storing.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/scenery.hpp"
#include "isostep/particles/step/contacts.hpp"

namespace isostep {

namespace detail {
/// Sets the share of an impulse that each side of a row takes. Two pinned ends share nothing.
template <class S> ISO_INLINE void set_shares(ParticleConstraint<S>& row, InverseMass<S> a, InverseMass<S> b) {
  using U = Unit<S>;
  const InverseMass<S> both = saturating_add(a, b);
  if (!(InverseMass<S>(0) < both)) {
    row.share_a = row.share_b = U(0);
    return;
  }
  row.share_a = divide_to<U>(a, both);
  row.share_b = b == InverseMass<S>(0) ? U(0) : U(1) - row.share_a;
}
}  // namespace detail

template <class S>
ParticleContacts<S>::ParticleContacts(ParticleState<S>& state, ParticleStep<S>& step, PairSearch<S>& search,
                                      ParticleRows<S>& rows)
    : state_(state), step_(step), search_(search), rows_(rows) {}

template <class S> void ParticleContacts<S>::find() {
  old_contacts_.swap(state_.contacts);
  state_.contacts.clear();
  rows_.clear();
  add_links();
  rows_.end_links();
  search_.begin_step();
  find_pairs();
  std::size_t old = 0, pair = 0;
  const bool scenery = !state_.colliders.all().empty();
  if (scenery || !pairs_.empty()) {
    for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
      for (; pair < pairs_.size() && pairs_[pair] >> 32 == slot; ++pair)
        add_pair(slot, static_cast<std::uint32_t>(pairs_[pair]), old);
      if (scenery && InverseMass<S>(0) < state_.inverse_mass[slot]) add_scenery(slot, old);
    }
  }
  rows_.end_contacts();
  add_touches();
}

template <class S> void ParticleContacts<S>::add_links() {
  for (std::uint32_t slot = 0; slot < state_.links.all().size(); ++slot) {
    const Link<S>& link = state_.links.all()[slot];
    if (!link.a) continue;
    Row row = {};
    row.kind = link.type == LinkType::rod ? ConstraintKind::rod : ConstraintKind::cable;
    row.a = link.a.slot;
    row.b = link.b ? link.b.slot : kNoParticle;
    detail::set_shares(row, state_.inverse_mass[row.a], link.b ? state_.inverse_mass[row.b] : InverseMass<S>(0));
    if (row.share_a == U(0) && row.share_b == U(0)) {  // an impulse that moves nothing would grow for ever
      state_.link_impulses[slot] = V(0);
      continue;
    }
    row.restitution = link.type == LinkType::rod ? S(0) : link.restitution;
    row.other = slot;
    row.impulse = state_.link_impulses[slot];
    rows_.add(row);
  }
}

/// Finds the particles that collide with each other, pair by pair, ascending.
template <class S> void ParticleContacts<S>::find_pairs() {
  pairs_.clear();
  search_.clear();
  if (!search_.any_collides()) return;
  const bool divides = state_.settings.stepping == Stepping::time_division;
  for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
    const ParticleMaterial<S>& material = material_of(slot);
    if (!material.collides || !state_.particles.is_taken(slot)) continue;
    // A bullet would pair with all that lies about its way. It meets what is no smaller than its sub-step is long; for
    // more there is time division.
    const S way = search_.reach_of(slot);
    search_.add(slot, material.radius + (divides ? way : min(way, material.radius + material.radius)));
  }
  search_.find(pairs_);
}
template <class S> void ParticleContacts<S>::add_pair(std::uint32_t a, std::uint32_t b, std::size_t& old) {
  if (!(InverseMass<S>(0) < state_.inverse_mass[a]) && !(InverseMass<S>(0) < state_.inverse_mass[b])) return;
  const ParticleMaterial<S>&of_a = material_of(a), &of_b = material_of(b);
  ParticleMaterial<S> mixed = of_a;
  mixed.friction = min(of_a.friction, of_b.friction);
  mixed.restitution = max(of_a.restitution, of_b.restitution);
  add_contact(a, b, of_a.radius + of_b.radius, mixed, old);
}
template <class S> void ParticleContacts<S>::add_scenery(std::uint32_t slot, std::size_t& old) {
  const ParticleMaterial<S>& material = material_of(slot);
  const S reach = material.radius + search_.reach_of(slot);
  for (std::uint32_t i = 0; i < state_.colliders.all().size(); ++i) {
    if (!state_.colliders.is_taken(i)) continue;
    if (distance_to(state_.colliders.all()[i], state_.position[slot]).distance < reach)
      add_contact(slot, ParticleContact<S>::kCollider | i, material.radius, material, old);
  }
}

/// Returns true if the last step had the contact. Advances `old` to its place. Both lists ascend by key.
template <class S>
ISO_INLINE bool ParticleContacts<S>::is_old(const ParticleContact<S>& contact, std::size_t& old) const {
  while (old < old_contacts_.size() && old_contacts_[old].key() < contact.key()) ++old;
  return old < old_contacts_.size() && old_contacts_[old].key() == contact.key();
}
template <class S>
void ParticleContacts<S>::add_contact(std::uint32_t a, std::uint32_t b, S radius, const ParticleMaterial<S>& material,
                                      std::size_t& old) {
  const ParticleContact<S> contact = {a, b, V(0), Vec3<V>::zero()};
  const bool scenery = contact.with_collider();
  Row row = {};
  row.kind = ConstraintKind::contact;
  row.a = a;
  row.b = scenery ? kNoParticle : b;
  row.other = scenery ? contact.other_slot() : kNoParticle;
  row.radius = radius;
  detail::set_shares(row, state_.inverse_mass[a], scenery ? InverseMass<S>(0) : state_.inverse_mass[b]);
  row.friction = material.friction;
  row.restitution = material.restitution;
  if (is_old(contact, old)) {
    row.impulse = old_contacts_[old].impulse;
    row.friction_impulse = old_contacts_[old].friction_impulse;
  }
  rows_.add(row);
  state_.contacts.push_back(contact);
}

template <class S> void ParticleContacts<S>::add_touches() {
  for (const ParticleTouch<S>& touch : state_.touches) {
    Row row = {};
    row.kind = ConstraintKind::contact;
    row.a = touch.particle.slot;
    row.b = kNoParticle;
    row.other = kNoParticle;
    row.normal = touch.normal;
    row.radius = -touch.separation;
    detail::set_shares(row, state_.inverse_mass[row.a], touch.inverse_mass);
    row.friction = touch.friction;
    row.restitution = touch.restitution;
    row.surface_velocity = touch.surface_velocity;
    const auto gain = [&](S acceleration) { return saturate_to<V>(product(acceleration, step_.h)); };
    const Vec3<S> a = touch.surface_acceleration;
    row.surface_gain = {gain(a.x), gain(a.y), gain(a.z)};
    rows_.add(row);
  }
}

// ---- after the solver

template <class S> void ParticleContacts<S>::store(bool keeps_impulses) {
  if (keeps_impulses) {
    for (const Row& row : rows_.links()) state_.link_impulses[row.other] = row.impulse;
  }
  store_contacts(keeps_impulses);
  store_touches();
  state_.touches.clear();
  state_.pushes.clear();
}
template <class S> void ParticleContacts<S>::store_contacts(bool keeps_impulses) {
  std::size_t found = 0, kept = 0, old = 0;
  for (const Row& row : rows_.contacts()) {
    ParticleContact<S> contact = state_.contacts[found++];
    if (keeps_impulses) {
      contact.impulse = row.impulse;
      contact.friction_impulse = row.friction_impulse;
    }
    if (!(V(0) < row.impulse_seen)) continue;
    if (!is_old(contact, old)) tell_contact(contact, row);
    state_.contacts[kept++] = contact;
  }
  state_.contacts.resize(kept);
}
template <class S> void ParticleContacts<S>::tell_contact(const ParticleContact<S>& contact, const Row& row) {
  ParticleContactBegin<S> begin = {};
  begin.a = state_.particles.template id_of<ParticleId>(contact.a);
  const std::uint32_t slot = contact.other_slot();
  if (contact.with_collider()) begin.collider = state_.colliders.slot_map().template id_of<ColliderId>(slot);
  else begin.b = state_.particles.template id_of<ParticleId>(slot);
  begin.speed = convert<S>(-row.approach);
  step_.events.contact_begin.push_back(begin);
}
template <class S> void ParticleContacts<S>::store_touches() {
  std::size_t touched = 0;
  for (const Row& row : rows_.touches()) {
    const ParticleTouch<S>& touch = state_.touches[touched++];
    // Both sides' masses: what a heavy side gained is nothing but rounding.
    const InverseMass<S> both = saturating_add(state_.inverse_mass[row.a], touch.inverse_mass);
    const Vec3<V> total = row.total;
    const auto part = [&](V j) { return InverseMass<S>(0) < both ? divide_to<S>(j, both) : S(0); };
    step_.events.touch_impulses.push_back({part(total.x), part(total.y), part(total.z)});
  }
}

}  // namespace isostep
