// Cylinders and cones on a triangle of a surface.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// Contacts of a solid of revolution with one triangle where they are nearer than `margin` [m]; the normal points into
/// the surface. Axes as in revolved_polyhedron.hpp; edges and points of the triangle count only where the surface can
/// be touched from there, so that none is found on a flat surface.
/// Features: a point of the solid over the triangle has none of the triangle's. Of others bit 31: where edges cut it
/// off; bit 30: the kind of axis, the triangle's edge or point.
template <class S>
void collide_revolved_triangle(const detail::Revolved<S>& solid, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                               const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_REVOLVED_TRIANGLE_OF(extern, S)                                                          \
  extern template void collide_revolved_triangle<S>(const detail::Revolved<S>&, const Transform<S>&, \
                                                    const SurfaceFrame<S>&, const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_REVOLVED_TRIANGLE_OF)

}  // namespace isostep
