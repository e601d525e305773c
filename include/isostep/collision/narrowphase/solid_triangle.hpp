// Any solid on a triangle of a surface.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Contacts of a solid with one triangle where they are nearer than `margin` [m]; the normal points into the surface.
/// The triangle's plane decides where the solid's lowest point is over it; else the axis that SolidGap finds from
/// there, if it is the triangle's own: edges and points of the triangle count only where the surface can be touched
/// from there, so that none is found on a flat surface.
/// Features: a point of the solid over the triangle has none of the triangle's. Of others bit 31: where edges cut it
/// off, or a flat face of the solid is over an edge; else as solids have them.
template <class S>
void collide_solid_triangle(ShapeView<S> a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                            const BakedTriangle& baked, S margin, Manifold<S>& out);

#define ISO_SOLID_TRIANGLE_OF(extern, S)                                                                    \
  extern template void collide_solid_triangle<S>(ShapeView<S>, const Transform<S>&, const SurfaceFrame<S>&, \
                                                 const BakedTriangle&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SOLID_TRIANGLE_OF)

}  // namespace isostep
