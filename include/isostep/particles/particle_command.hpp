// The closed list of commands: every way in which a game changes a particle world between steps.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/particles/cohesion.hpp"
#include "isostep/particles/collider.hpp"
#include "isostep/particles/force.hpp"
#include "isostep/particles/link.hpp"
#include "isostep/particles/spring.hpp"
#include "isostep/particles/touch.hpp"
#include "isostep/state/command_log.hpp"
#include "isostep/state/record_commands.hpp"

namespace isostep {

template <class S> struct CreateParticle {
  ParticleDefinition<S> definition;
  ISO_FIELDS(definition)
};
struct DestroyParticle {
  ParticleId particle;
  ISO_FIELDS(particle)
};
/// Teleports.
template <class S> struct SetParticleMotion {
  ParticleId particle;
  Vec3<S> position;  // [m]
  Vec3<S> velocity;  // [m/s]
  ISO_FIELDS(particle, position, velocity)
};
template <class S> struct SetParticleMass {
  ParticleId particle;
  S mass;  // [kg]
  bool pinned;
  ISO_FIELDS(particle, mass, pinned)
};
struct SetParticleMaterial {
  ParticleId particle;
  ParticleMaterialId material;
  ISO_FIELDS(particle, material)
};
/// Acts over the next step.
template <class S> struct PushParticle {
  ParticleId particle;
  Vec3<S> force;  // [N]
  ISO_FIELDS(particle, force)
};
/// Acts at once.
template <class S> struct KickParticle {
  ParticleId particle;
  Vec3<S> impulse;  // [kg m/s]
  ISO_FIELDS(particle, impulse)
};
/// A contact of the next step.
template <class S> struct TouchParticle {
  ParticleTouch<S> touch;
  ISO_FIELDS(touch)
};
template <class S> struct SetParticleGravity {
  Vec3<S> gravity;  // [m/s^2]
  ISO_FIELDS(gravity)
};

/// ISO_FOR_EACH_PARTICLE_COMMAND(X, R, S) expands X(name, Type, Result, S) for a command: its name in faults, record,
/// and what ParticleWorld<S>::apply and ParticleCommands<S>::execute return: an id of what was made, or whether it was
/// accepted. It expands R(name, Record, Id, S) for a kind of record, which has three commands, add_name, set_name and
/// remove_name, and a registry in ParticleState whose name is the same with an s. To add one, see README.md. The
/// position is the number in replays: append, never reorder.
#define ISO_FOR_EACH_PARTICLE_COMMAND(X, R, S)            \
  X(create_particle, CreateParticle<S>, ParticleId, S)    \
  X(destroy_particle, DestroyParticle, bool, S)           \
  X(set_particle_motion, SetParticleMotion<S>, bool, S)   \
  X(set_particle_mass, SetParticleMass<S>, bool, S)       \
  X(set_particle_material, SetParticleMaterial, bool, S)  \
  X(push_particle, PushParticle<S>, bool, S)              \
  X(kick_particle, KickParticle<S>, bool, S)              \
  X(touch_particle, TouchParticle<S>, bool, S)            \
  X(set_particle_gravity, SetParticleGravity<S>, bool, S) \
  R(material, ParticleMaterial<S>, ParticleMaterialId, S) \
  R(spring, Spring<S>, SpringId, S)                       \
  R(force, ParticleForce<S>, ForceId, S)                  \
  R(cohesion, Cohesion<S>, CohesionId, S)                 \
  R(link, Link<S>, LinkId, S)                             \
  R(collider, Collider<S>, ColliderId, S)
/// ISO_SKIP takes the place of one of the two that is not wanted.
#define ISO_SKIP(name, Type, Result, S)

#define ISO_TYPE(name, Type, Result, S) , Type
#define ISO_TYPES(name, Record, Id, S) , AddRecord<Record>, SetRecord<Record, Id>, RemoveRecord<Id>
template <class S>
using EveryParticleCommand = CommandTypes<void ISO_FOR_EACH_PARTICLE_COMMAND(ISO_TYPE, ISO_TYPES, S)>;
#undef ISO_TYPE
#undef ISO_TYPES

namespace detail {
/// The id of a kind of record.
template <class Record> struct RecordId;
#define ISO_RECORD_ID(name, Record, Id, S) \
  template <class S> struct RecordId<Record> { using Type = Id; };
ISO_FOR_EACH_PARTICLE_COMMAND(ISO_SKIP, ISO_RECORD_ID, S)
#undef ISO_RECORD_ID
}  // namespace detail

}  // namespace isostep
