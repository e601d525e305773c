// Vectors and rotations of lanes, chosen lane by lane.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/quat.hpp"

namespace isostep {

/// a in the lanes of the mask, b in the others.
template <class Mask, class L> ISO_INLINE Vec3<L> select(Mask mask, Vec3<L> a, Vec3<L> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
template <class Mask, class U> ISO_INLINE Quat<U> select(Mask mask, Quat<U> a, Quat<U> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z), select(mask, a.w, b.w)};
}

}  // namespace isostep
