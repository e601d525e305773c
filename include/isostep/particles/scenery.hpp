// How far a point is from scenery, and in which direction.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/collider.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S> struct SceneryDistance {
  S distance;            // [m] below 0: inside
  Vec3<Unit<S>> normal;  // [1] out of the scenery
};

/// On a line's very axis up counts as outward.
template <class S> ISO_INLINE SceneryDistance<S> distance_to(const Collider<S>& collider, Vec3<S> p) {
  if (collider.type == ColliderType::plane) return {dot(p, collider.normal) - collider.offset, collider.normal};
  const Vec3<S> span = collider.end - collider.start;
  const Direction<S> along = direction_of(span.x, span.y, span.z);
  const Vec3<Unit<S>> u = {along.x, along.y, along.z};
  const Vec3<S> d = p - collider.start;
  const S t = clamp(dot(d, u), S(0), along.length);
  const Vec3<S> off = d - u * t;
  const Direction<S> way = direction_of(off.x, off.y, off.z);
  const bool on_axis = way.length == S(0);
  const Vec3<Unit<S>> up = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  return {way.length - collider.radius, on_axis ? up : Vec3<Unit<S>>{way.x, way.y, way.z}};
}

}  // namespace isostep
