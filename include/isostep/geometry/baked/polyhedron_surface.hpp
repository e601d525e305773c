// The surface of a polyhedron: its point nearest to another, and where a ray enters.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/closest.hpp"
#include "isostep/geometry/ray.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/math/segment.hpp"

namespace isostep {

/// The point of a polyhedron's surface that is nearest to another, in its own frame.
template <class S> struct NearestPoint {
  Vec3<S> point;          // [m]
  S distance;             // [m] negative inside
  Vec3<Unit<S>> normal;   // [1] outward: the query is point + distance normal
  std::uint32_t feature;  // a face, or kEdge + an edge
  static constexpr std::uint32_t kEdge = 1u << 8;
};
template <class S> NearestPoint<S> nearest_on(const Polyhedron<S>& solid, Vec3<S> query);

/// Finds where a ray enters a polyhedron, in its frame; a ray that starts inside is reported as `inside`.
template <class S> detail::LocalHit<S> cast_ray(const Polyhedron<S>& solid, const detail::LocalRay<S>& ray);

namespace detail {
/// Edge k, from its lower vertex to its higher.
template <class S> ISO_INLINE Segment<S> edge_of(const Polyhedron<S>& solid, std::uint32_t k) {
  const Vec3<S> from = solid.vertices[solid.origin(2 * k)];
  const Vec3<S> half = (solid.vertices[solid.origin(2 * k + 1)] - from) * S(0.5);
  return {from + half, solid.directions[k], dot(half, solid.directions[k])};
}

/// [m] The distance by which p is beyond the side of a face at one of its half-edges.
template <class S>
ISO_INLINE S beyond_side(const Polyhedron<S>& solid, std::uint32_t half_edge, Vec3<Unit<S>> normal, Vec3<S> p) {
  const Vec3<Unit<S>> along = solid.directions[half_edge / 2];
  const Vec3<Unit<S>> across = cross((half_edge & 1u) != 0 ? -along : along, normal);
  return dot(across, p - solid.vertices[solid.origin(half_edge)]);
}
}  // namespace detail

#define ISO_POLYHEDRON_SURFACE_OF(extern, S)                                    \
  extern template NearestPoint<S> nearest_on<S>(const Polyhedron<S>&, Vec3<S>); \
  extern template detail::LocalHit<S> cast_ray<S>(const Polyhedron<S>&, const detail::LocalRay<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_POLYHEDRON_SURFACE_OF)

}  // namespace isostep
