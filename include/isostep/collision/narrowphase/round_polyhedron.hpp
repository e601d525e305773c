// Spheres and capsules on polyhedra: a thick point or segment against one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"

namespace isostep {

/// Collides a sphere of `radius` [m] about ta's position: one point, named by NearestPoint::feature.
template <class S>
void collide_sphere_polyhedron(S radius, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                               S margin, Manifold<S>& out);

/// Collides a capsule along y of ta: one point, or two if it lies along a face or an edge. Features: bit 31, the
/// face, the edge that cuts the core there or 255, the end; bit 30 or 28, the face, the end; bit 29, the edge, the end;
/// or an edge.
template <class S>
void collide_capsule_polyhedron(S half_height, S radius, const Transform<S>& ta, const Polyhedron<S>& b,
                                const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_ROUND_POLYHEDRON_OF(extern, S)                                                                             \
  extern template void collide_sphere_polyhedron<S>(S, const Transform<S>&, const Polyhedron<S>&, const Transform<S>&, \
                                                    S, Manifold<S>&);                                                  \
  extern template void collide_capsule_polyhedron<S>(S, S, const Transform<S>&, const Polyhedron<S>&,                  \
                                                     const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUND_POLYHEDRON_OF)

}  // namespace isostep
