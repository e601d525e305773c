// ParticleCommands: what each command does to a particle world's state, and what it refuses.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/particles/checks.hpp"
#include "isostep/particles/particle_command.hpp"
#include "isostep/particles/removal.hpp"

namespace isostep {

/// WorldDesk::run calls `execute`, which returns what the command made or whether it was accepted. What is refused
/// changes nothing and leaves its fault in the log.
template <class S> class ParticleCommands {
 public:
  using EveryCommand = EveryParticleCommand<S>;

  ISO_INLINE ParticleCommands(ParticleState<S>& state, FaultLog& faults, ParticleRemoval<S>& removal)
      : state_(state), faults_(faults), removal_(removal) {}

#define ISO_EXECUTE(name, Type, Result, S) Result execute(const Type& command);
  ISO_FOR_EACH_PARTICLE_COMMAND(ISO_EXECUTE, ISO_SKIP, S)
#undef ISO_EXECUTE
  template <class Record> typename detail::RecordId<Record>::Type execute(const AddRecord<Record>& command);
  template <class Record, class IdType> bool execute(const SetRecord<Record, IdType>& command);
  template <class IdType> bool execute(const RemoveRecord<IdType>& command);

 private:
  using V = Velocity<S>;

  ISO_INLINE bool holds(ParticleId particle) const { return state_.particles.holds(particle); }
  Fault fault_of_ends(ParticleId a, ParticleId b) const;
  Fault fault_of_record(const ParticleMaterial<S>& material) const { return detail::fault_of(material); }
  Fault fault_of_record(const Spring<S>& spring) const;
  Fault fault_of_record(const ParticleForce<S>& force) const;
  Fault fault_of_record(const Cohesion<S>& cohesion) const;
  Fault fault_of_record(const Link<S>& link) const;
  Fault fault_of_record(const Collider<S>& collider) const { return detail::fault_of(collider); }
  bool is_in_use(ParticleMaterialId material) const;
  void place_new(ParticleId id, const ParticleDefinition<S>& definition, ParticleMaterialId material);
  ParticlePush<S>& pending_push(std::uint32_t slot);

  ParticleState<S>& state_;
  FaultLog& faults_;
  ParticleRemoval<S>& removal_;
};

}  // namespace isostep
