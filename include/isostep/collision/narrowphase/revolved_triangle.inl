// Bodies of revolved_triangle.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/revolved_touch.hpp"
#include "isostep/collision/narrowphase/revolved_triangle.hpp"

namespace isostep {
namespace detail {

/// What decides how a solid of revolution touches a triangle; all in the solid's frame.
template <class S> class RevolvedOverTriangle {
  using U = Unit<S>;
  using Axis = RevolvedAxis<S>;

 public:
  ISO_INLINE RevolvedOverTriangle(const Revolved<S>& solid, const SurfaceTriangle<S>& triangle, S slack)
      : solid_(solid), triangle_(triangle), slack_(slack) {}

  /// False: a disc is further off than `margin`.
  ISO_INLINE bool look_at_discs(S margin, S tolerance, Axis& best) const {
    for (int end = 0; end < 2; ++end) {
      if (!(solid_.radii[end] > S(0))) continue;
      const Vec3<U> n = unit_axis<U>(1, end == 0);
      S heights[3];
      S least = highest<S>();
      for (int i = 0; i < 3; ++i) {
        heights[i] = dot(n, triangle_.points[i]) - solid_.half;
        least = min(least, heights[i]);
      }
      if (least > margin) return false;
      const S lead = best.kind == Axis::cap ? S(0) : tolerance;
      if (least > best.separation + lead && owns(-n, heights, least)) best.offer(Axis::cap, least, n, 0, end, lead);
    }
    return true;
  }
  /// Whether the plane of a neighbour, whose outer side the centre is on, is better: then it is that one's to touch.
  ISO_INLINE bool is_of_neighbour(Vec3<S> centre, S tolerance, const Axis& best) const {
    for (int k = 0; k < 3; ++k) {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      if (!edge.touchable || !edge.has_neighbour) continue;
      if (dot(edge.other, centre - triangle_.points[k]) < S(0)) continue;
      const S separation = -solid_.reach(-edge.other).most() - dot(edge.other, triangle_.points[k]);
      if (separation > best.separation + (best.kind == Axis::face ? tolerance : S(0))) return true;
    }
    return false;
  }
  /// False: the triangle by itself is further off than `margin`, along whatever axis.
  ISO_INLINE bool look_at_edges(S margin, S tolerance, Axis& best) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (!look_at_point(k, margin, tolerance, best) || is_apart_at(k, margin)) return false;
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      if (edge.touchable)
        look_at_line(solid_, {triangle_.points[k], edge.along, {edge.inward, edge.away}}, k, tolerance, best);
    }
    return best.separation <= margin;
  }

  ISO_INLINE void touch(const Axis& best, const RevolvedTouch<S>& touch) const {
    const std::uint32_t name = kNoFace | static_cast<std::uint32_t>(best.kind) << 8 | best.feature << 4;
    switch (best.kind) {
      case Axis::face:
        if (!touch.over_face(plane())) at_lowest(best, touch);
        return;
      case Axis::cap:
        return touch.under_disc(
            static_cast<int>(best.end), 3, [&](int i) ISO_INLINE_LAMBDA { return triangle_.points[i]; },
            [](int i) ISO_INLINE_LAMBDA { return static_cast<std::uint32_t>(i); }, kNoFace | 1u << 24 | best.end << 20);
      case Axis::side_edge:
      case Axis::side_vertex: return beside(best, touch, name);
      case Axis::rim: return at_rim(best, touch, name | best.end);
    }
  }

 private:
  static constexpr std::uint32_t kNoFace = 1u << 30;
  static constexpr double kAlongEdge = 0.02;  // sine within which a disc lies along an edge

