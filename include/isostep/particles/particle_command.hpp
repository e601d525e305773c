// The closed list of commands: every way in which a game changes a particle world between steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>

#include "isostep/particles/cohesion.hpp"
#include "isostep/particles/collider.hpp"
#include "isostep/particles/force.hpp"
#include "isostep/particles/link.hpp"
#include "isostep/particles/spring.hpp"
#include "isostep/particles/touch.hpp"

namespace isostep {

/// Registers a record: a material, spring, force, cohesion, link or collider.
template <class Record> struct AddRecord {
  Record record;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("record", self.record);
  }
};
template <class Record, class IdType> struct SetRecord {
  IdType id;
  Record record;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("id", self.id);
    visit("record", self.record);
  }
};
template <class IdType> struct RemoveRecord {
  IdType id;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("id", self.id);
  }
};

template <class S> struct CreateParticle {
  ParticleDefinition<S> definition;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("definition", self.definition);
  }
};
struct DestroyParticle {
  ParticleId particle;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
  }
};
/// Teleports.
template <class S> struct SetParticleMotion {
  ParticleId particle;
  Vec3<S> position;  // [m]
  Vec3<S> velocity;  // [m/s]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
    visit("position", self.position);
    visit("velocity", self.velocity);
  }
};
template <class S> struct SetParticleMass {
  ParticleId particle;
  S mass;  // [kg]
  bool pinned;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
    visit("mass", self.mass);
    visit("pinned", self.pinned);
  }
};
struct SetParticleMaterial {
  ParticleId particle;
  ParticleMaterialId material;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
    visit("material", self.material);
  }
};
/// Acts over the next step.
template <class S> struct PushParticle {
  ParticleId particle;
  Vec3<S> force;  // [N]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
    visit("force", self.force);
  }
};
/// Acts at once.
template <class S> struct KickParticle {
  ParticleId particle;
  Vec3<S> impulse;  // [kg m/s]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("particle", self.particle);
    visit("impulse", self.impulse);
  }
};
/// A contact of the next step.
template <class S> struct TouchParticle {
  ParticleTouch<S> touch;
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("touch", self.touch);
  }
};
template <class S> struct SetParticleGravity {
  Vec3<S> gravity;  // [m/s^2]
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("gravity", self.gravity);
  }
};

/// The position in this list is the command's number in replays: append, never reorder.
template <class S>
using ParticleCommand =
    std::variant<CreateParticle<S>, DestroyParticle, SetParticleMotion<S>, SetParticleMass<S>, SetParticleMaterial,
                 PushParticle<S>, KickParticle<S>, TouchParticle<S>, SetParticleGravity<S>,
                 AddRecord<ParticleMaterial<S>>, SetRecord<ParticleMaterial<S>, ParticleMaterialId>,
                 RemoveRecord<ParticleMaterialId>,                                                          //
                 AddRecord<Spring<S>>, SetRecord<Spring<S>, SpringId>, RemoveRecord<SpringId>,              //
                 AddRecord<ParticleForce<S>>, SetRecord<ParticleForce<S>, ForceId>, RemoveRecord<ForceId>,  //
                 AddRecord<Cohesion<S>>, SetRecord<Cohesion<S>, CohesionId>, RemoveRecord<CohesionId>,      //
                 AddRecord<Link<S>>, SetRecord<Link<S>, LinkId>, RemoveRecord<LinkId>,                      //
                 AddRecord<Collider<S>>, SetRecord<Collider<S>, ColliderId>, RemoveRecord<ColliderId>>;

}  // namespace isostep
