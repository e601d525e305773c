// The contact polygons of W pairs of boxes at once: touch_faces() of face_clip.hpp, edge by edge instead of corner by
// corner. Part of pair_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_axes_lanes.inl"
#include "isostep/collision/narrowphase/face_clip.hpp"

namespace isostep {
namespace {

/// A convex polygon leaves each side of the reference face at most once, so its edges are known beforehand: 0..3 of the
/// incident face, 4 + side along a side, from where the polygon leaves it to where it comes back. Every edge is cut by
/// the sides in turn, as Sutherland and Hodgman cut a polygon's corners: the same numbers meet in the same order. A
/// polygon that only touches a side, or that rounding makes not convex, is reported as unclear and left to
/// touch_faces().
template <class S, int W, class Isa> struct BoxFacesLanes {
  using Pairs = PairLanes<S, W, Isa>;
  using Axes = BoxAxesLanes<S, W, Isa>;
  using L = typename Pairs::L;
  using U = typename Pairs::U;
  using Mask = typename Pairs::Mask;
  static constexpr int kEdges = 8, kSides = 4;

  struct Corner {
    L at[3];  // [m] u and v in the reference face, height above it
  };
  struct Edge {
    Corner from, to;
    Mask there;
    std::uint32_t leaves[kSides], enters[kSides];  // a bit a lane: cut by that side at its end, at its beginning
  };
  /// FacePair over lanes, with the numbers by which a manifold names its faces.
  struct Faces {
    L half[3], offset[3], incident_half[3];
    U turn[3][3];
    Mask below;
    Mask negative, incident0, incident1;  // the incident face: its axis is 0, 1 or neither
    Edge edges[kEdges];
    Mask unclear;
  };

  template <class T> static ISO_INLINE T pick(Mask m0, Mask m1, T a, T b, T c) {
    return select(m0, a, select(m1, b, c));
  }
  static ISO_INLINE Corner choose(Mask mask, const Corner& a, const Corner& b) {
    return {{select(mask, a.at[0], b.at[0]), select(mask, a.at[1], b.at[1]), select(mask, a.at[2], b.at[2])}};
  }
  static ISO_INLINE Mask differ(Mask a, Mask b) { return (a & ~b) | (b & ~a); }

  /// Does face_pair() for either box.
  static ISO_INLINE void face_pair(const typename Pairs::Bodies& p, const typename Axes::Boxes& boxes,
                                   const typename Axes::Best& best, Faces& faces) {
    Vec3<L> place = boxes.offset;
    U turn[3][3];
    if (any(best.of_b)) {
      const Vec3<L> from_b = -transposed_times(boxes.turn_b, p.gap);
      place = {select(best.of_b, from_b.x, place.x), select(best.of_b, from_b.y, place.y),
               select(best.of_b, from_b.z, place.z)};
    }
    L size[3];
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      size[i] = select(best.of_b, boxes.half_b[i], boxes.half_a[i]);
      faces.incident_half[i] = select(best.of_b, boxes.half_a[i], boxes.half_b[i]);
      ISO_UNROLL for (int j = 0; j < 3; ++j) {
        turn[i][j] = select(best.of_b, boxes.turn.rows[j][i], boxes.turn.rows[i][j]);
      }
    }
    const Mask m0 = best.axis0, m1 = best.axis1;
    ISO_UNROLL for (int k = 0; k < 3; ++k) {
      const int i0 = (k + 1) % 3, i1 = (k + 2) % 3;
      faces.half[k] = pick(m0, m1, size[i0], size[i1], size[k]);
      faces.offset[k] = pick(m0, m1, place[i0], place[i1], place[k]);
      ISO_UNROLL for (int j = 0; j < 3; ++j) faces.turn[k][j] = pick(m0, m1, turn[i0][j], turn[i1][j], turn[k][j]);
    }
    faces.below = less(faces.offset[2], L::zero());
  }

