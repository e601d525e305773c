// Bodies of particle_world.hpp: the facade over ParticleEngine, and the recording of commands.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/particles/commands.inl"
#include "isostep/particles/engine_state.inl"
#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/removal.inl"
#include "isostep/scalar/environment.hpp"
#include "isostep/state/world_base.inl"

namespace isostep {

template <class S> bool ParticleWorld<S>::use_simd(Simd simd) {
  const ExclusiveCall call = engine_->desk_.enter("use_simd");
  if (!call.allowed()) return false;
  const FlightKernels<S>* kernels = flight_kernels<S>(simd);
  if (kernels == nullptr) return false;
  engine_->flight_.use(*kernels);
  return true;
}
template <class S> const char* ParticleWorld<S>::simd_name() const { return engine_->flight_.kernels().name; }

#define ISO_APPLY(name, Type, Result, S)                                   \
  template <class S> Result ParticleWorld<S>::apply(const Type& command) { \
    return engine_->desk_.run(#name, engine_->commands_, command);         \
  }
#define ISO_RECORD(name, Record, Id, S)                                                                          \
  template <class S> Id ParticleWorld<S>::apply(const AddRecord<Record>& command) {                              \
    return engine_->desk_.run("add_" #name, engine_->commands_, command);                                        \
  }                                                                                                              \
  template <class S> bool ParticleWorld<S>::apply(const SetRecord<Record, Id>& command) {                        \
    return engine_->desk_.run("set_" #name, engine_->commands_, command);                                        \
  }                                                                                                              \
  template <class S> bool ParticleWorld<S>::apply(const RemoveRecord<Id>& command) {                             \
    return engine_->desk_.run("remove_" #name, engine_->commands_, command);                                     \
  }                                                                                                              \
  template <class S> Id ParticleWorld<S>::add(const Record& record) { return apply(AddRecord<Record>{record}); } \
  template <class S> bool ParticleWorld<S>::set(Id id, const Record& record) {                                   \
    return apply(SetRecord<Record, Id>{id, record});                                                             \
  }                                                                                                              \
  template <class S> bool ParticleWorld<S>::remove(Id id) { return apply(RemoveRecord<Id>{id}); }                \
  template <class S> const Record* ParticleWorld<S>::find(Id id) const {                                         \
    return detail::registry_of(engine_->state_, id).find(id);                                                    \
  }
ISO_FOR_EACH_PARTICLE_COMMAND(ISO_APPLY, ISO_RECORD, S)
#undef ISO_APPLY
#undef ISO_RECORD

template <class S> ParticleMaterialId ParticleWorld<S>::default_material() const {
  return engine_->state_.first_material();
}
template <class S> ParticleId ParticleWorld<S>::create(const ParticleDefinition<S>& definition) {
  return apply(CreateParticle<S>{definition});
}
template <class S> bool ParticleWorld<S>::destroy(ParticleId particle) { return apply(DestroyParticle{particle}); }
template <class S> bool ParticleWorld<S>::place(ParticleId particle, Vec3<S> position, Vec3<S> velocity) {
  return apply(SetParticleMotion<S>{particle, position, velocity});
}
template <class S> bool ParticleWorld<S>::set_mass(ParticleId particle, S mass, bool pinned) {
  return apply(SetParticleMass<S>{particle, mass, pinned});
}
template <class S> bool ParticleWorld<S>::set_material(ParticleId particle, ParticleMaterialId material) {
  return apply(SetParticleMaterial{particle, material});
}
template <class S> bool ParticleWorld<S>::set_gravity(Vec3<S> gravity) { return apply(SetParticleGravity<S>{gravity}); }
template <class S> bool ParticleWorld<S>::apply_force(ParticleId particle, Vec3<S> force) {
  return apply(PushParticle<S>{particle, force});
}
template <class S> bool ParticleWorld<S>::apply_impulse(ParticleId particle, Vec3<S> impulse) {
  return apply(KickParticle<S>{particle, impulse});
}
template <class S> bool ParticleWorld<S>::touch(const ParticleTouch<S>& touch) {
  return apply(TouchParticle<S>{touch});
}

template <class S> bool ParticleWorld<S>::contains(ParticleId particle) const {
  return engine_->state_.particles.holds(particle);
}
template <class S> Vec3<S> ParticleWorld<S>::position(ParticleId particle) const {
  return contains(particle) ? engine_->state_.position[particle.slot] : Vec3<S>::zero();
}
template <class S> Vec3<S> ParticleWorld<S>::velocity(ParticleId particle) const {
  return contains(particle) ? convert<S>(engine_->state_.velocity[particle.slot]) : Vec3<S>::zero();
}
template <class S> S ParticleWorld<S>::mass(ParticleId particle) const {
  return pin_floats([&] {
    const InverseMass<S> w = contains(particle) ? engine_->state_.inverse_mass[particle.slot] : InverseMass<S>(0);
    return InverseMass<S>(0) < w ? divide_to<S>(S(1), w) : S(0);
  });
}
template <class S> ParticleMaterialId ParticleWorld<S>::material(ParticleId particle) const {
  if (!contains(particle)) return {};
  return engine_->state_.materials.slot_map().template id_of<ParticleMaterialId>(
      engine_->state_.material[particle.slot]);
}
template <class S> std::vector<ParticleId> ParticleWorld<S>::particles() const {
  return engine_->state_.particles.template ids<ParticleId>();
}
template <class S> ParticleCounts ParticleWorld<S>::counts() const {
  const ParticleState<S>& state = engine_->state_;
  ParticleCounts counts = {};
  counts.particles = state.particles.count_taken();
  for (std::uint32_t slot = 0; slot < state.material.size(); ++slot) {
    counts.pinned += state.particles.is_taken(slot) && state.inverse_mass[slot] == InverseMass<S>(0) ? 1u : 0u;
  }
  counts.springs = state.springs.slot_map().count_taken();
  counts.forces = state.forces.slot_map().count_taken() + state.cohesions.slot_map().count_taken();
  counts.links = state.links.slot_map().count_taken();
  counts.colliders = state.colliders.slot_map().count_taken();
  counts.contacts = static_cast<std::uint32_t>(state.contacts.size());
  return counts;
}

template <class S> ParticleReport ParticleWorld<S>::step(const ParticleStageObserver& observer) {
  const ExclusiveCall call = engine_->desk_.enter("step");
  if (!call.allowed()) return {};
  engine_->desk_.journal.record_step();
  return pin_floats([&] { return engine_->step(observer); });
}
template <class S> const ParticleEvents<S>& ParticleWorld<S>::events() const { return engine_->step_.events; }

}  // namespace isostep

/// ParticleWorld<S>, and the systems that work between its steps (those of a step: engine_step.inl). What each command
/// does: a command of the list without `execute` does not compile.
#define ISO_INSTANTIATE_PARTICLE_EXECUTE(name, Type, Result, S) \
  template Result ParticleCommands<S>::execute(const Type&);
#define ISO_INSTANTIATE_PARTICLE_RECORD(name, Record, Id, S)                \
  template Id ParticleCommands<S>::execute(const AddRecord<Record>&);       \
  template bool ParticleCommands<S>::execute(const SetRecord<Record, Id>&); \
  template bool ParticleCommands<S>::execute(const RemoveRecord<Id>&);
#define ISO_INSTANTIATE_PARTICLE_WORLD(S)                                                             \
  ISO_PARTICLE_REMOVAL_OF(, S)                                                                        \
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_INSTANTIATE_PARTICLE_EXECUTE, ISO_INSTANTIATE_PARTICLE_RECORD, S) \
  template std::uint64_t ParticleEngine<S>::hash() const;                                             \
  ISO_PARTICLE_WORLD_OF(, S)
