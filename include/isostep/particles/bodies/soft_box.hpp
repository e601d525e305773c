// Soft box: a lattice of particles with springs along its edges and across its cells.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

/// Shares of k h^2/m where a stiffness is left to the world (see SpringKind): structural 1/16, face 1/32, space 1/32. A
/// particle has 6, 12 and 8 springs of these kinds at most, so the bound is (2 + 1) (6/16 + 12/32 + 8/32) = 3 of 4.
template <class S> struct SoftBoxDefinition {
  Vec3<S> centre = {S(0), S(2), S(0)};              // [m]
  Vec3<S> size = {S(1), S(1), S(1)};                // [m] its edges
  std::uint32_t columns = 4, rows = 4, layers = 4;  // particles along x, y, z, at least 2
  S mass = S(8);                                    // [kg] of the whole
  SpringKind<S> structural = {}, face = {},
                space = {};          // along the edges of a cell, across its faces, through its middle
  ParticleMaterialId material = {};  // null: the default material
};

/// Particle (l rows + r) columns + c is the one of layer l, row r, column c, each upwards along its axis. Springs, at
/// rest as they are made: those of the first particle to its later neighbours, then of the second, and so on.
template <class S> ParticleBody build(ParticleWorld<S>& world, const SoftBoxDefinition<S>& definition);

#define ISO_SOFT_BOX_OF(extern, S) \
  extern template ParticleBody build<S>(ParticleWorld<S>&, const SoftBoxDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SOFT_BOX_OF)

}  // namespace isostep
