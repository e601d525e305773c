// Tolerances of the separating axis tests: when two axes count as equally good, and two edges as parallel.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/geometry/closest.hpp"

namespace isostep::detail {

/// Edges whose cross product is shorter than the square root of this are skipped: rounding of the directions, a few
/// resolutions, would turn the product by more than sqrt(resolution) / 4. A face's axis then matches the missed one to
/// within that angle times the edges' length.
template <class S> ISO_INLINE constexpr Unit<S> near_parallel() {
  constexpr Unit<S> u = resolution<Unit<S>>();
  constexpr Unit<S> u4 = u + u + u + u;
  return u4 + u4 + u4 + u4;
}

/// [m] Returns the margin by which an axis must be better to replace a preferred one: 1/128 of the smallest half
/// extent, so that small rocking of a stack keeps its reference face, and the rounding of `extent` [m].
template <class S> ISO_INLINE constexpr S axis_tolerance(S smallest, S extent) {
  const S rounding = extent * resolution<Unit<S>>();
  return smallest * S(0.0078125) + rounding * S(8) + resolution<S>() * S(4);
}
/// Returns the tolerance of two solids, by their inner radii, whose origins are `apart` [m].
template <class S> ISO_INLINE constexpr S axis_tolerance(S inner_a, S inner_b, Vec3<S> apart) {
  return axis_tolerance(min(inner_a, inner_b), max_abs(apart) + inner_a + inner_b);
}
template <class S> ISO_INLINE constexpr S smallest_of(Vec3<S> half_a, Vec3<S> half_b) {
  const Vec3<S> low = min(half_a, half_b);
  return min(low.x, min(low.y, low.z));
}
template <class S> ISO_INLINE constexpr S axis_tolerance(Vec3<S> half_a, Vec3<S> half_b) {
  return axis_tolerance(smallest_of(half_a, half_b), max_abs(half_a) + max_abs(half_b));
}

/// Two faces look at each other if their normals are within this cosine, of 3.6 degrees.
inline constexpr double kNearFace = 0.998;
/// [m] The overlap up to which a's face is the reference of two that look at each other. In a deeper one the better
/// axis gives the shorter way out.
template <class S> inline constexpr S kMostBeside = S(1.0 / 64);
/// [m] Returns about the depth to which contacts sink, at most a quarter of the smallest half extent.
template <class S> ISO_INLINE constexpr S face_slack(S smallest) { return min(smallest * S(0.25), S(1.0 / 1024)); }
/// [m] Returns the most by which the gap of faces may differ from that of two edges that cross there: a heap that only
/// crossings hold apart is a heap of pivots. 6 mm for crates of 40 cm; Box3D uses 5.
template <class S> ISO_INLINE constexpr S edge_slack(S smallest) { return face_slack(smallest) + smallest * S(0.025); }
/// [m] Depths that differ by less are equal when a polygon is reduced to four of its corners, so that jitter does not
/// change the choice. slack: face_slack().
template <class S> ISO_INLINE constexpr S depth_tie(S tolerance, S slack) {
  return max(tolerance * S(0.125), slack + slack);
}

}  // namespace isostep::detail
