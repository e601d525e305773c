// Contacts of a box with a capsule: two points where the capsule lies along a face or an edge, else one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// a is the box. A core that pierces it leaves by the face, or across the edge, of least depth.
/// Features: 0 the closest points; else 1 + 16 (region of the box in base 3, a digit for each axis: negative side,
/// inside, positive side) + the end of the stretch, 0 or 1.
template <class S>
void collide_box_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                         S margin, Manifold<S>& out);

#define ISO_BOX_CAPSULE_OF(extern, S)                                                                        \
  extern template void collide_box_capsule<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, \
                                              const Transform<S>&, S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BOX_CAPSULE_OF)

}  // namespace isostep
