// The point of a surface that is closest to a given one, and how a thickened core has it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/transform.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S> struct ClosestPoint {
  Vec3<S> point;         // [m] on the surface, world frame
  S distance;            // [m] negative inside
  Vec3<Unit<S>> normal;  // [1] outward at `point`, world frame: the query is point + distance normal
};

namespace detail {
/// [m] The gap between cores up to which its direction is rounding alone, where shapes are `extent` [m] apart or long.
template <class S> ISO_INLINE constexpr S gap_noise(S extent) {
  return extent * resolution<Unit<S>>() * S(8) + resolution<S>() * S(16);
}

/// Finds the closest point of a core box thickened by a radius, in its own frame; the core of a sphere is a point, of a
/// capsule a segment.
template <class S> ISO_INLINE ClosestPoint<S> closest_on_core(Vec3<S> half, S radius, Vec3<S> q) {
  using U = Unit<S>;
  Vec3<S> core = max(min(q, half), -half);
  const Vec3<S> out = q - core;
  const Direction<S> d = direction_of(out.x, out.y, out.z);
  if (d.length > S(0)) {
    const Vec3<U> n = {d.x, d.y, d.z};
    return {core + n * radius, d.length - radius, n};
  }
  const Vec3<S> depth = half - abs(q);
  int axis = 0;
  if (depth.y < depth[axis]) axis = 1;
  if (depth.z < depth[axis]) axis = 2;
  const bool negative = q[axis] < S(0);
  core[axis] = negative ? -half[axis] - radius : half[axis] + radius;
  Vec3<U> n = Vec3<U>::zero();
  n[axis] = negative ? U(-1) : U(1);
  return {core, -depth[axis] - radius, n};
}
template <class S>
ISO_INLINE ClosestPoint<S> closest_on_core(Vec3<S> half, S radius, const Transform<S>& t, Vec3<S> query) {
  const ClosestPoint<S> local = closest_on_core(half, radius, to_local(t, query));
  return {to_world(t, local.point), local.distance, t.rotation * local.normal};
}
}  // namespace detail

}  // namespace isostep
