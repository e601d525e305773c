// The contact polygon of two boxes' faces: the incident face clipped to the reference face, reduced to four points.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"

namespace isostep::detail {

/// The incident box seen from the reference box, and the reference face's axis.
template <class S> struct FacePair {
  Vec3<S> half, incident_half;  // [m]
  Vec3<S> offset;               // [m] the incident box's centre
  Mat3<Unit<S>> turn;           // rows: reference axes; columns: incident axes
  int axis;
};

/// A corner of the contact polygon. Its edges name it: 0..3 edges of the incident face, 4..7 sides of the reference.
template <class S> struct ClipPoint {
  S u, v;                       // [m] in the reference face
  S height;                     // [m] above it
  std::uint32_t before, after;  // the edge that ends here, the edge that begins here
};

/// A quadrilateral gains at most one corner from each of four sides; what rounding might add beyond that is dropped.
inline constexpr int kClipPoints = 8;
template <class S> struct ClipPolygon {
  ClipPoint<S> points[kClipPoints];
  int count;
};

/// Cuts off what lies beyond `side` (0: u < -half, 1: u > half, 2, 3: v). A corner on the line stays, not doubled.
template <class S> ISO_INLINE void clip_side(ClipPolygon<S>& polygon, unsigned side, S half) {
  S beyond[kClipPoints];
  bool cuts = false;
  for (int i = 0; i < polygon.count; ++i) {
    const S w = side < 2 ? polygon.points[i].u : polygon.points[i].v;
    beyond[i] = ((side & 1u) ? w : -w) - half;
    cuts = cuts || beyond[i] > S(0);
  }
  if (!cuts) return;
  const ClipPolygon<S> from = polygon;
  polygon.count = 0;
  for (int i = 0; i < from.count; ++i) {
    const int next = i + 1 < from.count ? i + 1 : 0;
    const ClipPoint<S>& p = from.points[i];
    const ClipPoint<S>& q = from.points[next];
    if (!(beyond[i] > S(0)) && polygon.count < kClipPoints) polygon.points[polygon.count++] = p;
    const bool leaves = beyond[i] < S(0) && beyond[next] > S(0), enters = beyond[i] > S(0) && beyond[next] < S(0);
    if (!(leaves || enters) || polygon.count == kClipPoints) continue;
    const Unit<S> t = divide_to<Unit<S>>(beyond[i], beyond[i] - beyond[next]);
    ClipPoint<S>& cut = polygon.points[polygon.count++];
    const S border = (side & 1u) ? half : -half;
    cut.u = side < 2 ? border : p.u + (q.u - p.u) * t;
    cut.v = side < 2 ? p.v + (q.v - p.v) * t : border;
    cut.height = p.height + (q.height - p.height) * t;
    cut.before = leaves ? p.after : 4 + side;
    cut.after = leaves ? 4 + side : p.after;
  }
}

/// Twice the signed area of a triangle in the face [m^2], exact for fixed point.
template <class S> ISO_INLINE Sum<S> area2(const ClipPoint<S>& a, const ClipPoint<S>& b, const ClipPoint<S>& c) {
  return product(b.u - a.u, c.v - a.v) - product(b.v - a.v, c.u - a.u);
}

template <class S> ISO_INLINE Sum<S> distance2(const ClipPoint<S>& a, const ClipPoint<S>& b) {
  return product(b.u - a.u, b.u - a.u) + product(b.v - a.v, b.v - a.v);
}

/// Four of up to eight corners: the deepest (within `tie` the first); the one furthest from it; the one that spans the
/// largest triangle with these; the one that adds most area outside it. Kept in the polygon's order; ties go to the
/// lowest index.
template <class S> ISO_INLINE void reduce_to_four(ClipPolygon<S>& polygon, S tie) {
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

/// The face of the incident box that looks most against the reference normal; ties go to the lowest axis. Returns
/// axis * 2, + 1 for its negative side.
template <class S> ISO_INLINE unsigned incident_face(const FacePair<S>& pair, bool below, ClipPolygon<S>& polygon) {
  const int u_axis = (pair.axis + 1) % 3, v_axis = (pair.axis + 2) % 3;
  const Vec3<Unit<S>> facing = pair.turn.rows[pair.axis];
  const Vec3<Unit<S>> size = abs(facing);
  const int m = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const bool negative = (facing[m] > Unit<S>(0)) != below;
  const int m1 = (m + 1) % 3, m2 = (m + 2) % 3;
  const Vec3<S> to_face = pair.turn.column(m) * negate_if(negative, pair.incident_half[m]);
  const Vec3<S> e1 = pair.turn.column(m1) * pair.incident_half[m1];
  const Vec3<S> e2 = pair.turn.column(m2) * pair.incident_half[m2];
  const Vec3<S> centre = pair.offset + to_face;
  const Vec3<S> low = centre - e2, high = centre + e2;
  const Vec3<S> corners[4] = {low - e1, low + e1, high + e1, high - e1};
  for (unsigned i = 0; i < 4; ++i) {
    const Vec3<S> c = corners[i];
    polygon.points[i] = {c[u_axis], c[v_axis], negate_if(below, c[pair.axis]) - pair.half[pair.axis], (i + 3) & 3u, i};
  }
  polygon.count = 4;
  return unsigned(m) * 2 + (negative ? 1u : 0u);
}

template <class S>
ISO_INLINE void touch_faces(const FacePair<S>& pair, S radius, S incident_radius, const Transform<S>& frame, S margin,
                            bool of_a, Manifold<S>& out) {
  const int u_axis = (pair.axis + 1) % 3, v_axis = (pair.axis + 2) % 3;
  const bool below = pair.offset[pair.axis] < S(0);
  ClipPolygon<S> polygon;
  const unsigned face = incident_face(pair, below, polygon);
  clip_side(polygon, 0, pair.half[u_axis]);
  clip_side(polygon, 1, pair.half[u_axis]);
  clip_side(polygon, 2, pair.half[v_axis]);
  clip_side(polygon, 3, pair.half[v_axis]);

  const S radii = radius + incident_radius;
  int kept = 0;
  for (int i = 0; i < polygon.count; ++i) {
    if (polygon.points[i].height - radii <= margin) polygon.points[kept++] = polygon.points[i];
  }
  polygon.count = kept;
  if (kept == 0) return;
  if (kept > kManifoldPoints) reduce_to_four(polygon, axis_tolerance(pair.half, pair.incident_half) * S(0.125));

  const Vec3<Unit<S>> outward = negate_if(below, frame.rotation.column(pair.axis));
  out.normal = of_a ? outward : -outward;
  const std::uint32_t name =
      1u << 31 | (of_a ? 0u : 1u) << 12 | unsigned(pair.axis) << 10 | (below ? 1u : 0u) << 9 | face << 6;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipPoint<S>& p = polygon.points[i];
    const S level = pair.half[pair.axis] + (p.height + radius - incident_radius) * S(0.5);
    Vec3<S> local = Vec3<S>::zero();
    local.set(u_axis, p.u);
    local.set(v_axis, p.v);
    local.set(pair.axis, negate_if(below, level));
    out.add(to_world(frame, local), p.height - radii, name | p.before << 3 | p.after);
  }
}

}  // namespace isostep::detail
