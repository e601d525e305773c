// Cylinders and cones on polyhedra thickened by a radius.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/revolved_polyhedron.hpp"
#include "isostep/collision/narrowphase/rounded_polyhedra.hpp"

namespace isostep {

/// Contacts of a solid of revolution with a rounded polyhedron b where they are nearer than `margin` [m]; the normal
/// points to b. As collide_rounded_polyhedra, with the manifold of collide_revolved_polyhedron wherever that reaches as
/// far as the shortest way between the cores. The way is found by GJK against the hull of points of the solid, to which
/// its support along the way found is added until they agree, after 16 rounds at most.
template <class S>
void collide_rounded_revolved(const detail::Revolved<S>& solid, const Transform<S>& ta, const RoundedPolyhedron<S>& b,
                              const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_ROUNDED_REVOLVED_OF(extern, S)                                                          \
  extern template void collide_rounded_revolved<S>(const detail::Revolved<S>&, const Transform<S>&, \
                                                   const RoundedPolyhedron<S>&, const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUNDED_REVOLVED_OF)

}  // namespace isostep
