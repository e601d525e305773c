// Aabb<S>: an axis-aligned box, the broad phase's only shape.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

template <class S> struct Aabb {
  Vec3<S> low, high;  // [m], world frame; low <= high

  static ISO_INLINE constexpr Aabb around(Vec3<S> centre, Vec3<S> half) { return {centre - half, centre + half}; }
  friend ISO_INLINE constexpr bool operator==(const Aabb& a, const Aabb& b) {
    return a.low == b.low && a.high == b.high;
  }

  ISO_FIELDS(low, high)
};

/// Boxes that touch overlap.
template <class S> ISO_INLINE constexpr bool overlap(const Aabb<S>& a, const Aabb<S>& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}
template <class S> ISO_INLINE constexpr bool contains(const Aabb<S>& outer, const Aabb<S>& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         inner.high.x <= outer.high.x && inner.high.y <= outer.high.y && inner.high.z <= outer.high.z;
}
template <class S> ISO_INLINE constexpr Aabb<S> merge(const Aabb<S>& a, const Aabb<S>& b) {
  return {min(a.low, b.low), max(a.high, b.high)};
}
template <class S> ISO_INLINE constexpr Aabb<S> grow(const Aabb<S>& a, S margin) {
  const Vec3<S> m = {margin, margin, margin};
  return {a.low - m, a.high + m};
}
/// Half the surface, dx dy + dy dz + dz dx [m^2], as an exact sum: the tree's cost, which only ever is compared.
template <class S> ISO_INLINE constexpr Sum<S> half_area(const Aabb<S>& a) {
  const Vec3<S> d = a.high - a.low;
  return product(d.x, d.y) + product(d.y, d.z) + product(d.z, d.x);
}

}  // namespace isostep
