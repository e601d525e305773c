// Any solid on a triangle of a surface.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Finds the contacts of a solid with one triangle where they are nearer than `margin` [m]. The normal points into the
/// surface. The triangle's plane decides if the solid's lowest point is over it. Else the axis does that SolidGap finds
/// from there, if it is the triangle's own: edges and points of the triangle count only if the surface can be touched
/// from there, so that a flat surface has no such contacts.
/// Features: a point of the solid over the triangle has a name of the solid alone. Others have bit 31 if edges cut them
///           off, or if a flat face of the solid is over an edge; else the names of solids.
template <class S>
void collide_solid_triangle(ShapeView<S> a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                            const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_SOLID_TRIANGLE_OF(extern, S)                                                                    \
  extern template void collide_solid_triangle<S>(ShapeView<S>, const Transform<S>&, const SurfaceFrame<S>&, \
                                                 const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SOLID_TRIANGLE_OF)

}  // namespace isostep
