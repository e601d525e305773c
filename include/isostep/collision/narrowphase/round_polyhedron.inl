// Bodies of round_polyhedron.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedron_axes.hpp"
#include "isostep/collision/narrowphase/round_polyhedron.hpp"

namespace isostep {
namespace detail {

/// The best axis of a segment and a polyhedron, in the latter's frame, as in polyhedron_axes.hpp.
template <class S> struct SegmentAxis {
  std::uint32_t face;    // the best of the faces
  S face_separation;     // [m]
  std::uint32_t edge;    // where no face is as good; else kNone
  S separation;          // [m] of the best
  Vec3<Unit<S>> normal;  // [1] outward, of the best
  static constexpr std::uint32_t kNone = 0xffffffffu;
};

template <class S>
ISO_INLINE SegmentAxis<S> best_axis(const Polyhedron<S>& solid, const Segment<S>& core, S tolerance) {
  using U = Unit<S>;
  SegmentAxis<S> best = {0, S(0), SegmentAxis<S>::kNone, S(0), Vec3<U>::zero()};
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3<U> n = solid.normals[f];
    const S separation = dot(n, core.centre) - abs(dot(n, core.direction)) * core.half - solid.offsets[f];
    if (f == 0 || separation > best.face_separation) best.face = f, best.face_separation = separation;
  }
  best.separation = best.face_separation + tolerance;
  best.normal = solid.normals[best.face];
  for (std::uint32_t k = 0; k < solid.edges(); ++k) {
    const U half = U(0.5);  // as the point of the arc is found: what is nothing then has no sign
    const U at_left = dot(solid.normals[solid.half_edges[2 * k].face], core.direction) * half;
    const U at_right = dot(solid.normals[solid.half_edges[2 * k + 1].face], core.direction) * half;
    if (!((at_left > U(0) && at_right < U(0)) || (at_left < U(0) && at_right > U(0)))) continue;
    const Vec3<U> n = point_of_arc(solid, k, core.direction);
    const S separation = dot(n, core.centre - solid.vertices[solid.origin(2 * k)]);
    if (!(separation > best.separation)) continue;
    best.edge = k;
    best.separation = separation;
    best.normal = n;
  }
  if (best.edge == SegmentAxis<S>::kNone) best.separation = best.face_separation;
  return best;
}

/// The nearest points of a segment and a polyhedron that are apart: on an edge, or an end over a face.
template <class S> struct NearestPair {
  Vec3<S> on_core, on_solid;  // [m]
  std::uint32_t feature;      // an edge, or kOverFace + twice a face + the end over it
  static constexpr std::uint32_t kOverFace = 1u << 28;
  S distance;  // [m]
};
template <class S> ISO_INLINE NearestPair<S> nearest_pair(const Polyhedron<S>& solid, const Segment<S>& core) {
  NearestPair<S> best = {core.centre, core.centre, 0, highest<S>()};
  for (std::uint32_t k = 0; k < solid.edges(); ++k) {
    const Segment<S> edge = edge_of(solid, k);
    const ClosestPair<S> closest = closest_points(core, edge);
    const Vec3<S> on_core = core.at(closest.s), on_solid = edge.at(closest.t);
    const S distance = length(on_core - on_solid);
    if (distance < best.distance) best = {on_core, on_solid, k, distance};
  }
  for (std::uint32_t end = 0; end < 2; ++end) {
    const Vec3<S> p = core.at(end == 0 ? -core.half : core.half);
    const NearestPoint<S> nearest = nearest_on(solid, p);
    if (nearest.feature >= NearestPoint<S>::kEdge || !(nearest.distance < best.distance)) continue;
    best = {p, nearest.point, NearestPair<S>::kOverFace | nearest.feature << 1 | end, nearest.distance};
  }
  return best;
}

/// The stretch of a segment over a face, and the edges that cut it.
template <class S> struct FaceStretch {
  S at[2];                // [m] along the segment
  std::uint32_t edge[2];  // kNoEdge: its own end
  static constexpr std::uint32_t kNoEdge = 255;
};
template <class S>
ISO_INLINE bool stretch_over(const Polyhedron<S>& solid, std::uint32_t face, const Segment<S>& core, S slack,
                             FaceStretch<S>& over) {
  over = {{-core.half, core.half}, {FaceStretch<S>::kNoEdge, FaceStretch<S>::kNoEdge}};
  std::uint32_t e = solid.faces[face];
  do {
    const S beyond[2] = {beyond_side(solid, e, solid.normals[face], core.at(over.at[0])) - slack,
                         beyond_side(solid, e, solid.normals[face], core.at(over.at[1])) - slack};
    if (beyond[0] > S(0) && beyond[1] > S(0)) return false;
    for (int end = 0; end < 2; ++end) {
      if (!(beyond[end] > S(0))) continue;
      const Unit<S> t = divide_to<Unit<S>>(beyond[end], beyond[end] - beyond[1 - end]);
      over.at[end] = over.at[end] + (over.at[1 - end] - over.at[end]) * t;
      over.edge[end] = e / 2;
    }
    e = solid.half_edges[e].next;
  } while (e != solid.faces[face]);
  return true;
}

/// Adds the point of the core over the surface with the outward normal `normal`, all in the solid's frame.
template <class S>
ISO_INLINE void touch_round(Vec3<S> on_core, S distance, Vec3<Unit<S>> normal, S radius, const Transform<S>& frame,
                            std::uint32_t feature, Manifold<S>& out) {
  out.normal = -(frame.rotation * normal);
  out.add(to_world(frame, on_core - normal * ((distance + radius) * S(0.5))), distance - radius, feature);
}

inline constexpr double kAlong = 0.0625;  // sine of the angle, 3.6 degrees, within which a core lies along a feature

/// Adds both ends of the stretch over a face that the core lies along, if the lower of them is no higher than
/// `highest`. Cores up to `slack` beyond a side count as over it.
template <class S>
ISO_INLINE bool touch_along(const Polyhedron<S>& solid, std::uint32_t face, const Segment<S>& core, S highest, S slack,
                            S radius, S margin, const Transform<S>& frame, Manifold<S>& out) {
  const Vec3<Unit<S>> normal = solid.normals[face];
  FaceStretch<S> over;
  if (abs(dot(normal, core.direction)) > Unit<S>(kAlong) || !stretch_over(solid, face, core, slack, over)) return false;
  const Vec3<S> ends[2] = {core.at(over.at[0]), core.at(over.at[1])};
  const S heights[2] = {dot(normal, ends[0]) - solid.offsets[face], dot(normal, ends[1]) - solid.offsets[face]};
  if (!(over.at[0] < over.at[1]) || min(heights[0], heights[1]) > highest) return false;
  for (std::uint32_t end = 0; end < 2; ++end) {
    if (heights[end] - radius > margin) continue;
    touch_round(ends[end], heights[end], normal, radius, frame, 1u << 31 | face << 16 | over.edge[end] << 1 | end, out);
  }
  return out.count > 0;
}

/// Adds both ends of the stretch beside an edge that the core lies along.
template <class S>
ISO_INLINE bool touch_beside(const Polyhedron<S>& solid, std::uint32_t k, const Segment<S>& core, Vec3<Unit<S>> normal,
                             S radius, S margin, const Transform<S>& frame, Manifold<S>& out) {
  const Segment<S> edge = edge_of(solid, k);
  const Vec3<Unit<S>> across = cross(edge.direction, core.direction);
  if (dot(across, across) > Unit<S>(kAlong * kAlong)) return false;
  const S middle = dot(edge.centre - core.centre, core.direction);
  const S reach = edge.half * abs(dot(edge.direction, core.direction));
  const S low = max(-core.half, middle - reach), high = min(core.half, middle + reach);
  if (!(low < high)) return false;
  for (std::uint32_t end = 0; end < 2; ++end) {
    const Vec3<S> p = core.at(end == 0 ? low : high);
    const S height = dot(normal, p - edge.at(edge.nearest(p)));
    if (height - radius > margin + kPatchReach<S>) continue;
    touch_round(p, height, normal, radius, frame, 1u << 29 | k << 1 | end, out);
  }
  return out.count > 0;
}

}  // namespace detail

