// Boxes and hulls on a triangle of a surface: separating axes within the arcs of its edges, and contact polygons.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"

namespace isostep {

/// Finds the contacts of a polyhedron with a triangle of a surface, where they are nearer than `margin` [m]. The normal
/// points into the surface.
/// Axes:     the triangle's normal; faces of the polyhedron that look into the surface where the triangle's edges and
///           points can be touched; crosses of edges whose arcs meet; the normals of neighbours that go down: if one of
///           those is best, the contact is the neighbour's. Flat and concave edges give no axis, so inside a plane only
///           its own normal exists, without a look at the neighbours' contacts.
/// Points:   on the triangle's plane, the corners of the polyhedron's face over it, and the points where that face
///           leaves it across an edge that is not flat. Points beyond a flat edge belong to the neighbour.
/// Features: a vertex, of the polyhedron alone; bit 31, its face, both edges of a corner, 128 + an edge of the
///           triangle; the same with bit 30 where its face is the reference and 128 + an edge its own; bit 29, edges.
template <class S>
void collide_polyhedron_triangle(const Polyhedron<S>& a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                                 const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_POLYHEDRON_TRIANGLE_OF(extern, S)                                                    \
  extern template void collide_polyhedron_triangle<S>(const Polyhedron<S>&, const Transform<S>&, \
                                                      const SurfaceFrame<S>&, const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_POLYHEDRON_TRIANGLE_OF)

}  // namespace isostep
