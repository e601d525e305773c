// Polyhedra thickened by a radius, against each other and triangles of surfaces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/geometry/shapes/hull.hpp"

namespace isostep {

/// A polyhedron with a radius: all points within `radius` of a core.
template <class S> struct RoundedPolyhedron {
  Polyhedron<S> core;
  S radius;  // [m] 0 or more, of two together more
};
template <class S> ISO_INLINE RoundedPolyhedron<S> rounded_of(const Hull<S>& hull) {
  return {hull.polyhedron(), hull.radius};
}

/// Finds the contacts of a and b where they are nearer than `margin` [m].
/// Normal:   of cores that overlap, the best of their separating axes, as in collide_polyhedra; of others, along the
///           shortest way between them, by GJK. The normal of a face replaces it if that comes as near to it as an axis
///           may to the best one, 1/128 of the smaller inner radius.
/// Points:   a face's contact polygon; two where edges lie beside each other; else one.
/// Features: those of the cores' manifold; bit 28, both edges, the end; bit 27 alone of a single point.
/// `polyhedra`: see collide(). It collides the cores.
template <class S>
void collide_rounded_polyhedra(const RoundedPolyhedron<S>& a, const Transform<S>& ta, const RoundedPolyhedron<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out, CollidePolyhedra<S> polyhedra);

/// Collides with one triangle of a surface. The normal points into the surface. The shortest way of a core that is
/// apart from it counts if it leads out of the surface there. Otherwise the contact is a neighbour's, as for a sphere.
template <class S>
void collide_rounded_triangle(const RoundedPolyhedron<S>& a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                              const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_ROUNDED_POLYHEDRA_OF(extern, S)                                                                            \
  extern template void collide_rounded_polyhedra<S>(const RoundedPolyhedron<S>&, const Transform<S>&,                  \
                                                    const RoundedPolyhedron<S>&, const Transform<S>&, S, Manifold<S>&, \
                                                    CollidePolyhedra<S>);                                              \
  extern template void collide_rounded_triangle<S>(const RoundedPolyhedron<S>&, const Transform<S>&,                   \
                                                   const SurfaceFrame<S>&, const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUNDED_POLYHEDRA_OF)

}  // namespace isostep
