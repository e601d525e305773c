// A ball that is cast against a box, where one face decides.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/plane_cast.hpp"
#include "isostep/geometry/shapes/box.hpp"

namespace isostep::detail {

enum class FaceCast { hit, miss, undecided };

/// cast_convex() of a core of one vertex against a box, as far as a face decides it that is below the ball at the
/// start. The box lies behind that face's plane. So a ball that does not reach the plane misses the box, and one that
/// meets the plane within the face meets nothing before it.
/// Undecided: a ball that starts near the face or inside the box, or that passes the face by an edge.
template <class S>
ISO_INLINE FaceCast cast_ball(const ConvexCore<S>& core, const Transform<S>& start, Vec3<S> half, const Transform<S>& t,
                              const CastMotion<S>& motion, CastHit<S>& hit) {
  constexpr S kClear = S(0x1p-6), kWithin = S(0x1p-10);  // [m] above rounding and what counts as touch
  const Vec3<S> at = transposed_times(t.rotation, to_world(start, core.vertices[0]) - t.position);
  for (int axis = 0; axis < 3; ++axis) {
    if (abs(at[axis]) - half[axis] - core.radius < kClear) continue;
    Vec3<Unit<S>> normal = Vec3<Unit<S>>::zero();
    normal[axis] = at[axis] < S(0) ? Unit<S>(-1) : Unit<S>(1);
    CastHit<S> found;
    if (!cast_plane(core, start, normal, half[axis], t, motion, found)) return FaceCast::miss;
    Vec3<S> beside = abs(transposed_times(t.rotation, found.point - t.position));
    beside[axis] = S(0);
    if (beside.x + kWithin < half.x && beside.y + kWithin < half.y && beside.z + kWithin < half.z) {
      hit = found;
      return FaceCast::hit;
    }
  }
  return FaceCast::undecided;
}

}  // namespace isostep::detail
