// Whether two primitives touch: the narrow phase asked for nothing but its sign.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"

namespace isostep {

/// True when the primitives share a point; touching counts. Two half-spaces never overlap here: they never collide.
template <class S>
ISO_INLINE bool overlaps(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb) {
  Manifold<S> manifold;
  collide(a, ta, b, tb, S(0), manifold);
  for (int i = 0; i < static_cast<int>(manifold.count); ++i) {
    if (manifold.points[i].separation <= S(0)) return true;
  }
  return false;
}

}  // namespace isostep
