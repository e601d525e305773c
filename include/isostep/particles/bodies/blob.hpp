// Blob: a handful of particles that hold together by pulling at each other from a little apart.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/particle_body.hpp"

namespace isostep {

/// The defaults are the book's. Stable while repel_force h^2 / (mass repel_distance), and likewise of the attraction
/// over its range, stays well below 1 a neighbour: here 6e-4 and 9e-4 at 60 Hz and four sub-steps.
/// Source:  Millington, ch. 8.3; numbers of its blob demo.
template <class S> struct BlobDefinition {
  Vec3<S> centre = {S(0), S(2), S(0)};  // [m]
  std::uint32_t particles = 5;
  bool flat = false;   // in the plane of x and y
  S spacing = S(0.5);  // [m] of the lattice that they begin on
  S mass = S(1);       // [kg] of a particle
  ParticleMaterial<S> material = {.damping = S(0.2), .radius = S(0.4)};
  S repel_distance = S(0.3);  // [m] these as in Cohesion
  S repel_force = S(10);      // [N]
  S attract_start = S(0.6);   // [m]
  S attract_end = S(1);       // [m]
  S attract_force = S(20);    // [N]
};

/// Makes a material and a cohesion of the blob's own, and particles that fill the smallest square or cube of a lattice:
/// along x, then y, then z.
template <class S> ParticleBody build(ParticleWorld<S>& world, const BlobDefinition<S>& definition);

#define ISO_BLOB_OF(extern, S) extern template ParticleBody build<S>(ParticleWorld<S>&, const BlobDefinition<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BLOB_OF)

}  // namespace isostep
