// ParticleEngine: which constraints hold in a step, and where they stand.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"

namespace isostep {

namespace detail {
/// How both sides of a row share an impulse. Two pinned ends share nothing.
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

/// Once a step: links; contacts that may come about within it, ascending by key, with the impulses they had; touches.
template <class S> void ParticleEngine<S>::find_contacts() {
  old_contacts_.swap(state_.contacts);
  state_.contacts.clear();
  rows_.clear();
  add_links();
  find_pulls();
  first_contact_ = static_cast<std::uint32_t>(rows_.size());
  find_pairs();
  std::size_t old = 0, pair = 0;
  const bool scenery = !state_.colliders.all().empty();
  if (scenery || !pairs_.empty()) {
    for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
      for (; pair < pairs_.size() && pairs_[pair] >> 32 == slot; ++pair)
        find_pair(slot, static_cast<std::uint32_t>(pairs_[pair]), old);
      if (scenery && InverseMass<S>(0) < state_.inverse_mass[slot]) find_scenery(slot, old);
    }
  }
  first_touch_ = static_cast<std::uint32_t>(rows_.size());
  add_touches();
}

/// Whether any particle may meet anything but touches and links.
template <class S> bool ParticleEngine<S>::may_meet() const {
  bool collides = false;
  for (const ParticleMaterial<S>& material : state_.materials.all()) collides = collides || material.collides;
  return collides || !state_.colliders.all().empty() || !state_.cohesions.all().empty();
}
/// How far springs may carry their ends in a step beside their velocity: k h^2 / m of the extension, and to its other
/// side at most.
template <class S> void ParticleEngine<S>::find_pulls() {
  pulls_.clear();
  if (state_.springs.all().empty() || !may_meet()) return;
  pulls_.assign(state_.material.size(), S(0));
  const S rate = S(state_.settings.hz);
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a) continue;
    const Vec3<S> d = state_.position[spring.a.slot] - (spring.b ? state_.position[spring.b.slot] : spring.anchor);
    const S extension = abs(length(d) - spring.rest_length);
    const auto pull = [&](std::uint32_t slot) {
      const S part = saturate_to<S>(product(spring.stiffness, state_.inverse_mass[slot])) / rate / rate;
      pulls_[slot] = saturating_add(pulls_[slot], saturate_to<S>(product(extension, min(part, S(2)))));
    };
    pull(spring.a.slot);
    if (spring.b) pull(spring.b.slot);
  }
}
/// How far a particle may come in a step [m], more or less: what it meets sooner is found now.
template <class S> ISO_INLINE S ParticleEngine<S>::reach_of(std::uint32_t slot) const {
  const Vec3<V> v = state_.velocity[slot];
  const V most = max(max_abs(v), V(1));  // [m/s] what a force may do within a step
  const S way = convert<S>(most) * (h_ * Step<S>(0.5)) * S(4 * state_.settings.substeps);
  return pulls_.empty() ? way : min(saturating_add(way, pulls_[slot]), ParticleLimits<S>::position());
}

/// Particles that collide with each other, pair by pair, ascending.
template <class S> void ParticleEngine<S>::find_pairs() {
  pairs_.clear();
  slots_.clear();
  reaches_.clear();
  bool any = false;
  for (const ParticleMaterial<S>& material : state_.materials.all()) any = any || material.collides;
  if (!any) return;
  const bool divides = state_.settings.stepping == Stepping::time_division;
  for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
    const ParticleMaterial<S>& material = material_of(slot);
    if (!material.collides || !state_.particles.is_taken(slot)) continue;
    slots_.push_back(slot);
    // A bullet would pair with all that lies about its way. It meets what is no smaller than its sub-step is long; for
    // more there is time division.
    const S way = reach_of(slot);
    reaches_.push_back(material.radius + (divides ? way : min(way, material.radius + material.radius)));
  }
  if (slots_.size() < 2) return;
  const auto count = static_cast<std::uint32_t>(slots_.size());
  const std::uint32_t most = most_pairs(state_.settings.pairs, count);
  const bool all = grid_.find_pairs(state_.position, slots_.data(), reaches_.data(), count, pairs_, most);
  if (!all) ++report_.lost_pairs;
}
template <class S> void ParticleEngine<S>::find_pair(std::uint32_t a, std::uint32_t b, std::size_t& old) {
  if (!(InverseMass<S>(0) < state_.inverse_mass[a]) && !(InverseMass<S>(0) < state_.inverse_mass[b])) return;
  const ParticleMaterial<S>&of_a = material_of(a), &of_b = material_of(b);
  ParticleMaterial<S> mixed = of_a;
  mixed.friction = min(of_a.friction, of_b.friction);
  mixed.restitution = max(of_a.restitution, of_b.restitution);
  add_contact(a, b, of_a.radius + of_b.radius, mixed, old);
}

