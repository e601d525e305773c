// Contacts of a sphere, a box and a capsule with a half-space: their lowest points against its plane.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// b is the half-space in all three.
template <class S>
void collide_sphere_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out);
/// Adds the vertices of the face that looks most at the plane. Vertices above that face give no support,
/// however thin the box is. Feature: bit k set where the vertex lies on the positive side of the box's axis
/// k.
template <class S>
void collide_box_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                            const Transform<S>& tb, S margin, Manifold<S>& out);
/// Adds both ends, as far as they belong to the patch. Feature: 0 the negative end, 1 the positive one.
template <class S>
void collide_capsule_half_space(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                                const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_HALF_SPACE_PAIRS_OF(extern, S)                                                                          \
  extern template void collide_sphere_half_space<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&,  \
                                                    const Transform<S>&, S, Manifold<S>&);                          \
  extern template void collide_box_half_space<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&,     \
                                                 const Transform<S>&, S, Manifold<S>&);                             \
  extern template void collide_capsule_half_space<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, \
                                                     const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HALF_SPACE_PAIRS_OF)

}  // namespace isostep
