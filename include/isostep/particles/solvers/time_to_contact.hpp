// The time at which two sides of a contact that move in straight lines touch, as a share of the way.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/collider.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {

/// Returns the time at which a point that moves from p by `way` comes within `radius` of the origin, as a share of the
/// way; 1 for never. Lengths are measured along and across the way, so no square overflows.
template <class S> ISO_INLINE Unit<S> time_to_sphere(Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const Heading<S> along = heading_of(way);
  const Vec3<U> u = along.direction;
  const S ahead = -dot(p, u);  // to the nearest point
  if (along.length == S(0) || ahead <= S(0)) return U(1);
  const Vec3<S> off = p + u * ahead;
  const S miss = length(off);
  if (!(miss < radius)) return U(1);
  const S before = ahead - sqrt(radius - miss) * sqrt(radius + miss);
  if (before <= S(0)) return U(0);
  return before < along.length ? divide_to<U>(before, along.length) : U(1);
}
template <class S> ISO_INLINE Unit<S> time_to_plane(const Collider<S>& plane, Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const S gap = dot(p, plane.normal) - plane.offset - radius, closing = -dot(way, plane.normal);
  if (!(gap < closing)) return U(1);
  return S(0) < gap ? divide_to<U>(gap, closing) : U(0);
}
/// Treats a line as a cylinder between two spheres.
template <class S> ISO_INLINE Unit<S> time_to_line(const Collider<S>& line, Vec3<S> p, Vec3<S> way, S radius) {
  using U = Unit<S>;
  const S reach = line.radius + radius;
  U first = min(time_to_sphere(p - line.start, way, reach), time_to_sphere(p - line.end, way, reach));
  const Vec3<S> span = line.end - line.start;
  const Heading<S> axis = heading_of(span);
  const Vec3<U> u = axis.direction;
  const Vec3<S> d = p - line.start;
  const S at = dot(d, u), goes = dot(way, u);
  const U when = time_to_sphere(d - u * at, way - u * goes, reach);
  const S there = at + goes * when;
  return S(0) <= there && there <= axis.length ? min(first, when) : first;
}

/// Returns the share of the way after which a point that moves from p by `way` comes within `radius` of scenery.
template <class S> ISO_INLINE Unit<S> time_to_scenery(const Collider<S>& collider, Vec3<S> p, Vec3<S> way, S radius) {
  return collider.type == ColliderType::plane ? time_to_plane(collider, p, way, radius)
                                              : time_to_line(collider, p, way, radius);
}

}  // namespace isostep::detail