template <class S> void ParticleEngine<S>::find_scenery(std::uint32_t slot, std::size_t& old) {
  const ParticleMaterial<S>& material = material_of(slot);
  const S reach = material.radius + reach_of(slot);
  for (std::uint32_t i = 0; i < state_.colliders.all().size(); ++i) {
    if (!state_.colliders.is_taken(i)) continue;
    if (distance_to(state_.colliders.all()[i], state_.position[slot]).distance < reach)
      add_contact(slot, ParticleContact<S>::kCollider | i, material.radius, material, old);
  }
}

template <class S>
void ParticleEngine<S>::add_contact(std::uint32_t a, std::uint32_t b, S radius, const ParticleMaterial<S>& material,
                                    std::size_t& old) {
  const bool scenery = (b & ParticleContact<S>::kCollider) != 0;
  ParticleConstraint<S> row = {};
  row.kind = ConstraintKind::contact;
  row.a = a;
  row.b = scenery ? kNoParticle : b;
  row.other = scenery ? b & ~ParticleContact<S>::kCollider : kNoParticle;
  row.radius = radius;
  detail::set_shares(row, state_.inverse_mass[a], scenery ? InverseMass<S>(0) : state_.inverse_mass[b]);
  row.friction = material.friction;
  row.restitution = material.restitution;
  ParticleContact<S> contact = {a, b, V(0), Vec3<V>::zero()};
  while (old < old_contacts_.size() && old_contacts_[old].key() < contact.key()) ++old;
  if (old < old_contacts_.size() && old_contacts_[old].key() == contact.key()) {
    row.impulse = old_contacts_[old].impulse;
    row.friction_impulse = old_contacts_[old].friction_impulse;
  }
  rows_.push_back(row);
  state_.contacts.push_back(contact);
}

template <class S> void ParticleEngine<S>::add_touches() {
  for (const ParticleTouch<S>& touch : state_.touches) {
    ParticleConstraint<S> row = {};
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
    const auto gain = [&](S acceleration) { return saturate_to<V>(product(acceleration, h_)); };
    const Vec3<S> a = touch.surface_acceleration;
    row.surface_gain = {gain(a.x), gain(a.y), gain(a.z)};
    rows_.push_back(row);
  }
}

template <class S> void ParticleEngine<S>::add_links() {
  for (std::uint32_t slot = 0; slot < state_.links.all().size(); ++slot) {
    const Link<S>& link = state_.links.all()[slot];
    if (!link.a) continue;
    ParticleConstraint<S> row = {};
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
    rows_.push_back(row);
  }
}

/// Where the rows stand now: a passing particle must not meet the plane through where something was.
template <class S> void ParticleEngine<S>::look() {
  for (std::size_t i = 0; i < first_contact_; ++i) look_at_link(rows_[i]);
  for (std::size_t i = first_contact_; i < first_touch_; ++i) look_at_contact(rows_[i]);
  for (std::size_t i = first_touch_; i < rows_.size(); ++i) look_at_touch(rows_[i]);
}
template <class S> ISO_INLINE void ParticleEngine<S>::look_at_link(ParticleConstraint<S>& row) {
  const Link<S>& link = state_.links.all()[row.other];
  const Vec3<S> b = row.b == kNoParticle ? link.anchor : scratch_.now[row.b];
  const Vec3<S> d = b - scratch_.now[row.a];
  const Direction<S> way = direction_of(d.x, d.y, d.z);
  const bool rod = row.kind == ConstraintKind::rod;
  // Upwards a rod opens whose ends are in one place, as particles part that are.
  const Vec3<U> n = rod && way.length == S(0) ? Vec3<U>{U(0), U(1), U(0)} : Vec3<U>{way.x, way.y, way.z};
  row.normal = rod ? n : -n;
  row.separation = rod ? way.length - link.length : link.length - way.length;
}
template <class S> ISO_INLINE void ParticleEngine<S>::look_at_contact(ParticleConstraint<S>& row) {
  const Vec3<S> a = scratch_.now[row.a];
  if (row.b == kNoParticle) {
    const SceneryDistance<S> met = distance_to(state_.colliders.all()[row.other], a);
    row.normal = -met.normal;
    row.separation = met.distance - row.radius;
    return;
  }
  const Vec3<S> d = scratch_.now[row.b] - a;
  const Direction<S> way = direction_of(d.x, d.y, d.z);
  // Particles in one place go apart upwards: any direction does, if it is the same everywhere.
  row.normal = way.length == S(0) ? Vec3<U>{U(0), U(1), U(0)} : Vec3<U>{way.x, way.y, way.z};
  row.separation = way.length - row.radius;
}
/// What is touched keeps its face for the step.
template <class S> ISO_INLINE void ParticleEngine<S>::look_at_touch(ParticleConstraint<S>& row) {
  const V moved = saturate_to<V>(-dot_sum(row.normal, scratch_.displacement[row.a]));
  row.separation = -row.radius + convert<S>(saturating_add(moved, row.surface_moved));
}

}  // namespace isostep
