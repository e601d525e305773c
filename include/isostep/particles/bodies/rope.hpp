// Rope: particles in a row, each tied to the next by a cable or a rod.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

/// Links are hard constraints, so that a rope is stable at any mass and rate.
template <class S> struct RopeDefinition {
  Vec3<S> start = {S(0), S(0), S(0)}, end = {S(4), S(0), S(0)};  // [m] places of the first and the last particle
  std::uint32_t particles = 17;                                  // at least 2
  S length = S(0);                  // [m] along the rope; 0: taut, the distance of its ends
  S mass = S(1);                    // [kg] of the whole
  LinkType type = LinkType::cable;  // rods longer than the particles' distance begin with an error
  S restitution = S(0);             // [1] of cables
  bool pin_start = true, pin_end = false;
  ParticleMaterialId material = {};  // null: the default material
};

/// Particles from start to end, evenly on the straight line; link i joins particles i and i + 1.
template <class S> ParticleBody build(ParticleWorld<S>& world, const RopeDefinition<S>& definition);

#define ISO_ROPE_OF(extern, S) extern template ParticleBody build<S>(ParticleWorld<S>&, const RopeDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROPE_OF)

}  // namespace isostep
