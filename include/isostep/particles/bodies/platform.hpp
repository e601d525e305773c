// Platform: six particles, every two of them joined by a rod: a body that turns although nothing in it does.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

/// The book's platform: a foot of two particles under a deck of four. Rods are hard, so that it is stable at any mass
/// and rate.
/// Source:  Millington, ch. 8.3; places of its platform demo.
template <class S> struct PlatformDefinition {
  Vec3<S> foot = {S(0), S(0), S(0)};  // [m] the middle of the foot
  S mass = S(1);                      // [kg] of a particle
  ParticleMaterialId material = {};   // null: the default material
};

/// Particles: the foot's at (0, 0, +-1), the left end's at (-3, 2, +-1), the right end's at (4, 2, +-1) [m], each time
/// +z first. 15 rods: of (i, j), i < j, in lexical order.
template <class S> ParticleBody build(ParticleWorld<S>& world, const PlatformDefinition<S>& definition);

#define ISO_PLATFORM_OF(extern, S) \
  extern template ParticleBody build<S>(ParticleWorld<S>&, const PlatformDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PLATFORM_OF)

}  // namespace isostep
