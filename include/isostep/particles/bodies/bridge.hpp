// Bridge: two rows of particles that hang by cables from fixed points, tied along by cables and across by rods.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

/// The defaults are the book's rope bridge. All that holds it is hard, so that it is stable at any mass and rate.
/// Source:  Millington, ch. 8.3; numbers of its bridge demo.
template <class S> struct BridgeDefinition {
  Vec3<S> centre = {S(0), S(4), S(0)};  // [m] of the deck, which runs along x
  std::uint32_t columns = 6;            // pairs of particles, at least 2
  S spacing = S(2), width = S(2);       // [m] along and across
  S mass = S(1);                        // [kg] of a particle
  S deck_length = S(1.9);               // [m] of the cables along: less than the spacing pulls the deck tight
  S deck_restitution = S(0.3);          // [1]
  S support_height = S(2);              // [m] of the fixed points above the deck
  S support_spacing = S(2.2), support_width = S(1.6);  // [m] between the fixed points
  S support_length = S(3);                             // [m] of the outermost support cables
  S support_growth = S(0.5);                           // [m] that each pair further in has more
  S support_restitution = S(0.5);                      // [1]
  ParticleMaterialId material = {};                    // null: the default material
};

/// Particle 2 c + r is the one of column c, from -x to +x, and row r, from -z to +z. Links: 2 (columns - 1) deck cables
/// from particle i to i + 2, then a support cable for each particle, then a rod across each column.
template <class S> ParticleBody build(ParticleWorld<S>& world, const BridgeDefinition<S>& definition);

#define ISO_BRIDGE_OF(extern, S) extern template ParticleBody build<S>(ParticleWorld<S>&, const BridgeDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BRIDGE_OF)

}  // namespace isostep