template <class S>
void collide_sphere_polyhedron(S radius, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                               S margin, Manifold<S>& out) {
  out.clear();
  const Vec3<S> centre = to_local(tb, ta.position);
  const NearestPoint<S> nearest = nearest_on(b, centre);
  if (nearest.distance - radius > margin) return;
  detail::touch_round(centre, nearest.distance, nearest.normal, radius, tb, nearest.feature, out);
}

template <class S>
void collide_capsule_polyhedron(S half_height, S radius, const Transform<S>& ta, const Polyhedron<S>& b,
                                const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  const Segment<S> core = {to_local(tb, ta.position), transposed_times(tb.rotation, ta.rotation.column(1)),
                           half_height};
  const S tolerance = axis_tolerance(b.inner_radius, max_abs(core.centre) + core.half + b.inner_radius);
  const SegmentAxis<S> best = best_axis(b, core, tolerance);
  if (best.separation - radius > margin) return;
  if (best.separation <= gap_noise(max_abs(core.centre))) {
    if (best.edge != SegmentAxis<S>::kNone) {
      const ClosestPair<S> crossing = closest_points(core, edge_of(b, best.edge));
      return touch_round(core.at(crossing.s), best.separation, best.normal, radius, tb, best.edge, out);
    }
    if (touch_along(b, best.face, core, best.separation + tolerance, tolerance, radius, margin, tb, out)) return;
    const bool low = dot(best.normal, core.direction) > Unit<S>(0);
    return touch_round(core.at(low ? -core.half : core.half), best.separation, best.normal, radius, tb,
                       1u << 30 | best.face << 1 | (low ? 0u : 1u), out);
  }
  const NearestPair<S> pair = nearest_pair(b, core);  // the cores are apart: what is nearest decides
  if (pair.distance - radius > margin) return;
  const Vec3<S> gap = pair.on_core - pair.on_solid;
  const bool over_face = dot(b.normals[best.face], gap) >= pair.distance - tolerance;
  if (over_face && touch_along(b, best.face, core, pair.distance + tolerance, tolerance, radius, margin, tb, out))
    return;
  const Vec3<Unit<S>> normal = normalise(gap);
  const bool at_edge = pair.feature < NearestPair<S>::kOverFace;
  if (at_edge && touch_beside(b, pair.feature, core, normal, radius, margin, tb, out)) return;
  touch_round(pair.on_core, pair.distance, normal, radius, tb, pair.feature, out);
}

}  // namespace isostep
