// The contact polygon of two boxes' faces: the incident face clipped to the reference face, reduced to four points.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_axes.hpp"

namespace isostep::detail {

/// The incident box seen from the reference box. Index 0, 1: along the reference face, u and v; 2: out of it, height.
template <class S> struct FacePair {
  int axes[3];         // the reference box's axis of each
  S half[3];           // [m] the reference box's
  S offset[3];         // [m] the incident box's centre
  Unit<S> turn[3][3];  // columns: incident axes
  S incident_half[3];  // [m] along its own axes
};

/// Returns the incident box as seen from the reference box. turn: rows: reference axes; columns: incident axes.
template <class S>
ISO_INLINE FacePair<S> face_pair(int axis, Vec3<S> half, Vec3<S> incident_half, Vec3<S> offset,
                                 const Mat3<Unit<S>>& turn) {
  const S sizes[3] = {half.x, half.y, half.z}, places[3] = {offset.x, offset.y, offset.z};
  FacePair<S> pair;
  for (int k = 0; k < 3; ++k) {
    const int i = axis + k < 2 ? axis + k + 1 : axis + k - 2;
    pair.axes[k] = i;
    pair.half[k] = sizes[i];
    pair.offset[k] = places[i];
    pair.incident_half[k] = incident_half[k];
    for (int j = 0; j < 3; ++j) pair.turn[k][j] = turn.rows[i][j];
  }
  return pair;
}

/// A corner of the contact polygon. Its edges name it: of boxes 0..3 edges of the incident face, 4..7 sides of the
/// reference; polyhedra have names of their own.
template <class S> struct ClipPoint {
  S u, v;                       // [m] in the reference face
  S height;                     // [m] above it
  std::uint32_t before, after;  // the edge that ends here, the edge that begins here
};

/// A quadrilateral gains at most one corner from each of four sides; corners that rounding might add beyond that are
/// dropped.
inline constexpr int kClipPoints = 8;
template <class S, int kCapacity = kClipPoints> struct ClipPolygon {
  ClipPoint<S> points[kCapacity];
  int count;
};

/// Cuts off the part of a polygon beyond a line named `side`. A corner on the line stays, not doubled. `beyond` [m] of
/// each corner. cut(p, q, t, at) sets u and v on the line between corners p and q. Returns true if something was cut:
/// then the result is in `to`, else it is still in `from`.
template <class S, int kCapacity, class Cut>
ISO_INLINE bool clip(const ClipPolygon<S, kCapacity>& from, const S* beyond, std::uint32_t side, const Cut& cut,
                     ClipPolygon<S, kCapacity>& to) {
  bool cuts = false;
  for (int i = 0; i < from.count; ++i) cuts = cuts || beyond[i] > S(0);
  if (!cuts) return false;
  int count = 0;
  for (int i = 0; i < from.count; ++i) {
    const int next = i + 1 < from.count ? i + 1 : 0;
    const ClipPoint<S>& p = from.points[i];
    const ClipPoint<S>& q = from.points[next];
    const bool p_out = beyond[i] > S(0), q_out = beyond[next] > S(0);
    if (!p_out && count < kCapacity) to.points[count++] = p;
    if (p_out == q_out || !((p_out ? beyond[next] : beyond[i]) < S(0)) || count == kCapacity) continue;
    const Unit<S> t = divide_to<Unit<S>>(beyond[i], beyond[i] - beyond[next]);
    ClipPoint<S>& corner = to.points[count++];
    cut(p, q, t, corner);
    corner.height = p.height + (q.height - p.height) * t;
    corner.before = q_out ? p.after : side;
    corner.after = q_out ? side : p.after;
  }
  to.count = count;
  return true;
}

/// Cuts off the part beyond one side of a box's face (0: u < -half, 1: u > half, 2, 3: v).
template <class S> ISO_INLINE bool clip_side(const ClipPolygon<S>& from, unsigned side, S half, ClipPolygon<S>& to) {
  S beyond[kClipPoints];
  for (int i = 0; i < from.count; ++i) {
    const S w = side < 2 ? from.points[i].u : from.points[i].v;
    beyond[i] = ((side & 1u) ? w : -w) - half;
  }
  const S border = (side & 1u) ? half : -half;
  const auto cut = [&](const ClipPoint<S>& p, const ClipPoint<S>& q, Unit<S> t, ClipPoint<S>& at) ISO_INLINE_LAMBDA {
    at.u = side < 2 ? border : p.u + (q.u - p.u) * t;
    at.v = side < 2 ? p.v + (q.v - p.v) * t : border;
  };
  return clip(from, beyond, 4 + side, cut, to);
}

/// Returns the doubled signed area of a triangle in the face [m^2], exact in fixed point.
template <class S> ISO_INLINE Sum<S> area2(const ClipPoint<S>& a, const ClipPoint<S>& b, const ClipPoint<S>& c) {
  return product(b.u - a.u, c.v - a.v) - product(b.v - a.v, c.u - a.u);
}

template <class S> ISO_INLINE Sum<S> distance2(const ClipPoint<S>& a, const ClipPoint<S>& b) {
  return product(b.u - a.u, b.u - a.u) + product(b.v - a.v, b.v - a.v);
}

/// Keeps four of the corners: the deepest (the first within `tie`); the one furthest from it; the one that spans the
/// largest triangle with these; the one that adds most area outside it. They stay in polygon order. Ties go to the
/// lowest index.
template <class S, int kCapacity> ISO_INLINE void reduce_to_four(ClipPolygon<S, kCapacity>& polygon, S tie) {
  const ClipPoint<S>* p = polygon.points;
  S lowest = p[0].height;
  for (int i = 1; i < polygon.count; ++i) lowest = min(lowest, p[i].height);
  int first = 0;
  while (p[first].height > lowest + tie) ++first;
  int second = first == 0 ? 1 : 0, third = -1, fourth = -1;
  auto furthest = distance2(p[first], p[second]);
  for (int i = second + 1; i < polygon.count; ++i) {
    const auto distance = distance2(p[first], p[i]);
    if (i == first || !(distance > furthest)) continue;
    furthest = distance;
    second = i;
  }
  auto largest = furthest;
  bool clockwise = false;
  for (int i = 0; i < polygon.count; ++i) {
    if (i == first || i == second) continue;
    const auto signed_area = area2(p[first], p[second], p[i]);
    const bool negative = signed_area < -signed_area;
    const auto area = negative ? -signed_area : signed_area;
    if (third >= 0 && !(area > largest)) continue;
    largest = area;
    third = i;
    clockwise = negative;
  }
  const int corner[3] = {first, clockwise ? third : second, clockwise ? second : third};
  for (int i = 0; i < polygon.count; ++i) {
    if (i == first || i == second || i == third) continue;
    auto outside = -area2(p[corner[0]], p[corner[1]], p[i]);
    outside = max(outside, -area2(p[corner[1]], p[corner[2]], p[i]));
    outside = max(outside, -area2(p[corner[2]], p[corner[0]], p[i]));
    if (fourth >= 0 && !(outside > largest)) continue;
    largest = outside;
    fourth = i;
  }
  int kept = 0;
  for (int i = 0; i < polygon.count; ++i) {
    if (i == first || i == second || i == third || i == fourth) polygon.points[kept++] = polygon.points[i];
  }
  polygon.count = kept;
}

/// Keeps the corners of the patch, or none if the lowest is higher than `reach` [m].
template <class S, int kCapacity> ISO_INLINE void keep_patch(ClipPolygon<S, kCapacity>& polygon, S reach) {
  bool touches = false;
  int kept = 0;
  for (int i = 0; i < polygon.count; ++i) {
    touches = touches || polygon.points[i].height <= reach;
    if (!(polygon.points[i].height <= reach + kPatchReach<S>)) continue;
    if (kept != i) polygon.points[kept] = polygon.points[i];
    ++kept;
  }
  polygon.count = touches ? kept : 0;
}

/// Finds the face of the incident box that looks most against the reference normal. Ties go to the lowest axis. Returns
/// axis * 2, + 1 for its negative side.
template <class S> ISO_INLINE unsigned incident_face(const FacePair<S>& pair, bool below, ClipPolygon<S>& polygon) {
  const Unit<S>(&facing)[3] = pair.turn[2];
  const Vec3<Unit<S>> size = {abs(facing[0]), abs(facing[1]), abs(facing[2])};
  const int m = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const bool negative = (facing[m] > Unit<S>(0)) != below;
  const int m1 = m < 2 ? m + 1 : 0, m2 = m < 1 ? 2 : m - 1;
  const S to_face = negate_if(negative, pair.incident_half[m]);
  S corners[3][4];
  for (int k = 0; k < 3; ++k) {
    const S e1 = pair.turn[k][m1] * pair.incident_half[m1], e2 = pair.turn[k][m2] * pair.incident_half[m2];
    const S centre = pair.offset[k] + pair.turn[k][m] * to_face;
    const S low = centre - e2, high = centre + e2;
    corners[k][0] = low - e1;
    corners[k][1] = low + e1;
    corners[k][2] = high + e1;
    corners[k][3] = high - e1;
  }
  for (unsigned i = 0; i < 4; ++i) {
    const S height = negate_if(below, corners[2][i]) - pair.half[2];
    polygon.points[i] = {corners[0][i], corners[1][i], height, (i + 3) & 3u, i};
  }
  polygon.count = 4;
  return unsigned(m) * 2 + (negative ? 1u : 0u);
}

/// Adds the points of the face polygon. below: the reference face is the negative one of its axis.
template <class S>
ISO_INLINE void touch_faces(const FacePair<S>& pair, bool below, S radius, S incident_radius, const Transform<S>& frame,
                            S margin, bool of_a, Manifold<S>& out) {
  ClipPolygon<S> polygons[2];
  const unsigned face = incident_face(pair, below, polygons[0]);
  unsigned now = 0;
  now ^= clip_side(polygons[now], 0, pair.half[0], polygons[now ^ 1u]) ? 1u : 0u;
  now ^= clip_side(polygons[now], 1, pair.half[0], polygons[now ^ 1u]) ? 1u : 0u;
  now ^= clip_side(polygons[now], 2, pair.half[1], polygons[now ^ 1u]) ? 1u : 0u;
  now ^= clip_side(polygons[now], 3, pair.half[1], polygons[now ^ 1u]) ? 1u : 0u;
  ClipPolygon<S>& polygon = polygons[now];

  const S radii = radius + incident_radius;
  keep_patch(polygon, margin + radii);
  if (polygon.count == 0) return;
  if (polygon.count > kMaxContactPoints) {
    const Vec3<S> half = {pair.half[0], pair.half[1], pair.half[2]};
    const Vec3<S> incident = {pair.incident_half[0], pair.incident_half[1], pair.incident_half[2]};
    reduce_to_four(polygon, depth_tie(axis_tolerance(half, incident), face_slack(smallest_of(half, incident))));
  }

  const Vec3<Unit<S>> outward = negate_if(below, frame.rotation.column(pair.axes[2]));
  out.normal = of_a ? outward : -outward;
  const std::uint32_t name =
      1u << 31 | (of_a ? 0u : 1u) << 12 | unsigned(pair.axes[2]) << 10 | (below ? 1u : 0u) << 9 | face << 6;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipPoint<S>& p = polygon.points[i];
    const S level = pair.half[2] + (p.height + radius - incident_radius) * S(0.5);
    S local[3];
    local[pair.axes[0]] = p.u;
    local[pair.axes[1]] = p.v;
    local[pair.axes[2]] = negate_if(below, level);
    out.add(to_world(frame, Vec3<S>{local[0], local[1], local[2]}), p.height - radii, name | p.before << 3 | p.after);
  }
}

