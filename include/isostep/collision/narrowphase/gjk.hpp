// GJK: the distance of two convex solids, and where they are nearest.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

template <class S> struct GjkDistance {
  S distance;            // [m] of the nearest points; 0 where they overlap
  Vec3<Unit<S>> normal;  // [1] from a to b; zero where they overlap
  Vec3<S> on_a, on_b;    // [m] nearest points; where they overlap, where the search ended
  std::int32_t iterations;
  S separation;  // [m] of the two along the normal: what proves that they are apart; 0 where they overlap
};

/// Finds the distance and the nearest points, all in the frame that both transforms lead to.
/// Source:  Gilbert, Johnson and Keerthi 1988, A fast procedure for computing the distance between complex objects.
/// Differs: the nearest point of a simplex is found by unit normals and distances, never by ratios of fourth powers of
///          lengths, which do not fit fixed point. The search ends by counting: when a support is a vertex pair of the
///          simplex, when the distance no longer falls, or after 32 rounds.
/// Limits:  distances up to a few of S's digits may count as overlap, and the other way round.
template <class S>
GjkDistance<S> gjk_distance(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                            const Transform<S>& tb);

/// Does gjk_distance() for the hulls of two cores, without their radii.
template <class S>
GjkDistance<S> gjk_distance(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                            const Transform<S>& tb);

#define ISO_GJK_OF(extern, S)                                                                                     \
  extern template GjkDistance<S> gjk_distance<S>(const Polyhedron<S>&, const Transform<S>&, const Polyhedron<S>&, \
                                                 const Transform<S>&);                                            \
  extern template GjkDistance<S> gjk_distance<S>(const ConvexCore<S>&, const Transform<S>&, const ConvexCore<S>&, \
                                                 const Transform<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_GJK_OF)

}  // namespace isostep
