// overlaps: the narrow phase asked for nothing but its sign.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"

namespace isostep {

/// Returns true if the primitives share a point. Touching counts. Two half-spaces never overlap here: they never
/// collide.
template <class S>
ISO_INLINE bool overlaps(std::type_identity_t<ShapeView<S>> a, const Transform<S>& ta,
                         std::type_identity_t<ShapeView<S>> b, const Transform<S>& tb) {
  Manifold<S> manifold;
  collide<S>(a, ta, b, tb, S(0), manifold);
  for (int i = 0; i < static_cast<int>(manifold.count); ++i) {
    if (manifold.points[i].separation <= S(0)) return true;
  }
  return false;
}

}  // namespace isostep
