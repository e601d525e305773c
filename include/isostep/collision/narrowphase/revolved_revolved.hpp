// Cylinders and cones on each other, and capsules on them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// Contacts of two solids of revolution where they are nearer than `margin` [m]; the normal points from a to b.
/// Axes:  the discs of both, the sides of both across each other and towards the other's middle and apex; and of a rim
///        against the other the tangent at its lowest point, which follows in a few steps what is nearest of the other.
///        Along any of them both reach exactly as far as they do.
/// Error: of the separation, where rims are what touches: below the true one by less than 1/1000 of the smaller size
///        while it overlaps less than a tenth of that; measured in the tests.
template <class S>
void collide_revolved_revolved(const detail::Revolved<S>& a, const Transform<S>& ta, const detail::Revolved<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out);

/// A capsule a along y of ta: where its core is nearest to the solid; both ends of the core where it lies along a disc
/// or the side. The normal points to the solid.
/// Error: the separation is exact unless the core itself is in the solid; then its deepest point decides, and what it
///        takes to push out a core that passes through may be more.
template <class S>
void collide_capsule_revolved(S half_height, S radius, const Transform<S>& ta, const detail::Revolved<S>& b,
                              const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_REVOLVED_REVOLVED_OF(extern, S)                                                                            \
  extern template void collide_revolved_revolved<S>(const detail::Revolved<S>&, const Transform<S>&,                   \
                                                    const detail::Revolved<S>&, const Transform<S>&, S, Manifold<S>&); \
  extern template void collide_capsule_revolved<S>(S, S, const Transform<S>&, const detail::Revolved<S>&,              \
                                                   const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_REVOLVED_REVOLVED_OF)

}  // namespace isostep
