// Everything that shapes a particle world's future, in flat arrays: what is saved, hashed, written and compared.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/registry.hpp"
#include "isostep/particles/axes.hpp"
#include "isostep/particles/cohesion.hpp"
#include "isostep/particles/collider.hpp"
#include "isostep/particles/force.hpp"
#include "isostep/particles/link.hpp"
#include "isostep/particles/settings.hpp"
#include "isostep/particles/spring.hpp"
#include "isostep/particles/touch.hpp"

namespace isostep {

/// This bit stands in the first word of a portable particle world, beside the scalar's id; a rigid world's has not got
/// it.
inline constexpr std::uint32_t kParticleWorldBit = 0x80000000u;

/// The impulses of a contact, kept from step to step. Ascending by (a, b).
template <class S> struct ParticleContact {
  static constexpr std::uint32_t kCollider = 0x80000000u;  // in b: the rest is a collider's slot, not a particle's

  std::uint32_t a, b;                  // slots, a < b
  Velocity<S> impulse;                 // [m/s] along the normal
  Vec3<Velocity<S>> friction_impulse;  // [m/s] across it

  ISO_INLINE std::uint64_t key() const { return std::uint64_t{a} << 32 | b; }
  /// Returns true if b is a collider, not a particle. other_slot() is its slot.
  ISO_INLINE bool with_collider() const { return (b & kCollider) != 0; }
  ISO_INLINE std::uint32_t other_slot() const { return b & ~kCollider; }
  ISO_FIELDS(a, b, impulse, friction_impulse)
};
static_assert(kHasNoPadding<ParticleContact<float>> && kHasNoPadding<ParticleContact<double>>);

/// Forces asked for since the last step, as acceleration. Ascending by slot, one a particle.
template <class S> struct ParticlePush {
  std::uint32_t slot;
  std::uint32_t cut;     // 1: what was asked for went beyond ParticleLimits<S>
  Vec3<S> acceleration;  // [m/s^2]

  ISO_FIELDS(slot, cut, acceleration)
};
static_assert(kHasNoPadding<ParticlePush<float>> && kHasNoPadding<ParticlePush<double>>);

/// The tick at which a particle expires. Ascending by slot; those that live for ever have none.
struct ParticleLifetime {
  std::uint64_t last_tick;  // the particle is gone after this step
  std::uint32_t slot;
  std::uint32_t reserved;  // 0

  ISO_FIELDS(last_tick, slot, reserved)
};
static_assert(kHasNoPadding<ParticleLifetime>);

template <class S> struct ParticleState {
  ParticleSettings<S> settings;
  std::uint64_t tick = 0;  // steps taken
  // Particles by slot. A free slot has no inverse mass and no velocity, and lies at the origin.
  SlotMap particles;
  Axes<S> position;                          // [m]
  Axes<Velocity<S>> velocity;                // [m/s]
  std::vector<InverseMass<S>> inverse_mass;  // [1/kg] 0: pinned
  std::vector<std::uint32_t> material;       // slot
  // Commands alone change these, but for springs that yield.
  Registry<ParticleMaterial<S>, ParticleMaterialId> materials;
  Registry<Spring<S>, SpringId> springs;
  Registry<ParticleForce<S>, ForceId> forces;
  Registry<Cohesion<S>, CohesionId> cohesions;
  Registry<Link<S>, LinkId> links;
  Registry<Collider<S>, ColliderId> colliders;
  std::vector<Velocity<S>> link_impulses;  // [m/s] by slot of links
  std::vector<ParticleContact<S>> contacts;
  std::vector<ParticlePush<S>> pushes;
  std::vector<ParticleTouch<S>> touches;  // in the order in which they came
  std::vector<ParticleLifetime> lifetimes;

  /// The material that the world has from the beginning. A null id names it.
  ISO_INLINE ParticleMaterialId first_material() const {
    return materials.slot_map().template id_of<ParticleMaterialId>(0);
  }

  /// Calls visit("name", registry) in a fixed order.
  template <class Visitor, class Self> static ISO_INLINE void registries(Visitor&& visit, Self&& self) {
    visit("materials", self.materials);
    visit("springs", self.springs);
    visit("forces", self.forces);
    visit("cohesions", self.cohesions);
    visit("links", self.links);
    visit("colliders", self.colliders);
  }
  /// Visits all of the state, in the order of the hash and of the portable form: see state/members.hpp.
  template <class Visitor, class Self> static ISO_INLINE void members(Visitor&& visit, Self&& self) {
    visit("settings", self.settings);
    visit("tick", self.tick);
    visit("particles", self.particles);
    registries(visit, self);
    visit("position.x", self.position.x);
    visit("position.y", self.position.y);
    visit("position.z", self.position.z);
    visit("velocity.x", self.velocity.x);
    visit("velocity.y", self.velocity.y);
    visit("velocity.z", self.velocity.z);
    visit("inverse_mass", self.inverse_mass);
    visit("material", self.material);
    visit("link_impulses", self.link_impulses);
    visit("contacts", self.contacts);
    visit("pushes", self.pushes);
    visit("touches", self.touches);
    visit("lifetimes", self.lifetimes);
  }
};

}  // namespace isostep
