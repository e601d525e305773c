// Particles: their ids, the numbers that particles of one material share, and what one is told at birth.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using ParticleId = Id<struct ParticleTag>;
using ParticleMaterialId = Id<struct ParticleMaterialTag>;

/// Stands where a particle's slot would: the scenery, a fixed point, nobody.
inline constexpr std::uint32_t kNoParticle = 0xffffffffu;

/// 1/m. Fixed point gives it half as many more fraction bits as S has bits: 2^-24 or 2^-48, for masses from
/// ParticleLimits::least_mass up.
template <class S> struct InverseMassOf { using Type = S; };
template <class Rep, int F, Overflow P> struct InverseMassOf<Fixed<Rep, F, P>> {
  using Type = Fixed<Rep, Fixed<Rep, F, P>::kBits * 3 / 4, P>;
};
template <class S> using InverseMass = typename InverseMassOf<S>::Type;

/// The numbers that particles of one kind have in common: a table of these is what keeps a particle small.
template <class S> struct ParticleMaterial {
  S gravity_scale = S(1);   // [1] of the world's gravity
  S damping = S(1);         // [1] share of the velocity that is kept for a second, in 0..1: the book's d
  S linear_drag = S(0);     // [N s/m] k1 of f = -v (k1 + k2 |v|)
  S quadratic_drag = S(0);  // [N s^2/m^2] k2
  S radius = S(0);          // [m] for contacts
  S friction = S(0);        // [1] of two particles the lesser counts
  S restitution = S(0);     // [1] of two particles the greater counts
  bool collides = false;    // with other particles whose material says so too

  ISO_FIELDS(gravity_scale, damping, linear_drag, quadratic_drag, radius, friction, restitution, collides)
};

template <class S> struct ParticleDefinition {
  Vec3<S> position = {S(0), S(0), S(0)};  // [m]
  Vec3<S> velocity = {S(0), S(0), S(0)};  // [m/s]
  S mass = S(1);                          // [kg]
  bool pinned = false;                    // goes on at its velocity, whatever acts on it
  ParticleMaterialId material = {};       // null: the default material
  std::uint32_t lifetime = 0;             // [steps] until it expires; 0: never

  ISO_FIELDS(position, velocity, mass, pinned, material, lifetime)
};

}  // namespace isostep
