// Polyhedra: separating axes and contact polygons of convex solids of flat faces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"

namespace isostep {

/// Finds the contacts of a and b where they are nearer than `margin` [m]. Axes are the faces of both and those crosses
/// of edges whose arcs on the Gauss map meet, since only these can be the best (Gregorius, The separating axis test
/// between convex polyhedra, GDC 2013). Faces go before edges, and a before b, unless the other is better by 1/128 of
/// the smaller inner radius. Solids further apart than the margin along the line between the origins have no contact. A
/// face goes before all others if the vertex below it is nearer to no other face. Faces that look at each other, or
/// that show the depth of the best cross of edges, touch like those of boxes (box_box.hpp).
/// Features: faces: bit 31, bit 30 where b's face is the reference, that face, a vertex twice or both edges of another
/// corner; edges: both.
template <class S>
void collide_polyhedra(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                       S margin, Manifold<S>& out);

template <class S>
using CollidePolyhedra = void (*)(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                  const Transform<S>& tb, S margin, Manifold<S>& out);

/// Collides a polyhedron with a half-space, dot(normal, p) <= offset in tb's frame. Adds up to four vertices within
/// `margin` [m], the lowest among them, of the face that looks down most and of equally flat ones. Vertices of a thin
/// plate above those give no support, though they are near. Features: vertices.
template <class S>
void collide_polyhedron_half_space(const Polyhedron<S>& a, const Transform<S>& ta, Vec3<Unit<S>> normal, S offset,
                                   const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_POLYHEDRA_OF(extern, S)                                                                                  \
  extern template void collide_polyhedra<S>(const Polyhedron<S>&, const Transform<S>&, const Polyhedron<S>&,         \
                                            const Transform<S>&, S, Manifold<S>&);                                   \
  extern template void collide_polyhedron_half_space<S>(const Polyhedron<S>&, const Transform<S>&, Vec3<Unit<S>>, S, \
                                                        const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_POLYHEDRA_OF)

}  // namespace isostep
