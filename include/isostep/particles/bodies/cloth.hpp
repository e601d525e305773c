// Cloth: a grid of particles and springs along its threads, across its cells, and over two cells against folding.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

enum class ClothPins : std::uint32_t { none, two_corners, four_corners, edge };  // the first row's corners, or the row

/// Shares of k h^2/m where a stiffness is left to the world (see SpringKind): structural 1/8, shear 1/16, bend 1/32. A
/// particle has four springs of each kind at most, so the bound is 4 (2 + 1) (1/8 + 1/16 + 1/32) = 2.6 of 4.
/// Source:  the three kinds of Provot 1995, Deformation Constraints in a Mass-Spring Model, sec. 2.
template <class S> struct ClothDefinition {
  Vec3<S> corner = {S(-2), S(4), S(0)};   // [m] of the first particle
  Vec3<S> across = {S(4), S(0), S(0)};    // [m] from there to the first row's end
  Vec3<S> down = {S(0), S(-4), S(0)};     // [m] from there to the last row
  std::uint32_t columns = 17, rows = 17;  // particles, at least 2
  S mass = S(17);                         // [kg] of the whole
  ClothPins pins = ClothPins::two_corners;
  SpringKind<S> structural = {}, shear = {}, bend = {};
  ParticleMaterialId material = {};  // null: the default material
};

/// Particle r columns + c is the one of row r, column c. Springs, all at rest as they are made: structural along the
/// rows, then along the columns; shear, two a cell; bend along the rows, then along the columns.
template <class S> ParticleBody build(ParticleWorld<S>& world, const ClothDefinition<S>& definition);

#define ISO_CLOTH_OF(extern, S) extern template ParticleBody build<S>(ParticleWorld<S>&, const ClothDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CLOTH_OF)

}  // namespace isostep
