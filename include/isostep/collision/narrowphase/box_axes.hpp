// The separating axes of two boxes, the best of them, and where two of their edges cross.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/math/segment.hpp"

namespace isostep::detail {

/// Two boxes in a's frame.
template <class S> struct BoxPair {
  Vec3<S> half_a, half_b;   // [m]
  Vec3<S> offset;           // [m] b's centre
  Mat3<Unit<S>> turn;       // rows: a's axes; columns: b's
  Mat3<Unit<S>> turn_size;  // |turn|
};

/// The best axis: 0..2 a face of a, 3..5 a face of b, 6 + 3 i + j the cross of a's axis i and b's axis j.
template <class S> struct BestAxis {
  int axis;              // -1: apart
  int face;              // of the faces the one that is preferred: 0..5
  S separation;          // [m] of the cores
  Vec3<Unit<S>> normal;  // [1] crosses only: from a to b, a's frame
};

/// Returns the separation along a's axis I times b's axis J, not normalised: no further from zero than the true one.
template <int I, int J, class S> ISO_INLINE S cross_separation(const BoxPair<S>& p) {
  constexpr int i1 = (I + 1) % 3, i2 = (I + 2) % 3, j1 = (J + 1) % 3, j2 = (J + 2) % 3;
  const Mat3<Unit<S>>& r = p.turn;
  const Mat3<Unit<S>>& q = p.turn_size;
  const auto gap = product(p.offset[i2], r.rows[i1][J]) - product(p.offset[i1], r.rows[i2][J]);
  const auto reach = product(p.half_a[i1], q.rows[i2][J]) + product(p.half_a[i2], q.rows[i1][J]) +
                     product(p.half_b[j1], q.rows[I][j2]) + product(p.half_b[j2], q.rows[I][j1]);
  return round_to<S>((gap < widen<SumOf<S, Unit<S>>>(S(0)) ? -gap : gap) - reach);
}

/// Examines one cross of edges in full. Returns false if it separates the boxes by more than reach.
template <class S>
ISO_INLINE bool examine_cross(const BoxPair<S>& p, int i, int j, S reach, S& limit, BestAxis<S>& best) {
  using U = Unit<S>;
  const Vec3<U> across = cross(unit_axis<U>(i, false), p.turn.column(j));
  const U size2 = dot(across, across);
  if (size2 < near_parallel<S>()) return true;
  Vec3<U> n = heading_of(across).direction;
  const S offset = dot(p.offset, n);
  const S separation = abs(offset) - dot(p.half_a, abs(n)) - dot(p.half_b, abs(transposed_times(p.turn, n)));
  if (separation > reach) return false;
  if (!(separation > limit)) return true;
  limit = separation;
  best = {6 + 3 * i + j, best.face, separation, offset < S(0) ? -n : n};
  return true;
}

/// Examines the crosses 3 i + j whose bits are set. Sets best.axis to -1 if one of them separates.
template <class S>
ISO_INLINE void examine_crosses(const BoxPair<S>& p, unsigned candidates, S reach, S limit, BestAxis<S>& best) {
  for (int k = 0; candidates != 0; ++k, candidates >>= 1) {
    if ((candidates & 1u) == 0) continue;
    const int i = k / 3, j = k - 3 * i;
    if (examine_cross(p, i, j, reach, limit, best)) continue;
    best.axis = -1;
    return;
  }
}

/// Returns the separation along a's axis I [m]. Fills in the parts of the pair that it needs.
template <int I, class S>
ISO_INLINE S separation_of_a(BoxPair<S>& p, const Mat3<Unit<S>>& turn_a, const Mat3<Unit<S>>& turn_b, Vec3<S> gap) {
  const Vec3<Unit<S>> axis = turn_a.column(I);
  p.offset[I] = dot(axis, gap);
  p.turn.rows[I] = transposed_times(turn_b, axis);
  p.turn_size.rows[I] = abs(p.turn.rows[I]);
  return abs(p.offset[I]) - p.half_a[I] - dot(p.turn_size.rows[I], p.half_b);
}

/// Returns true if two faces look at each other to within kNearFace. Either gives the same points then, and a's is
/// taken, however jitter changes their distance.
template <class S> ISO_INLINE bool are_beside(const BoxPair<S>& p, int face_a, int face_b) {
  const bool below_a = p.offset[face_a] < S(0), below_b = dot(p.offset, p.turn.column(face_b)) < S(0);
  return negate_if(below_a != below_b, p.turn.rows[face_a][face_b]) >= Unit<S>(kNearFace);
}

/// Finds the best axis and fills in the rest of the pair on the way: half of all pairs end at one of the first
/// axes.
template <class S>
ISO_INLINE BestAxis<S> best_axis(BoxPair<S>& p, const Transform<S>& ta, const Transform<S>& tb, S reach) {
  BestAxis<S> best = {-1, 0, S(0), Vec3<Unit<S>>::zero()};
  const auto& q = p.turn_size;
  const Vec3<S> gap = tb.position - ta.position;
  const S a0 = separation_of_a<0>(p, ta.rotation, tb.rotation, gap);
  if (a0 > reach) return best;
  const S a1 = separation_of_a<1>(p, ta.rotation, tb.rotation, gap);
  if (a1 > reach) return best;
  const S a2 = separation_of_a<2>(p, ta.rotation, tb.rotation, gap);
  if (a2 > reach) return best;
  const S b0 = abs(dot(p.offset, p.turn.column(0))) - p.half_b.x - dot(q.column(0), p.half_a);
  if (b0 > reach) return best;
  const S b1 = abs(dot(p.offset, p.turn.column(1))) - p.half_b.y - dot(q.column(1), p.half_a);
  if (b1 > reach) return best;
  const S b2 = abs(dot(p.offset, p.turn.column(2))) - p.half_b.z - dot(q.column(2), p.half_a);
  if (b2 > reach) return best;

  const S of_a = max(a0, max(a1, a2)), of_b = max(b0, max(b1, b2));
  const S tolerance = axis_tolerance(p.half_a, p.half_b);
  const int face_a = a0 >= a1 && a0 >= a2 ? 0 : a1 >= a2 ? 1 : 2, face_b = b0 >= b1 && b0 >= b2 ? 0 : b1 >= b2 ? 1 : 2;
  const bool prefers_b = of_b > of_a + tolerance && !(of_b > -kMostBeside<S> && are_beside(p, face_a, face_b));
  best.axis = best.face = prefers_b ? 3 + face_b : face_a;
  best.separation = prefers_b ? of_b : of_a;

  // A cross that is negative unnormalised only sinks when normalised; one that is positive rises.
  const S limit = max(of_a, of_b) + tolerance;
  const S worth = min(limit, S(0));
  const S crosses[9] = {cross_separation<0, 0>(p), cross_separation<0, 1>(p), cross_separation<0, 2>(p),
                        cross_separation<1, 0>(p), cross_separation<1, 1>(p), cross_separation<1, 2>(p),
                        cross_separation<2, 0>(p), cross_separation<2, 1>(p), cross_separation<2, 2>(p)};
  unsigned candidates = 0;
  for (int k = 0; k < 9; ++k) {
    if (crosses[k] > worth) candidates |= 1u << k;
  }
  examine_crosses(p, candidates, reach, limit, best);
  return best;
}

/// Adds the one point where an edge of a crosses an edge of b.
template <class S>
ISO_INLINE void touch_edges(const BoxPair<S>& p, const BestAxis<S>& best, S radius_a, S radius_b,
                            const Transform<S>& ta, Manifold<S>& out) {
  using U = Unit<S>;
  const int i = (best.axis - 6) / 3, j = best.axis - 6 - 3 * i;
  const Vec3<U> n = best.normal, m = transposed_times(p.turn, n);
  Vec3<S> on_a = Vec3<S>::zero(), on_b = on_a;  // the supporting edges' centres, each in its box's frame
  std::uint32_t feature = std::uint32_t(best.axis - 6);
  for (int k = 0; k < 3; ++k) {
    const bool a_low = n[k]<U(0), b_low = m[k]> U(0);
    on_a[k] = k == i ? S(0) : negate_if(a_low, p.half_a[k]);
    on_b[k] = k == j ? S(0) : negate_if(b_low, p.half_b[k]);
    if (k != i && a_low) feature |= 16u << k;
    if (k != j && b_low) feature |= 128u << k;
  }
  const Segment<S> edge_a = {on_a, unit_axis<U>(i, false), p.half_a[i]};
  const Segment<S> edge_b = {p.offset + p.turn * on_b, p.turn.column(j), p.half_b[j]};
  const ClosestPair<S> closest = closest_points(edge_a, edge_b);
  const Vec3<S> middle = (edge_a.at(closest.s) + n * radius_a + edge_b.at(closest.t) - n * radius_b) * S(0.5);
  out.normal = ta.rotation * n;
  out.add(to_world(ta, middle), best.separation - radius_a - radius_b, feature);
}

}  // namespace isostep::detail