/// Does touch_faces() for a face of a.
template <class S>
ISO_INLINE void touch_face_of_a(const BoxPair<S>& pair, int axis, bool below, S radius_a, const Transform<S>& ta,
                                S radius_b, S margin, Manifold<S>& out) {
  const FacePair<S> faces = face_pair(axis, pair.half_a, pair.half_b, pair.offset, pair.turn);
  touch_faces(faces, below, radius_a, radius_b, ta, margin, true, out);
}
template <class S> ISO_INLINE Vec3<S> offset_from_b(const Transform<S>& ta, const Transform<S>& tb) {
  return -transposed_times(tb.rotation, tb.position - ta.position);
}
/// Does touch_faces() for a face of b. offset [m]: a's centre in b's frame.
template <class S>
ISO_INLINE void touch_face_of_b(const BoxPair<S>& pair, int axis, bool below, Vec3<S> offset, S radius_a, S radius_b,
                                const Transform<S>& tb, S margin, Manifold<S>& out) {
  const FacePair<S> faces = face_pair(axis, pair.half_b, pair.half_a, offset, transpose(pair.turn));
  touch_faces(faces, below, radius_b, radius_a, tb, margin, false, out);
}

/// Does touch_faces() for the best axis. axis: BestAxis::axis of a face.
template <class S>
ISO_INLINE void touch_best_faces(const BoxPair<S>& pair, int axis, S radius_a, const Transform<S>& ta, S radius_b,
                                 const Transform<S>& tb, S margin, Manifold<S>& out) {
  if (axis < 3) return touch_face_of_a(pair, axis, pair.offset[axis] < S(0), radius_a, ta, radius_b, margin, out);
  const Vec3<S> offset = offset_from_b(ta, tb);
  touch_face_of_b(pair, axis - 3, offset[axis - 3] < S(0), offset, radius_a, radius_b, tb, margin, out);
}

/// Returns true if the points of a manifold show the gap `separation`, to within `slack` [m].
template <class S> ISO_INLINE bool tells_of(const Manifold<S>& m, S separation, S slack) {
  if (m.count == 0) return false;
  S least = m.points[0].separation;
  for (int i = 1; i < m.count; ++i) least = min(least, m.points[i].separation);
  return abs(least - separation) <= slack;
}

/// Collides two boxes whose best axis is a cross of edges. If their best faces show almost the same gap, the faces
/// touch: a box that lies a little askew on something long and thin rests on the patch where they cross. The edges are
/// only one corner of it, and in the next step another.
template <class S>
ISO_INLINE void touch_crossing(const BoxPair<S>& pair, const BestAxis<S>& best, S radius_a, const Transform<S>& ta,
                               S radius_b, const Transform<S>& tb, S margin, Manifold<S>& out) {
  touch_best_faces(pair, best.face, radius_a, ta, radius_b, tb, margin, out);
  if (tells_of(out, best.separation - radius_a - radius_b, edge_slack(smallest_of(pair.half_a, pair.half_b)))) return;
  out.clear();
  touch_edges(pair, best, radius_a, radius_b, ta, out);
}

}  // namespace isostep::detail
