// V-Clip: the distance of two polyhedra by a walk over their closest features, from those of before.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// A vertex, edge or face of a polyhedron. What it does not have counts as its vertex 0.
struct PolyhedronFeature {
  enum Kind : std::uint8_t { vertex, edge, face };
  Kind kind;
  std::uint8_t index;

  friend ISO_INLINE constexpr bool operator==(PolyhedronFeature a, PolyhedronFeature b) {
    return a.kind == b.kind && a.index == b.index;
  }
};
/// The features from which the walk starts and at which it ends: kept from one call to the next, they make the next one
/// short.
struct FeaturePair {
  PolyhedronFeature a, b;
};

enum class VClipStatus : std::uint8_t {
  apart,       // each closest point is in the other feature's Voronoi region: no points are nearer
  overlap,     // a vertex is inside the other solid, or an edge crosses a face
  unfinished,  // 64 rounds did not end the walk, which rounding can make go round: the distance is of the last features
};

template <class S> struct VClipDistance {
  VClipStatus status;
  S distance;            // [m] 0 for overlap
  Vec3<Unit<S>> normal;  // [1] from a to b; zero for overlap
  Vec3<S> on_a, on_b;    // [m]
  FeaturePair features;
  std::int32_t rounds;
};

/// All in the frame that both transforms lead to. The step does not use it: GJK needs no state and no walk.
/// Source:  Mirtich 1998, V-Clip: Fast and Robust Polyhedral Collision Detection, ACM Trans. Graphics 17(3), sec. 3, 4.
/// Differs: where an edge misses a face's region, the face's edge that is nearest to it follows, found by looking at
///          all. What is beyond a plane by no more than rounding is inside of it.
/// Error:   tests/unit/book/v_clip_test.cpp says in how many cases the distance is that of GJK.
template <class S>
VClipDistance<S> v_clip_distance(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                 const Transform<S>& tb, FeaturePair from);

#define ISO_V_CLIP_OF(extern, S)                                                                                       \
  extern template VClipDistance<S> v_clip_distance<S>(const Polyhedron<S>&, const Transform<S>&, const Polyhedron<S>&, \
                                                      const Transform<S>&, FeaturePair);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_V_CLIP_OF)

}  // namespace isostep
