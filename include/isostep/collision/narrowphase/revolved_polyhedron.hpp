// Cylinders and cones on polyhedra and half-spaces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// Contacts of a solid of revolution with a polyhedron b where they are nearer than `margin` [m]; the normal points to
/// b. Axes, all with the solid's exact reach: b's faces, its discs, its side towards b's vertices and across b's edges,
/// and its rims across them (NormalsAcross). Faces go before discs, and these before the rest, unless the other is
/// better by 1/128 of the smaller inner radius.
/// Points: of a disc on a face up to four of sixteen that turn with the rim, else the ends of the side's lowest line.
/// Features: of faces bit 31, b's face, and the solid's own point, or with bit 30 the edges that cut it off; else the
/// kind of axis in bits 28 to 30, and b's edge or vertex and the end, or with bit 27 of two along an edge.
template <class S>
void collide_revolved_polyhedron(const detail::Revolved<S>& solid, const Transform<S>& ta, const Polyhedron<S>& b,
                                 const Transform<S>& tb, S margin, Manifold<S>& out);

/// The same with a half-space, dot(normal, p) <= offset in tb's frame.
template <class S>
void collide_revolved_half_space(const detail::Revolved<S>& solid, const Transform<S>& ta, Vec3<Unit<S>> normal,
                                 S offset, const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_REVOLVED_POLYHEDRON_OF(extern, S)                                                                         \
  extern template void collide_revolved_polyhedron<S>(const detail::Revolved<S>&, const Transform<S>&,                \
                                                      const Polyhedron<S>&, const Transform<S>&, S, Manifold<S>&);    \
  extern template void collide_revolved_half_space<S>(const detail::Revolved<S>&, const Transform<S>&, Vec3<Unit<S>>, \
                                                      S, const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_REVOLVED_POLYHEDRON_OF)

}  // namespace isostep