  /// Does incident_face(), as edges.
  static ISO_INLINE void incident_face(Faces& faces) {
    const U(&facing)[3] = faces.turn[2];
    const U x = abs(facing[0]), y = abs(facing[1]), z = abs(facing[2]);
    const Mask m0 = less_equal(y, x) & less_equal(z, x), m1 = less_equal(z, y) & ~m0;
    faces.incident0 = m0;
    faces.incident1 = m1;
    faces.negative = differ(less(U::zero(), pick(m0, m1, facing[0], facing[1], facing[2])), faces.below);
    const L(&h)[3] = faces.incident_half;
    const L size = pick(m0, m1, h[0], h[1], h[2]);
    const L half1 = pick(m0, m1, h[1], h[2], h[0]), half2 = pick(m0, m1, h[2], h[0], h[1]);
    const L to_face = select(faces.negative, -size, size);
    Corner corners[4];
    ISO_UNROLL for (int k = 0; k < 3; ++k) {
      const U(&r)[3] = faces.turn[k];
      const L e1 = pick(m0, m1, r[1], r[2], r[0]) * half1, e2 = pick(m0, m1, r[2], r[0], r[1]) * half2;
      const L centre = faces.offset[k] + pick(m0, m1, r[0], r[1], r[2]) * to_face;
      const L low = centre - e2, high = centre + e2;
      corners[0].at[k] = low - e1;
      corners[1].at[k] = low + e1;
      corners[2].at[k] = high + e1;
      corners[3].at[k] = high - e1;
    }
    ISO_UNROLL for (int i = 0; i < 4; ++i) {
      L& height = corners[i].at[2];
      height = select(faces.below, -height, height) - faces.half[2];
    }
    for (int i = 0; i < kEdges; ++i) {
      Edge& edge = faces.edges[i];
      for (int side = 0; side < kSides; ++side) edge.leaves[side] = edge.enters[side] = 0;
      edge.from = corners[i & 3];
      edge.to = corners[(i + 1) & 3];
      edge.there = Mask::from_bits(i < 4 ? 0xffffffffu >> (32 - W) : 0);
    }
  }

  /// Cuts off the part of an edge beyond `Side` (0: u < -half, 1: u > half, 2, 3: v). `left`: the polygons that left
  /// through that side.
  template <int Side> static ISO_INLINE void cut_edge(L half, Edge& edge, Edge& along, Mask& left, Mask& unclear) {
    constexpr int u = Side / 2, v = 1 - u;
    constexpr bool high = (Side & 1) != 0;
    const L x = edge.from.at[u], y = edge.to.at[u];
    const L p = (high ? x : -x) - half, q = (high ? y : -y) - half;
    const Mask p_out = less(L::zero(), p) & edge.there, q_out = less(L::zero(), q) & edge.there;
    if (!any(p_out | q_out)) return;
    const Mask leaves = q_out & ~p_out, enters = p_out & ~q_out, crosses = leaves | enters;
    edge.there = edge.there & ~(p_out & q_out);
    if (!any(crosses)) return;
    unclear = unclear | (crosses & ~less(select(p_out, q, p), L::zero())) | (leaves & left);
    left = left | leaves;
    edge.leaves[Side] = to_bits(leaves);
    edge.enters[Side] = to_bits(enters);
    const U t = quotient_where<U>(crosses, p, p - q);
    Corner cut;
    cut.at[u] = high ? half : -half;
    cut.at[v] = edge.from.at[v] + (edge.to.at[v] - edge.from.at[v]) * t;
    cut.at[2] = edge.from.at[2] + (edge.to.at[2] - edge.from.at[2]) * t;
    edge.from = choose(enters, cut, edge.from);
    edge.to = choose(leaves, cut, edge.to);
    along.from = choose(leaves, cut, along.from);
    along.to = choose(enters, cut, along.to);
  }
  template <int Side> static ISO_INLINE void cut_side(Faces& faces) {
    Edge& along = faces.edges[4 + Side];
    Mask left = Mask::from_bits(0);
    constexpr int known = Side < 2 ? 4 : 6;  // an edge along a side of u meets the sides of v alone
    for (int i = 0; i < known; ++i) cut_edge<Side>(faces.half[Side / 2], faces.edges[i], along, left, faces.unclear);
    along.there = left;
  }

  /// Clips the polygons of the pairs whose faces touch. `edges` hold where they begin and end.
  static void clip(const typename Pairs::Bodies& p, const typename Axes::Boxes& boxes, const typename Axes::Best& best,
                   Faces& faces) {
    face_pair(p, boxes, best, faces);
    incident_face(faces);
    faces.unclear = Mask::from_bits(0);
    cut_side<0>(faces);
    cut_side<1>(faces);
    cut_side<2>(faces);
    cut_side<3>(faces);
  }
};

}  // namespace
}  // namespace isostep
