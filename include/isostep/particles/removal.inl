// ParticleRemoval: particles all at once, a pass over each list that may name them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/removal.hpp"

namespace isostep {

template <class S> ParticleRemoval<S>::ParticleRemoval(ParticleState<S>& state) : state_(state) {}

template <class S> void ParticleRemoval<S>::remove(ParticleId particle) {
  leaving_.assign(1, particle.slot);
  remove_leaving();
}
template <class S> void ParticleRemoval<S>::expire(ParticleEvents<S>& events) {
  leaving_.clear();
  for (const ParticleLifetime& lifetime : state_.lifetimes) {
    if (state_.tick < lifetime.last_tick) continue;
    const std::uint32_t slot = lifetime.slot;
    events.expired.push_back({state_.particles.template id_of<ParticleId>(slot),
                              state_.materials.slot_map().template id_of<ParticleMaterialId>(state_.material[slot]),
                              state_.position[slot], convert<S>(state_.velocity[slot])});
    leaving_.push_back(slot);
  }
  if (!leaving_.empty()) remove_leaving();
}

/// Removes all leaving particles at once, by a pass over each list: a crowd may expire in one step.
template <class S> void ParticleRemoval<S>::remove_leaving() {
  is_leaving_.resize(state_.material.size(), 0);
  for (const std::uint32_t slot : leaving_) is_leaving_[slot] = 1;
  const auto leaves = [this](ParticleId id) { return static_cast<bool>(id) && is_leaving_[id.slot] != 0; };
  remove_naming<SpringId>(state_.springs,
                          [&](const Spring<S>& spring) { return leaves(spring.a) || leaves(spring.b); });
  remove_naming<ForceId>(state_.forces, [&](const ParticleForce<S>& force) { return leaves(force.particle); });
  remove_naming<LinkId>(state_.links, [&](const Link<S>& link) { return leaves(link.a) || leaves(link.b); });
  const auto is_gone = [this](std::uint32_t slot) { return slot < is_leaving_.size() && is_leaving_[slot] != 0; };
  std::erase_if(state_.lifetimes, [&](const ParticleLifetime& life) { return is_gone(life.slot); });
  std::erase_if(state_.pushes, [&](const ParticlePush<S>& push) { return is_gone(push.slot); });
  std::erase_if(state_.contacts, [&](const ParticleContact<S>& c) { return is_gone(c.a) || is_gone(c.b); });
  std::erase_if(state_.touches, [&](const ParticleTouch<S>& touch) { return is_gone(touch.particle.slot); });
  for (const std::uint32_t slot : leaving_) free_slot(slot);
}
template <class S>
template <class Id, class Registry, class Names>
void ParticleRemoval<S>::remove_naming(const Registry& registry, const Names& names) {
  for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
    if (registry.is_taken(slot) && names(registry.all()[slot]))
      remove_record(registry.slot_map().template id_of<Id>(slot));
  }
}
/// Clears a free slot, so that it looks the same whatever was there.
template <class S> void ParticleRemoval<S>::free_slot(std::uint32_t slot) {
  is_leaving_[slot] = 0;
  state_.position.set(slot, Vec3<S>::zero());
  state_.velocity.set(slot, Vec3<V>::zero());
  state_.inverse_mass[slot] = InverseMass<S>(0);
  state_.material[slot] = 0;
  state_.particles.give_back(slot);
}

template <class S> void ParticleRemoval<S>::forget(LinkId link) { state_.link_impulses[link.slot] = V(0); }
template <class S> void ParticleRemoval<S>::forget(ColliderId collider) {
  const std::uint32_t b = ParticleContact<S>::kCollider | collider.slot;
  std::erase_if(state_.contacts, [b](const ParticleContact<S>& contact) { return contact.b == b; });
}

}  // namespace isostep