  /// Whether the surface can be touched from a direction, by its points that are lowest above a disc.
  ISO_INLINE bool owns(Vec3<U> direction, const S (&heights)[3], S least) const {
    for (int k = 0; k < 3; ++k) {
      const bool along = abs(dot(direction, triangle_.edges[k].along)) <= U(kAlongEdge);
      const bool ends = heights[k] == least || heights[(k + 1) % 3] == least;  // one of them is the least, exactly
      if (along && ends && triangle_.owns_at_edge(k, direction)) return true;
      if (heights[k] == least && triangle_.owns_at_point(k, direction)) return true;
    }
    return false;
  }
  ISO_INLINE S lowest(Vec3<U> n) const {
    const Vec3<S>(&p)[3] = triangle_.points;
    return min(dot(n, p[0]), min(dot(n, p[1]), dot(n, p[2])));
  }
  ISO_INLINE bool look_at_point(std::uint32_t i, S margin, S tolerance, Axis& best) const {
    const Vec3<S> p = triangle_.points[i];
    const Vec3<U> n = side_towards(solid_, p);
    const S lead = best.kind >= Axis::side_vertex ? S(0) : tolerance;
    const S height = dot(n, p), least = lowest(n), reach = solid_.reach(n).most();
    if (least - reach > margin) return false;
    if (height - reach > best.separation + lead && height == least && triangle_.owns_at_point(static_cast<int>(i), -n))
      best.offer(Axis::side_vertex, height - reach, n, i, 0, lead);
    return true;
  }
  /// Whether an axis across an edge separates, though nothing may touch the surface along it.
  ISO_INLINE bool is_apart_at(std::uint32_t k, S margin) const {
    const SurfaceEdge<S>& edge = triangle_.edges[k];
    const LineOfOther<S> line = {triangle_.points[k], edge.along, {edge.inward, edge.inward}};
    const NormalsAcross<S> normals(solid_, line);
    bool apart = false;
    if (normals.is_parallel()) return false;
    const auto look = [&](Vec3<U> n)
                          ISO_INLINE_LAMBDA { apart = apart || lowest(n) - solid_.reach(n).most() > margin; };
    normals.visit_side(look);
    for (int end = 0; end < 2; ++end) {
      if (solid_.radii[end] > S(0)) normals.visit_rim(end, look);
    }
    return apart;
  }
  ISO_INLINE FaceOfOther<S> plane() const {
    FaceOfOther<S> plane;
    plane.normal = triangle_.normal;
    plane.offset = triangle_.offset;
    plane.own = triangle_feature::kOfConvexAlone;
    plane.cut = 1u << 31;
    const S slack = triangle_.slack();
    for (int k = 0; k < 3; ++k) {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      plane.sides.sides[plane.sides.count++] = {-edge.inward, slack - dot(edge.inward, triangle_.points[k]),
                                                kSideName + static_cast<std::uint32_t>(k), edge.flat};
    }
    return plane;
  }
  /// Along the edge that begins or ends there, or at a point of it.
  ISO_INLINE void beside(const Axis& best, const RevolvedTouch<S>& touch, std::uint32_t name) const {
    const auto along = [&](std::uint32_t k) ISO_INLINE_LAMBDA {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      return edge.touchable && triangle_.owns_at_edge(static_cast<int>(k), -best.normal) &&
             touch.beside(triangle_.points[k], edge.along, edge.length, best.normal, kNoFace | 1u << 25 | k << 1);
    };
    if (along(best.feature)) return;
    const Segment<S> side = side_line(solid_, solid_.reach(best.normal).radial);
    if (best.kind == Axis::side_vertex) {
      if (along((best.feature + 2) % 3)) return;
      const Vec3<S> p = triangle_.points[best.feature];
      return between(side.at(side.nearest(p)), p, best, touch, name);
    }
    const Segment<S> edge = edge_line(best.feature);
    const ClosestPair<S> closest = closest_points(side, edge);
    between(side.at(closest.s), edge.at(closest.t), best, touch, name);
  }
  /// The lowest point alone, where it is a little beyond an edge that is not flat: over a ridge it is over neither
  /// side.
  ISO_INLINE void at_lowest(const Axis& best, const RevolvedTouch<S>& touch) const {
    const Reach<S> reach = solid_.reach(best.normal);
    const Vec3<S> p = solid_.rim(reach.end(), reach.radial);
    for (int k = 0; k < 3; ++k) {
      const S beyond = -triangle_.inside_of(k, p);
      if (beyond > slack_ || (beyond > S(0) && triangle_.edges[k].flat)) return;
    }
    touch.at(p + best.normal * (best.separation * S(0.5)), best.separation, best.normal,
             triangle_feature::kOfConvexAlone | kLowestEnd | static_cast<std::uint32_t>(reach.end()));
  }
  ISO_INLINE void at_rim(const Axis& best, const RevolvedTouch<S>& touch, std::uint32_t name) const {
    const Reach<S> reach = solid_.reach(best.normal);
    const Vec3<S> p = solid_.rim(reach.end(), reach.radial);
    const Segment<S> edge = edge_line(best.feature);
    between(p, edge.at(edge.nearest(p)), best, touch, name);
  }
  ISO_INLINE Segment<S> edge_line(std::uint32_t k) const {
    const SurfaceEdge<S>& edge = triangle_.edges[k];
    const S half = edge.length * S(0.5);
    return {triangle_.points[k] + edge.along * half, edge.along, half};
  }
  /// One point, unless it is beyond an end of what touches: then something else decides.
  ISO_INLINE void between(Vec3<S> on_solid, Vec3<S> on_edge, const Axis& best, const RevolvedTouch<S>& touch,
                          std::uint32_t name) const {
    if (longer_than(on_edge - on_solid - best.normal * best.separation, slack_)) return;
    touch.at((on_solid + on_edge) * S(0.5), best.separation, best.normal, name);
  }

  const Revolved<S>& solid_;
  const SurfaceTriangle<S>& triangle_;
  const S slack_;  // [m]
};

}  // namespace detail

template <class S>
void collide_revolved_triangle(const detail::Revolved<S>& solid, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                               const BakedTriangle& baked, S margin, Manifold<S>& out) {
  using namespace detail;
  using Axis = RevolvedAxis<S>;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  if (triangle.height < S(0)) return;
  const S lowest = -solid.reach(-triangle.normal).most();
  Axis best = {Axis::face, lowest - triangle.offset, -triangle.normal, 0, 0};
  if (best.separation > margin) return;
  triangle.find_edges(frame, baked);
  const S size = min(solid.half, solid.radii[0]);
  const S tolerance = axis_tolerance(size, max_abs(frame.centre) + size);
  const RevolvedOverTriangle<S> pair(solid, triangle, tolerance * S(4));
  const Axis plane = best;
  // Where what was preferred touches nothing, the best of all decides.
  for (int round = 0; round < 2 && out.count == 0 && best.separation <= (round == 0 ? margin : S(0)); ++round) {
    const S lead = round == 0 ? tolerance : S(0);
    best = plane;
    if (!pair.look_at_discs(margin, lead, best)) return;
    if (pair.is_of_neighbour(frame.centre, lead, best)) return;
    if (!pair.look_at_edges(margin, lead, best)) return;
    pair.touch(best, RevolvedTouch<S>(solid, ta, margin, tolerance * S(0.125), out));
  }
}

}  // namespace isostep
