// The distance of a point from scenery, and its direction.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/collider.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S> struct SceneryDistance {
  S distance;            // [m] below 0: inside
  Vec3<Unit<S>> normal;  // [1] out of the scenery
};

/// Returns the distance of a point. For points on the axis of a line the outward direction is up.
template <class S> ISO_INLINE SceneryDistance<S> distance_to(const Collider<S>& collider, Vec3<S> p) {
  if (collider.type == ColliderType::plane) return {dot(p, collider.normal) - collider.offset, collider.normal};
  const Vec3<S> span = collider.end - collider.start;
  const Heading<S> along = heading_of(span);
  const Vec3<Unit<S>> u = along.direction;
  const Vec3<S> d = p - collider.start;
  const S t = clamp(dot(d, u), S(0), along.length);
  const Vec3<S> off = d - u * t;
  const Heading<S> way = heading_of(off);
  const bool on_axis = way.length == S(0);
  const Vec3<Unit<S>> up = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  return {way.length - collider.radius, on_axis ? up : way.direction};
}

}  // namespace isostep
