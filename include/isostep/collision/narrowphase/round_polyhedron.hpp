// Spheres and capsules on polyhedra: the nearest point of a polyhedron, and a thick point or segment against it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/ray.hpp"

namespace isostep {

/// Where a polyhedron's surface is nearest to a point, in its own frame.
template <class S> struct NearestPoint {
  Vec3<S> point;          // [m]
  S distance;             // [m] negative inside
  Vec3<Unit<S>> normal;   // [1] outward: the query is point + distance normal
  std::uint32_t feature;  // a face, or kEdge + an edge
  static constexpr std::uint32_t kEdge = 1u << 8;
};
template <class S> NearestPoint<S> nearest_on(const Polyhedron<S>& solid, Vec3<S> query);

/// Where a ray enters a polyhedron; it misses what it leaves. In the polyhedron's frame.
template <class S> detail::LocalHit<S> cast_ray(const Polyhedron<S>& solid, const detail::LocalRay<S>& ray);

/// A sphere of `radius` [m] about ta's position. One point, named as NearestPoint::feature.
template <class S>
void collide_sphere_polyhedron(S radius, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                               S margin, Manifold<S>& out);

/// A capsule along y of ta: one point, or two where it lies along a face or an edge. Features: bit 31, the face, the
/// edge that cuts the core there or 255, the end; bit 30 or 28, the face, the end; bit 29, the edge, the end; or an
/// edge.
template <class S>
void collide_capsule_polyhedron(S half_height, S radius, const Transform<S>& ta, const Polyhedron<S>& b,
                                const Transform<S>& tb, S margin, Manifold<S>& out);

#define ISO_ROUND_POLYHEDRON_OF(extern, S)                                                                             \
  extern template NearestPoint<S> nearest_on<S>(const Polyhedron<S>&, Vec3<S>);                                        \
  extern template detail::LocalHit<S> cast_ray<S>(const Polyhedron<S>&, const detail::LocalRay<S>&);                   \
  extern template void collide_sphere_polyhedron<S>(S, const Transform<S>&, const Polyhedron<S>&, const Transform<S>&, \
                                                    S, Manifold<S>&);                                                  \
  extern template void collide_capsule_polyhedron<S>(S, S, const Transform<S>&, const Polyhedron<S>&,                  \
                                                     const Transform<S>&, S, Manifold<S>&);
#define ISO_EXTERN(S) ISO_ROUND_POLYHEDRON_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
