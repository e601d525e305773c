// Bodies of polyhedron_surface.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/polyhedron_surface.hpp"

namespace isostep {
namespace detail {

template <class S> ISO_INLINE bool is_above_face(const Polyhedron<S>& solid, std::uint32_t face, Vec3<S> p) {
  std::uint32_t e = solid.faces[face];
  do {
    if (beyond_side(solid, e, solid.normals[face], p) > S(0)) return false;
    e = solid.half_edges[e].next;
  } while (e != solid.faces[face]);
  return true;
}

/// An edge that has its nearest point between its ends goes before one that has it at an end: near a vertex their
/// distances differ by less than they are rounded, their directions by its root.
template <class S> ISO_INLINE NearestPoint<S> nearest_on_edges(const Polyhedron<S>& solid, Vec3<S> query) {
  struct Nearest {
    S distance;
    Vec3<S> apart;
    std::uint32_t edge;
  };
  Nearest at_end = {highest<S>(), Vec3<S>::zero(), 0}, between = at_end;
  for (std::uint32_t k = 0; k < solid.edges(); ++k) {
    const Segment<S> side = edge_of(solid, k);
    const S along = side.nearest(query);
    const Vec3<S> apart = query - side.at(along);
    Nearest& least = abs(along) < side.half ? between : at_end;
    const S distance = length(apart);
    if (distance < least.distance) least = {distance, apart, k};
  }
  const bool inner = between.distance - gap_noise(max_abs(query)) <= at_end.distance;
  const Nearest& best = inner ? between : at_end;
  return {query - best.apart, best.distance, normalise(best.apart), NearestPoint<S>::kEdge + best.edge};
}

}  // namespace detail

template <class S> NearestPoint<S> nearest_on(const Polyhedron<S>& solid, Vec3<S> query) {
  std::uint32_t highest_face = 0;
  S most = S(0);
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const S height = dot(solid.normals[f], query) - solid.offsets[f];
    if (f == 0 || height > most) most = height, highest_face = f;
    if (height > S(0) && detail::is_above_face(solid, f, query))
      return {query - solid.normals[f] * height, height, solid.normals[f], f};
  }
  const Vec3<Unit<S>> normal = solid.normals[highest_face];
  // A gap of a few digits has a direction of a few digits.
  if (most <= detail::gap_noise(max_abs(query)) * S(4)) return {query - normal * most, most, normal, highest_face};
  return detail::nearest_on_edges(solid, query);
}

template <class S> detail::LocalHit<S> cast_ray(const Polyhedron<S>& solid, const detail::LocalRay<S>& ray) {
  S entry = S(0), exit = ray.length;
  std::uint32_t face = 0;
  bool inside = true;
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const S height = dot(solid.normals[f], ray.origin) - solid.offsets[f];
    const Unit<S> rise = dot(solid.normals[f], ray.direction);
    inside = inside && height <= S(0);
    // The plane decides nothing else beyond the ray's length either way, and its distance may not fit S.
    if (rise < Unit<S>(0)) {
      if (height > ray.length * -rise) return detail::no_hit<S>();
      if (!(height > entry * -rise)) continue;
      entry = divide_to<S>(height, -rise);
      face = f;
    } else if (height > S(0)) {
      return detail::no_hit<S>();
    } else if (-height < exit * rise) {
      exit = divide_to<S>(-height, rise);
    }
  }
  if (inside) return detail::inside_hit<S>();
  if (entry > exit) return detail::no_hit<S>();
  return {detail::LocalHit<S>::entered, entry / ray.length, solid.normals[face]};
}

}  // namespace isostep
