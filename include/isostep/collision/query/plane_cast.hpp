// A convex core that is cast along a line against a half-space.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/shape_cast.hpp"

namespace isostep::detail {

/// cast_convex() against the points p with normal . p <= offset, in the frame at `t`. One division replaces the search.
/// Leaves the plane in motion.parting, whatever the result.
template <class S>
ISO_INLINE bool cast_plane(const ConvexCore<S>& core, const Transform<S>& start, Vec3<Unit<S>> normal, S offset,
                           const Transform<S>& t, const CastMotion<S>& motion, CastHit<S>& hit) {
  using F = Finer<S>;
  using U = Unit<F>;
  const FineCore<S> fine(core);
  const Mat3<U> turn = finer_of(start).rotation;
  const Vec3<U> up = finer_of(t).rotation * finer_of<U>(normal), up_of_core = transposed_times(turn, up);
  const Vec3<F> apart = finer_of<F>(start.position - t.position), way = finer_of<F>(motion.translation);
  Vec3<F> lowest = fine.vertices[0];
  for (const Vec3<F>& v : fine.vertices) {
    if (dot(up_of_core, v) < dot(up_of_core, lowest)) lowest = v;
  }
  const F above = dot(up, apart) - finer<F>(offset) + dot(up_of_core, lowest) - fine.radius;
  const F noise = gap_noise(fine.extent + max_abs(apart)), nearby = noise * F(2) + finer<F>(resolution<S>());
  const F gap = above - noise, fall = -dot(up, way), end = fall * finer<U>(motion.max_fraction);
  hit.inside = false;
  if (motion.parting != nullptr) *motion.parting = {coarser_of<Unit<S>>(up), start.position, coarser<S>(gap)};
  U fraction = U(0);
  if (gap <= nearby) {
    const F touch = finer<F>(motion.touch), long_way = length(way) * finer<U>(motion.max_fraction);
    hit.inside = -above > max(touch, nearby);
    if (!hit.inside && !(end > max(min(touch, long_way * F(0.00390625)), nearby))) return false;
  } else {
    if (!(fall > F(0)) || gap >= end) return false;
    fraction = max(divide_to<U>(gap, fall) - resolution<U>(), U(0));
  }
  hit.fraction = coarser_down<Unit<S>>(fraction);
  hit.normal = coarser_of<Unit<S>>(up);
  const Vec3<F> on_core = turn * lowest - up * fine.radius + way * fraction;
  hit.point = start.position + coarser_of<S>(on_core - up * (above - fall * fraction));
  return true;
}

}  // namespace isostep::detail
