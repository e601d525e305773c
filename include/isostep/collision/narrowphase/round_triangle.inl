// Bodies of round_triangle.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/round_polyhedron.inl"
#include "isostep/collision/narrowphase/round_triangle.hpp"

namespace isostep {
namespace detail {

/// The point of the triangle's rim that is nearest to a point which is not over its inside.
template <class S> struct RimPoint {
  Vec3<S> apart;  // [m] from there to the point
  S distance;     // [m]
  int edge;
  int vertex;  // of the edge's ends; -1: between them
};
template <class S> ISO_INLINE RimPoint<S> nearest_on_rim(const SurfaceTriangle<S>& triangle, Vec3<S> p) {
  RimPoint<S> best = {p, highest<S>(), 0, -1};
  for (int k = 0; k < 3; ++k) {
    const SurfaceEdge<S>& edge = triangle.edges[k];
    if (triangle.inside_of(k, p) >= S(0)) continue;
    const S along = dot(p - triangle.points[k], edge.along);
    const int vertex = along <= S(0) ? k : along >= edge.length ? (k + 1) % 3 : -1;
    const Vec3<S> on_edge = vertex < 0 ? triangle.points[k] + edge.along * along : triangle.points[vertex];
    const Vec3<S> apart = p - on_edge;
    const S distance = length(apart);
    if (distance < best.distance) best = {apart, distance, k, vertex};
  }
  return best;
}

/// The stretch of a capsule's core over a triangle, and the edges that cut it.
template <class S> struct TriangleStretch {
  S at[2];      // [m] along the core
  int edge[2];  // -1: its own end
  bool any;
};
template <class S>
ISO_INLINE TriangleStretch<S> stretch_over(const SurfaceTriangle<S>& triangle, const Segment<S>& core) {
  TriangleStretch<S> over = {{-core.half, core.half}, {-1, -1}, true};
  const S slack = triangle.slack();
  for (int k = 0; k < 3; ++k) {
    const S beyond[2] = {-triangle.inside_of(k, core.at(over.at[0])) - slack,
                         -triangle.inside_of(k, core.at(over.at[1])) - slack};
    if (beyond[0] > S(0) && beyond[1] > S(0)) return {{S(0), S(0)}, {-1, -1}, false};
    for (int end = 0; end < 2; ++end) {
      if (!(beyond[end] > S(0))) continue;
      const Unit<S> t = divide_to<Unit<S>>(beyond[end], beyond[end] - beyond[1 - end]);
      over.at[end] = over.at[end] + (over.at[1 - end] - over.at[end]) * t;
      over.edge[end] = k;
    }
  }
  return over;
}

/// The best of the edges that a core may touch. An edge above the core counts only if the core is as near as its radius
/// and a stretch of it is over the triangle, `is_over`. A core that is deeper, or beside it, is beyond another side, or
/// a face pushes it out.
template <class S> struct TriangleEdgeTouch {
  S separation;  // [m] of the core
  Vec3<Unit<S>> normal;
  S along;   // [m] along the core
  int edge;  // -1: none
};
template <class S>
ISO_INLINE TriangleEdgeTouch<S> touched_edge(const SurfaceTriangle<S>& triangle, const Segment<S>& core, S radius,
                                             bool is_over) {
  TriangleEdgeTouch<S> best = {highest<S>(), triangle.normal, S(0), -1};
  for (int k = 0; k < 3; ++k) {
    const SurfaceEdge<S>& edge = triangle.edges[k];
    if (!edge.touchable) continue;
    const S half = edge.length * S(0.5);
    const Segment<S> side = {triangle.points[k] + edge.along * half, edge.along, half};
    const ClosestPair<S> closest = closest_points(core, side);
    const Heading<S> gap = heading_of(core.at(closest.s) - side.at(closest.t));
    if (gap.length <= gap_noise(max_abs(side.centre))) continue;
    const bool between = abs(closest.t) < half;
    const bool below = between && gap.length <= radius && triangle.is_under_edge(k, gap.direction);
    if (below && !is_over) continue;
    const Vec3<Unit<S>> normal = below ? -gap.direction : gap.direction;
    const S separation = below ? -gap.length : gap.length;
    const int vertex = closest.t < S(0) ? k : (k + 1) % 3;
    if (!(between ? triangle.owns_at_edge(k, normal) : triangle.owns_at_point(vertex, normal))) continue;
    if (separation < best.separation) best = {separation, normal, closest.s, k};
  }
  return best;
}

/// Adds both ends of the stretch beside an edge that the core lies along.
template <class S>
ISO_INLINE bool touch_beside(const SurfaceTriangle<S>& triangle, const TriangleEdgeTouch<S>& touch,
                             const Segment<S>& core, S radius, S margin, const Transform<S>& ta, Manifold<S>& out) {
  const SurfaceEdge<S>& edge = triangle.edges[touch.edge];
  const Vec3<Unit<S>> across = cross(edge.along, core.direction);
  if (dot(across, across) > Unit<S>(kAlong * kAlong)) return false;
  const S half = edge.length * S(0.5);
  const S middle = dot(triangle.points[touch.edge] + edge.along * half - core.centre, core.direction);
  const S reach = half * abs(dot(edge.along, core.direction));
  const S low = max(-core.half, middle - reach), high = min(core.half, middle + reach);
  if (!(low < high)) return false;
  const std::uint32_t name = 1u << 25 | static_cast<std::uint32_t>(touch.edge) << 1;
  for (std::uint32_t end = 0; end < 2; ++end) {
    const Vec3<S> p = core.at(end == 0 ? low : high);
    const S height = dot(touch.normal, p - triangle.points[touch.edge]);
    if (height - radius <= margin + kPatchReach<S>) touch_round(p, height, touch.normal, radius, ta, name | end, out);
  }
  return out.count > 0;
}

}  // namespace detail

template <class S>
void collide_sphere_triangle(S radius, const Transform<S>& ta, const SurfaceFrame<S>& frame, const BakedTriangle& baked,
                             S margin, Manifold<S>& out) {
  constexpr std::uint32_t kFeature = triangle_feature::kOfConvexAlone;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  if (triangle.height < S(0) || triangle.height - radius > margin) return;
  triangle.find_edges(frame, baked);
  const Vec3<S> centre = frame.centre;
  const S slack = triangle.slack();
  bool over = true;
  for (int k = 0; k < 3; ++k) over = over && triangle.inside_of(k, centre) >= -slack;
  if (over) return detail::touch_round(centre, triangle.height, triangle.normal, radius, ta, kFeature, out);
  const detail::RimPoint<S> rim = detail::nearest_on_rim(triangle, centre);
  if (rim.distance - radius > margin || rim.distance <= slack) return;
  const Vec3<Unit<S>> normal = normalise(rim.apart);
  const bool owned =
      rim.vertex < 0 ? triangle.owns_at_edge(rim.edge, normal) : triangle.owns_at_point(rim.vertex, normal);
  if (owned) detail::touch_round(centre, rim.distance, normal, radius, ta, kFeature, out);
}

template <class S>
void collide_capsule_triangle(S half_height, S radius, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                              const BakedTriangle& baked, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  const Segment<S> core = {frame.centre, unit_axis<Unit<S>>(1, false), half_height};
  const S lowest = triangle.height - abs(triangle.normal.y) * half_height;
  if (triangle.height < S(0) || lowest - radius > margin) return;
  triangle.find_edges(frame, baked);
  const TriangleStretch<S> over = stretch_over(triangle, core);
  const TriangleEdgeTouch<S> edge = touched_edge(triangle, core, radius, over.any);
  const Vec3<S> ends[2] = {core.at(over.at[0]), core.at(over.at[1])};
  const S heights[2] = {triangle.height_of(ends[0]), triangle.height_of(ends[1])};
  const S tolerance = axis_tolerance(radius, max_abs(core.centre) + half_height);
  if (over.any && (edge.edge < 0 || min(heights[0], heights[1]) <= edge.separation + tolerance)) {
    for (std::uint32_t end = 0; end < 2; ++end) {
      const int cut = over.edge[end];
      if (heights[end] - radius > margin || (cut >= 0 && triangle.edges[cut].flat)) continue;
      const std::uint32_t name =
          cut < 0 ? triangle_feature::kOfConvexAlone : 1u << 27 | static_cast<std::uint32_t>(cut) << 1;
      touch_round(ends[end], heights[end], triangle.normal, radius, ta, name | end, out);
    }
    return;
  }
  if (edge.edge < 0 || edge.separation - radius > margin) return;
  if (touch_beside(triangle, edge, core, radius, margin, ta, out)) return;
  const bool at_end = abs(edge.along) == half_height;  // exact: it is clamped there
  const std::uint32_t name = at_end ? triangle_feature::kOfConvexAlone | (edge.along > S(0) ? 1u : 0u)
                                    : 1u << 26 | static_cast<std::uint32_t>(edge.edge);
  touch_round(core.at(edge.along), edge.separation, edge.normal, radius, ta, name, out);
}

}  // namespace isostep
