// Spheres and capsules on a triangle of a surface: a thick point or segment against its closest feature.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// Collides a sphere of `radius` [m] about ta's position, nearer to the triangle than `margin` [m]. The normal points
/// into the surface. A sphere that touches an edge or a point from beyond its arc touches a neighbour: that one makes
/// the contact.
/// Features: one, of the sphere alone.
template <class S>
void collide_sphere_triangle(S radius, const Transform<S>& ta, const SurfaceFrame<S>& frame, const BakedTriangle& baked,
                             S margin, Manifold<S>& out);

/// Collides a capsule along y of ta: its ends over the triangle, and the points where its core leaves it across an edge
/// that is not flat; or one point of an edge, or two if the core lies along it.
/// Features: an end, of the capsule alone; bit 27, the edge, the end; bit 26, the edge; bit 25, the edge, the end.
template <class S>
void collide_capsule_triangle(S half_height, S radius, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                              const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_ROUND_TRIANGLE_OF(extern, S)                                                              \
  extern template void collide_sphere_triangle<S>(S, const Transform<S>&, const SurfaceFrame<S>&,     \
                                                  const BakedTriangle&, S, Manifold<S>&);             \
  extern template void collide_capsule_triangle<S>(S, S, const Transform<S>&, const SurfaceFrame<S>&, \
                                                   const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUND_TRIANGLE_OF)

}  // namespace isostep
