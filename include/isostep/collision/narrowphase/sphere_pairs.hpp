// Contacts of a sphere with a sphere, a box and a capsule: always one point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Coincident centres give the normal (0, 1, 0).
template <class S>
void collide_sphere_sphere(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                           S margin, Manifold<S>& out);
/// A centre inside the box leaves by the nearest face. Ties go to the lowest axis, and its positive side.
template <class S>
void collide_sphere_box(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                        S margin, Manifold<S>& out);
/// A centre on the capsule's axis leaves at a right angle to it.
template <class S>
void collide_sphere_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                            const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_SPHERE_PAIRS_OF(extern, S)                                                                          \
  extern template void collide_sphere_sphere<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&,  \
                                                const Transform<S>&, S, Manifold<S>&);                          \
  extern template void collide_sphere_box<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&,     \
                                             const Transform<S>&, S, Manifold<S>&);                             \
  extern template void collide_sphere_capsule<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, \
                                                 const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SPHERE_PAIRS_OF)

}  // namespace isostep
