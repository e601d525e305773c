// Checks of a state from a file: it must keep every rule that commands and steps of a particle world keep.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/checks.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/state/pack.hpp"

namespace isostep {

template <class S> class ParticleValidator {
 public:
  explicit ParticleValidator(const ParticleState<S>& state) : state_(state) {}

  /// Returns the first rule that does not hold, as a literal, or null.
  const char* broken_rule() const {
    if (!settings_hold()) return "settings are out of range";
    if (const char* rule = sizes()) return rule;
    if (const char* rule = particles()) return rule;
    if (const char* rule = records()) return rule;
    return lists();
  }

 private:
  using V = Velocity<S>;

  bool settings_hold() const {
    const ParticleSettings<S>& s = state_.settings;
    return 10 <= s.hz && s.hz <= 1000 && 1 <= s.substeps && s.substeps <= 64 && s.hz * s.substeps <= kMaxParticleRate &&
           detail::fault_of_velocity(s.gravity) == Fault::none &&
           static_cast<std::uint32_t>(s.integrator) < kIntegrators &&
           static_cast<std::uint32_t>(s.solver) < kParticleSolvers &&
           static_cast<std::uint32_t>(s.stepping) < kSteppings && s.pairs <= kMostParticlePairs;
  }
  const char* sizes() const {
    const std::size_t count = state_.particles.entries().size();
    for (const auto* axis : {&state_.position.x, &state_.position.y, &state_.position.z}) {
      if (axis->size() != count) return "positions are not one a particle";
    }
    for (const auto* axis : {&state_.velocity.x, &state_.velocity.y, &state_.velocity.z}) {
      if (axis->size() != count) return "velocities are not one a particle";
    }
    if (state_.inverse_mass.size() != count || state_.material.size() != count)
      return "masses or materials are not one a particle";
    if (state_.link_impulses.size() != state_.links.all().size()) return "impulses are not one a link";
    const char* rule = nullptr;
    ParticleState<S>::registries(
        [&](const char*, const auto& registry) {
          if (registry.all().size() != registry.slot_map().entries().size()) rule = "records are not one a slot";
        },
        state_);
    return rule;
  }
  const char* particles() const {
    const SlotMap& slot_map = state_.particles;
    for (std::uint32_t slot = 0; slot < slot_map.entries().size(); ++slot) {
      const Vec3<S> p = state_.position[slot];
      const Vec3<V> v = state_.velocity[slot];
      const InverseMass<S> w = state_.inverse_mass[slot];
      if (!slot_map.is_taken(slot)) {
        const bool empty =
            p == Vec3<S>::zero() && v == Vec3<V>::zero() && w == InverseMass<S>(0) && state_.material[slot] == 0;
        if (!empty) return "a free slot holds a particle";
        continue;
      }
      if (detail::fault_of_position(p) != Fault::none) return "a position is out of range";
      if (!is_finite(v) || !detail::lies_within(v, convert<V>(ParticleLimits<S>::speed())))
        return "a velocity is out of range";
      const InverseMass<S> most = divide_to<InverseMass<S>>(S(1), ParticleLimits<S>::least_mass());
      if (!is_finite(w) || w < InverseMass<S>(0) || most < w) return "a mass is out of range";
      if (!is_material(state_.material[slot])) return "a particle's material is none";
    }
    return nullptr;
  }
  bool is_material(std::uint32_t slot) const {
    return slot < state_.materials.all().size() && state_.materials.is_taken(slot);
  }
  bool is_particle(std::uint32_t slot) const {
    return slot < state_.particles.entries().size() && state_.particles.is_taken(slot);
  }
  bool ends_hold(ParticleId a, ParticleId b) const {
    return state_.particles.holds(a) && (!b || state_.particles.holds(b));
  }
  /// Returns true if records obey their own rules and name existing objects. A free slot holds the empty record.
  template <class Records, class Names> bool hold(const Records& registry, const Names& names) const {
    for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
      if (!registry.is_taken(slot)) continue;
      const auto& record = registry.all()[slot];
      if (detail::fault_of(record) != Fault::none || !names(record)) return false;
    }
    return true;
  }
  template <class Records> bool free_are_empty(const Records& registry) const {
    using Record = std::decay_t<decltype(registry.all()[0])>;
    std::uint8_t empty[kPackedSize<Record> + 1], held[kPackedSize<Record> + 1];
    pack(empty, Record{});
    for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
      if (registry.is_taken(slot)) continue;
      pack(held, registry.all()[slot]);
      for (std::size_t i = 0; i < kPackedSize<Record>; ++i) {
        if (held[i] != empty[i]) return false;
      }
    }
    return true;
  }
  const char* records() const {
    if (state_.materials.all().empty() || !state_.materials.is_taken(0)) return "the first material is missing";
    bool empty = true;
    ParticleState<S>::registries([&](const char*, const auto& registry) { empty = empty && free_are_empty(registry); },
                                 state_);
    if (!empty) return "a free slot holds a record";
    if (!hold(state_.materials, [](const auto&) { return true; })) return "a material breaks its rules";
    if (!hold(state_.springs, [&](const Spring<S>& s) { return ends_hold(s.a, s.b); }))
      return "a spring breaks its rules";
    if (!hold(state_.forces, [&](const ParticleForce<S>& f) { return ends_hold(f.particle, {}); }))
      return "a force breaks its rules";
    if (!hold(state_.cohesions, [&](const Cohesion<S>& c) { return state_.materials.holds(c.material); }))
      return "a cohesion breaks its rules";
    if (!hold(state_.links, [&](const Link<S>& l) { return ends_hold(l.a, l.b); })) return "a link breaks its rules";
    if (!hold(state_.colliders, [](const auto&) { return true; })) return "a collider breaks its rules";
    return nullptr;
  }
  const char* lists() const {
    for (const V impulse : state_.link_impulses) {
      if (!is_finite(impulse)) return "a link's impulse is no number";
    }
    std::uint64_t key = 0;
    for (const ParticleContact<S>& contact : state_.contacts) {
      const bool ascends = &contact == state_.contacts.data() || key < contact.key();
      key = contact.key();
      const std::uint32_t collider = contact.other_slot();
      const bool other = contact.with_collider()
                             ? collider < state_.colliders.all().size() && state_.colliders.is_taken(collider)
                             : contact.a < contact.b && is_particle(contact.b);
      if (!ascends || !is_particle(contact.a) || !other) return "contacts are not of what is there, ascending";
      if (!is_finite(contact.impulse) || !is_finite(contact.friction_impulse) || contact.impulse < V(0))
        return "a contact's impulse is no number";
    }
    for (std::size_t i = 0; i < state_.pushes.size(); ++i) {
      const ParticlePush<S>& push = state_.pushes[i];
      const bool ascends = i == 0 || state_.pushes[i - 1].slot < push.slot;
      if (!ascends || !is_particle(push.slot) || 1 < push.cut || !is_finite(push.acceleration) ||
          !detail::lies_within(push.acceleration, ParticleLimits<S>::acceleration())) {
        return "a push breaks its rules";
      }
    }
    for (const ParticleTouch<S>& touch : state_.touches) {
      if (detail::fault_of(touch) != Fault::none || !state_.particles.holds(touch.particle))
        return "a touch breaks its rules";
    }
    for (std::size_t i = 0; i < state_.lifetimes.size(); ++i) {
      const ParticleLifetime& life = state_.lifetimes[i];
      const bool ascends = i == 0 || state_.lifetimes[i - 1].slot < life.slot;
      if (!ascends || !is_particle(life.slot) || life.reserved != 0) return "a lifetime breaks its rules";
    }
    return nullptr;
  }

  const ParticleState<S>& state_;
};

}  // namespace isostep
