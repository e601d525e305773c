// Rays and nearest points of surfaces made of triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/height_field.hpp"
#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "isostep/geometry/closest.hpp"
#include "isostep/geometry/ray.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

/// The part of a ray's way that is of interest.
template <class S> struct RayReach {
  S max_fraction = S(1);    // [1]
  bool back_faces = false;  // hits triangles from behind too: the normal is theirs turned round
};
/// Takes hits one by one, in no order.
template <class S> struct RayTaker {
  void* user;
  void (*take)(void* user, const detail::LocalHit<S>& hit);
};

/// Finds where a ray first enters a surface from its outward side, in the surface's frame; of triangles hit at once the
/// one with the lowest id. Surfaces are watertight: the ray is put on a grid once, and its side of an edge is an exact
/// integer that both neighbours share. The reach decides what is found, never a bit of it.
template <class G, class S>
detail::LocalHit<S> cast_on_surface(const G& surface, const detail::LocalRay<S>& ray, const RayReach<S>& reach);
/// Takes every triangle that the ray enters within its reach; where it passes an edge, those on both sides.
template <class G, class S>
void cast_through_surface(const G& surface, const detail::LocalRay<S>& ray, const RayReach<S>& reach,
                          const RayTaker<S>& taker);

/// Finds the point of a surface that is nearest to another; of equally near triangles the one with the lowest id.
/// Surfaces have no inside: the distance is never negative, and the normal leads to `query`; where that is on the
/// surface, outward.
template <class G, class S> ClosestPoint<S> nearest_on_surface(const G& surface, Vec3<S> query);

/// [m] The box of a surface in its frame.
template <class G, class S> Aabb<S> box_of_surface(const G& surface);

#define ISO_SURFACE_QUERIES_OF_ONE(extern, G, S)                                                                       \
  extern template detail::LocalHit<S> cast_on_surface<G, S>(const G&, const detail::LocalRay<S>&, const RayReach<S>&); \
  extern template void cast_through_surface<G, S>(const G&, const detail::LocalRay<S>&, const RayReach<S>&,            \
                                                  const RayTaker<S>&);                                                 \
  extern template ClosestPoint<S> nearest_on_surface<G, S>(const G&, Vec3<S>);                                         \
  extern template Aabb<S> box_of_surface<G, S>(const G&);
#define ISO_SURFACE_QUERIES_OF(extern, S)             \
  ISO_SURFACE_QUERIES_OF_ONE(extern, TriangleMesh, S) \
  ISO_SURFACE_QUERIES_OF_ONE(extern, BakedHeightField, S)
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SURFACE_QUERIES_OF)

}  // namespace isostep
