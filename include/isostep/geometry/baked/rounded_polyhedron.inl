// Body of rounded_polyhedron.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/polyhedron_surface.inl"
#include "isostep/geometry/baked/rounded_polyhedron.hpp"

namespace isostep {
namespace detail {

/// The point where a ray first meets one of several solids.
template <class S> struct RoundEntry {
  S distance;            // [m] along the ray; while nothing is found, as far as is looked
  Vec3<Unit<S>> normal;  // [1]
  bool found;

  ISO_INLINE bool is_sooner(S at) const { return found ? at < distance : at <= distance; }
};

/// Enters the ball about `centre` from outside.
template <class S> ISO_INLINE void enter_ball(const LocalRay<S>& ray, Vec3<S> centre, S radius, RoundEntry<S>& entry) {
  const Vec3<S> from = ray.origin - centre;
  S distance;
  if (!enter_sphere(from, ray.direction, radius, distance) || !entry.is_sooner(distance)) return;
  entry = {distance, normalise(from + ray.direction * distance), true};
}

/// Enters the points within `radius` of a segment, a disc in the plane across it. The place where the ray enters the
/// endless cylinder decides: between the ends the side is hit, beyond an end only that end's ball can be. It is
/// cast_capsule without a frame of its own.
template <class S>
ISO_INLINE void enter_around(const LocalRay<S>& ray, const Segment<S>& core, S radius, RoundEntry<S>& entry) {
  using U = Unit<S>;
  const Vec3<S> from = ray.origin - core.centre;
  const S start = dot(from, core.direction);
  const Vec3<S> flat = from - core.direction * start;
  S y = start;
  if (dot_sum(flat, flat) > product(radius, radius)) {
    const U rise = dot(ray.direction, core.direction);
    const Heading<U> across = heading_of(ray.direction - core.direction * rise);
    S aside;
    if (!enter_sphere(flat, across.direction, radius, aside) || aside > entry.distance * across.length) return;
    const S distance = divide_to<S>(aside, across.length);
    y = start + rise * distance;
    if (abs(y) <= core.half) {
      if (entry.is_sooner(distance)) entry = {distance, normalise(flat + across.direction * aside), true};
      return;
    }
  }
  enter_ball(ray, core.at(y > S(0) ? core.half : -core.half), radius, entry);
}

}  // namespace detail

template <class S>
detail::LocalHit<S> cast_rounded(const Polyhedron<S>& solid, S radius, const detail::LocalRay<S>& ray) {
  using namespace detail;
  S entry = S(0), exit = ray.length;
  std::uint32_t face = 0;
  bool within = true;  // all faces, moved outward
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const S height = dot(solid.normals[f], ray.origin) - solid.offsets[f] - radius;
    const Unit<S> rise = dot(solid.normals[f], ray.direction);
    within = within && height <= S(0);
    // The plane decides nothing else beyond the ray's length, see cast_ray.
    if (rise < Unit<S>(0)) {
      if (height > ray.length * -rise) return no_hit<S>();
      if (!(height > entry * -rise)) continue;
      entry = divide_to<S>(height, -rise);
      face = f;
    } else if (height > S(0)) {
      return no_hit<S>();
    } else if (-height < exit * rise) {
      exit = divide_to<S>(-height, rise);
    }
  }
  if (within && nearest_on(solid, ray.origin).distance <= radius) return inside_hit<S>();
  if (entry > exit) return no_hit<S>();
  if (!within && is_above_face(solid, face, ray.origin + ray.direction * entry))
    return {LocalHit<S>::entered, entry / ray.length, solid.normals[face]};
  RoundEntry<S> first = {ray.length, Vec3<Unit<S>>::zero(), false};
  for (std::uint32_t k = 0; k < solid.edges(); ++k) enter_around(ray, edge_of(solid, k), radius, first);
  if (!first.found) return no_hit<S>();
  return {LocalHit<S>::entered, first.distance / ray.length, first.normal};
}

}  // namespace isostep
