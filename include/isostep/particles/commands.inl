// ParticleCommands: of particles, then of the records that are registered.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/particles/commands.hpp"

namespace isostep {

// ---- particles

template <class S> ParticleId ParticleCommands<S>::execute(const CreateParticle<S>& command) {
  const ParticleDefinition<S>& d = command.definition;
  const ParticleMaterialId material = d.material ? d.material : state_.first_material();
  const bool good = faults_.accept(detail::fault_of_position(d.position)) &&
                    faults_.accept(detail::fault_of_velocity(d.velocity)) &&
                    faults_.accept(d.pinned ? Fault::none : detail::fault_of_particle_mass(d.mass)) &&
                    faults_.accept(state_.materials.holds(material) ? Fault::none : Fault::stale_id);
  if (!good) return {};
  const auto id = state_.particles.template take<ParticleId>();
  place_new(id, d, material);
  return id;
}
template <class S>
void ParticleCommands<S>::place_new(ParticleId id, const ParticleDefinition<S>& d, ParticleMaterialId material) {
  if (id.slot == state_.material.size()) {
    state_.position.push_back(Vec3<S>::zero());
    state_.velocity.push_back(Vec3<V>::zero());
    state_.inverse_mass.push_back(InverseMass<S>(0));
    state_.material.push_back(0);
  }
  state_.position.set(id.slot, d.position);
  state_.velocity.set(id.slot, convert<V>(d.velocity));
  state_.inverse_mass[id.slot] = d.pinned ? InverseMass<S>(0) : divide_to<InverseMass<S>>(S(1), d.mass);
  state_.material[id.slot] = material.slot;
  if (d.lifetime == 0) return;
  find_or_insert(state_.lifetimes, ParticleLifetime{state_.tick + d.lifetime, id.slot, 0});
}

template <class S> bool ParticleCommands<S>::execute(const DestroyParticle& command) {
  if (!holds(command.particle)) return faults_.refuse(Fault::stale_id);
  removal_.remove(command.particle);
  return true;
}

template <class S> bool ParticleCommands<S>::execute(const SetParticleMotion<S>& command) {
  if (!holds(command.particle)) return faults_.refuse(Fault::stale_id);
  if (!faults_.accept(detail::fault_of_position(command.position)) ||
      !faults_.accept(detail::fault_of_velocity(command.velocity)))
    return false;
  state_.position.set(command.particle.slot, command.position);
  state_.velocity.set(command.particle.slot, convert<V>(command.velocity));
  return true;
}
template <class S> bool ParticleCommands<S>::execute(const SetParticleMass<S>& command) {
  if (!holds(command.particle)) return faults_.refuse(Fault::stale_id);
  if (!command.pinned && !faults_.accept(detail::fault_of_particle_mass(command.mass))) return false;
  state_.inverse_mass[command.particle.slot] =
      command.pinned ? InverseMass<S>(0) : divide_to<InverseMass<S>>(S(1), command.mass);
  if (command.pinned) {
    const std::uint32_t slot = command.particle.slot;
    std::erase_if(state_.pushes, [slot](const ParticlePush<S>& push) { return push.slot == slot; });
  }
  return true;
}
template <class S> bool ParticleCommands<S>::execute(const SetParticleMaterial& command) {
  if (!holds(command.particle) || !state_.materials.holds(command.material)) return faults_.refuse(Fault::stale_id);
  state_.material[command.particle.slot] = command.material.slot;
  return true;
}

template <class S> bool ParticleCommands<S>::execute(const PushParticle<S>& command) {
  if (!holds(command.particle)) return faults_.refuse(Fault::stale_id);
  if (!is_finite(command.force)) return faults_.refuse(Fault::not_finite);
  const std::uint32_t slot = command.particle.slot;
  const InverseMass<S> w = state_.inverse_mass[slot];
  if (w == InverseMass<S>(0)) return faults_.refuse(Fault::not_dynamic);
  const S most = ParticleLimits<S>::acceleration();
  const auto part = [w](S force) { return saturate_to<S>(product(force, w)); };
  ParticlePush<S>& push = pending_push(slot);
  const Vec3<S> more = {part(command.force.x), part(command.force.y), part(command.force.z)};
  const Vec3<S> asked = saturating_add(push.acceleration, more);
  push.acceleration = held_within(asked, most);
  if (!detail::lies_within(more, most) || !detail::lies_within(asked, most)) push.cut = 1;
  return true;
}
/// Returns the force and impulse that the game asked for on a particle since the last step.
template <class S> ParticlePush<S>& ParticleCommands<S>::pending_push(std::uint32_t slot) {
  return find_or_insert(state_.pushes, ParticlePush<S>{slot, 0, Vec3<S>::zero()});
}
template <class S> bool ParticleCommands<S>::execute(const KickParticle<S>& command) {
  if (!holds(command.particle)) return faults_.refuse(Fault::stale_id);
  if (!is_finite(command.impulse)) return faults_.refuse(Fault::not_finite);
  const std::uint32_t slot = command.particle.slot;
  const InverseMass<S> w = state_.inverse_mass[slot];
  if (w == InverseMass<S>(0)) return faults_.refuse(Fault::not_dynamic);
  const V speed = convert<V>(ParticleLimits<S>::speed());
  const auto part = [w](S impulse) { return saturate_to<V>(product(impulse, w)); };
  const Vec3<V> more = {part(command.impulse.x), part(command.impulse.y), part(command.impulse.z)};
  const Vec3<V> asked = saturating_add(state_.velocity[slot], more);
  state_.velocity.set(slot, held_within(asked, speed));
  if (!detail::lies_within(asked, speed)) pending_push(slot).cut = 1;
  return true;
}
template <class S> bool ParticleCommands<S>::execute(const TouchParticle<S>& command) {
  if (!faults_.accept(detail::fault_of(command.touch))) return false;
  if (!holds(command.touch.particle)) return faults_.refuse(Fault::stale_id);
  state_.touches.push_back(command.touch);
  return true;
}
template <class S> bool ParticleCommands<S>::execute(const SetParticleGravity<S>& command) {
  if (!faults_.accept(detail::fault_of_velocity(command.gravity))) return false;  // as far as speeds go
  state_.settings.gravity = command.gravity;
  return true;
}

// ---- records

template <class S> Fault ParticleCommands<S>::fault_of_ends(ParticleId a, ParticleId b) const {
  return holds(a) && (!b || holds(b)) ? Fault::none : Fault::stale_id;
}
template <class S> Fault ParticleCommands<S>::fault_of_record(const Spring<S>& spring) const {
  const Fault fault = detail::fault_of(spring);
  return fault == Fault::none ? fault_of_ends(spring.a, spring.b) : fault;
}
template <class S> Fault ParticleCommands<S>::fault_of_record(const ParticleForce<S>& force) const {
  const Fault fault = detail::fault_of(force);
  return fault == Fault::none ? fault_of_ends(force.particle, {}) : fault;
}
template <class S> Fault ParticleCommands<S>::fault_of_record(const Cohesion<S>& cohesion) const {
  const Fault fault = detail::fault_of(cohesion);
  return fault != Fault::none || state_.materials.holds(cohesion.material) ? fault : Fault::stale_id;
}
template <class S> Fault ParticleCommands<S>::fault_of_record(const Link<S>& link) const {
  const Fault fault = detail::fault_of(link);
  return fault == Fault::none ? fault_of_ends(link.a, link.b) : fault;
}

template <class S>
template <class Record>
typename detail::RecordId<Record>::Type ParticleCommands<S>::execute(const AddRecord<Record>& command) {
  using IdType = typename detail::RecordId<Record>::Type;
  if (!faults_.accept(fault_of_record(command.record))) return IdType{};
  const IdType id = detail::registry_of(state_, IdType{}).add(command.record);
  if constexpr (std::is_same_v<IdType, LinkId>) {
    if (state_.link_impulses.size() <= id.slot) state_.link_impulses.push_back(V(0));
    state_.link_impulses[id.slot] = V(0);
  }
  return id;
}
template <class S>
template <class Record, class IdType>
bool ParticleCommands<S>::execute(const SetRecord<Record, IdType>& command) {
  auto& registry = detail::registry_of(state_, command.id);
  if (!registry.holds(command.id)) return faults_.refuse(Fault::stale_id);
  if (!faults_.accept(fault_of_record(command.record))) return false;
  if constexpr (std::is_same_v<IdType, LinkId>) {
    const Link<S>& old = *registry.find(command.id);
    const bool same = old.type == command.record.type && old.a == command.record.a && old.b == command.record.b;
    if (!same) state_.link_impulses[command.id.slot] = V(0);  // what it bore says nothing of what it will
  }
  registry.change(command.id) = command.record;
  return true;
}
template <class S> template <class IdType> bool ParticleCommands<S>::execute(const RemoveRecord<IdType>& command) {
  if (!detail::registry_of(state_, command.id).holds(command.id)) return faults_.refuse(Fault::stale_id);
  if constexpr (std::is_same_v<IdType, ParticleMaterialId>) {
    if (is_in_use(command.id)) return faults_.refuse(Fault::shape_in_use);
  }
  removal_.remove_record(command.id);
  return true;
}
/// The first material belongs to the world.
template <class S> bool ParticleCommands<S>::is_in_use(ParticleMaterialId material) const {
  if (material.slot == 0) return true;
  for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
    if (state_.material[slot] == material.slot && state_.particles.is_taken(slot)) return true;
  }
  for (const Cohesion<S>& cohesion : state_.cohesions.all()) {
    if (cohesion.material == material) return true;
  }
  return false;
}

}  // namespace isostep
