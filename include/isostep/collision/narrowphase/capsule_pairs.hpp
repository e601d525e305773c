// Contacts of two capsules: two points where they lie side by side, else one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Crossing axes separate along their common perpendicular, coincident axes across themselves.
/// Features: 0 the closest points; 1, 2 an end of a; 3, 4 an end of b.
template <class S>
void collide_capsule_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                             const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_CAPSULE_PAIRS_OF(extern, S)                                                                          \
  extern template void collide_capsule_capsule<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, \
                                                  const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CAPSULE_PAIRS_OF)

}  // namespace isostep
