// Bodies of solid_triangle.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/rounded.inl"
#include "isostep/collision/narrowphase/solid_faces.inl"
#include "isostep/collision/narrowphase/solid_triangle.hpp"

namespace isostep {
namespace detail {

/// A solid's core over a triangle, in the solid's frame. Manifolds are in that frame, too.
template <class S> class SolidOverTriangle {
  using F = Finer<S>;
  using U = Unit<S>;

 public:
  ISO_INLINE SolidOverTriangle(const SolidView<S>& solid, const SurfaceTriangle<S>& triangle, Vec3<S> centre, S margin,
                               Manifold<S>& out)
      : solid_(solid),
        triangle_(triangle),
        centre_(centre),
        margin_(margin),
        tolerance_(axis_tolerance(solid.inner, max_abs(centre) + solid.inner)),
        lowest_(support(-triangle.normal)),
        out_(out) {}

  ISO_INLINE S height() const { return triangle_.height_of(lowest_); }
  /// Returns true if the triangle is beside the solid, or a neighbour makes the contact. Needs the triangle's edges.
  ISO_INLINE bool is_elsewhere() const {
    for (int k = 0; k < 3; ++k) {
      if (triangle_.inside_of(k, support(triangle_.edges[k].inward)) < -margin_) return true;
    }
    return is_of_neighbour();
  }
  ISO_INLINE void touch() const {
    if (is_over()) {
      if (!touch_plane()) touch_lowest();
      return;
    }
    const Transform<S> frame = here();
    const SolidView<S> other(kTriangleCalls<S>, &triangle_, S(0), solid_.inner, triangle_.points[0]);
    SolidGap<S> gap(solid_, other, frame, frame);
    gap.look(finer_of<Unit<F>>(-triangle_.normal));
    gap.climb(finer<F>(margin_), finer<F>(max(solid_.inner * S(1.0 / 16), tolerance_)));
    const S separation = coarser<S>(gap.best().separation);
    if (separation > margin_) return;
    const bool owned = owns(coarser_of<U>(gap.best().normal), tie());
    const bool by_plane = !owned || separation <= height() + tolerance_;
    if (by_plane && (touch_plane() || touch_lowest())) return;
    // Where the axis is the plane's, what is not over it touches nothing: the corners of a rim are inside of it.
    if (owned && separation > height() + tie())
      SolidTouch<S>(solid_, frame, other, frame, margin_, tolerance_, out_).touch(gap, allows());
  }

 private:
  static constexpr double kAlongEdge = 0.02;  // sine within which a direction is across an edge

  ISO_INLINE S tie() const { return depth_tie(tolerance_, S(0)); }  // [m]
  static ISO_INLINE Transform<S> here() { return {Vec3<S>::zero(), Mat3<U>::identity()}; }
  ISO_INLINE Vec3<S> support(Vec3<U> n) const { return coarser_of<S>(solid_.support(finer_of<Unit<F>>(n))); }
  ISO_INLINE bool is_over() const {
    for (int k = 0; k < 3; ++k) {
      if (triangle_.inside_of(k, lowest_) < S(0)) return false;
    }
    return true;
  }
  /// Returns true if the plane of a neighbour is better, with the centre on that plane's outer side.
  ISO_INLINE bool is_of_neighbour() const {
    for (int k = 0; k < 3; ++k) {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      if (!edge.touchable || !edge.has_neighbour) continue;
      if (dot(edge.other, centre_ - triangle_.points[k]) < S(0)) continue;
      if (dot(edge.other, support(-edge.other) - triangle_.points[k]) > height() + tolerance_) return true;
    }
    return false;
  }
  /// Returns true if the surface can be touched along n, from the solid, at its points nearest along n, to `tie` [m].
  ISO_INLINE bool owns(Vec3<U> n, S tie) const {
    S heights[3];
    for (int i = 0; i < 3; ++i) heights[i] = dot(n, triangle_.points[i]);
    const S most = min(heights[0], min(heights[1], heights[2])) + tie;
    for (int k = 0; k < 3; ++k) {
      const bool along = abs(dot(n, triangle_.edges[k].along)) <= U(kAlongEdge);
      const bool ends = heights[k] <= most || heights[(k + 1) % 3] <= most;
      if (along && ends && triangle_.owns_at_edge(k, -n)) return true;
      if (heights[k] <= most && triangle_.owns_at_point(k, -n)) return true;
    }
    return false;
  }
  /// Returns a filter for the normals of the solid's flat faces.
  ISO_INLINE auto allows() const {
    return [this](Vec3<U> n) ISO_INLINE_LAMBDA { return owns(n, tie()); };
  }

  ISO_INLINE RestPlane<S> plane() const {
    RestPlane<S> plane;
    plane.normal = triangle_.normal;
    plane.offset = triangle_.offset;
    plane.own = triangle_feature::kOfConvexAlone;
    plane.cut = 1u << 31;
    plane.count = 3;
    const S slack = triangle_.slack();
    for (int k = 0; k < 3; ++k) {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      plane.sides[k] = {-edge.inward, slack - dot(edge.inward, triangle_.points[k]), edge.flat};
    }
    return plane;
  }
  ISO_INLINE bool touch_plane() const { return SolidOverPlane<S>(solid_, here(), margin_, tie(), out_).touch(plane()); }
  /// Adds only the lowest point, if it is a little beyond an edge that is not flat: over a ridge it is over neither
  /// side.
  ISO_INLINE bool touch_lowest() const {
    for (int k = 0; k < 3; ++k) {
      const S beyond = -triangle_.inside_of(k, lowest_);
      if (beyond > tolerance_ * S(4) || (beyond > S(0) && triangle_.edges[k].flat)) return false;
    }
    SolidOverPlane<S>(solid_, here(), margin_, S(0), out_).touch_lowest(plane(), lowest_, height());
    return out_.count > 0;
  }

  const SolidView<S>& solid_;
  const SurfaceTriangle<S>& triangle_;
  const Vec3<S> centre_;        // [m]
  const S margin_, tolerance_;  // [m]
  const Vec3<S> lowest_;        // [m] over the triangle's plane
  Manifold<S>& out_;
};

}  // namespace detail

template <class S>
void collide_solid_triangle(ShapeView<S> a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                            const BakedTriangle& baked, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  if (triangle.height < S(0)) return;
  const SolidView<S> solid = solid_of(a);
  const SolidOverTriangle<S> pair(solid, triangle, frame.centre, margin + solid.radius, out);
  if (pair.height() > margin + solid.radius) return;
  triangle.find_edges(frame, baked);
  if (pair.is_elsewhere()) return;
  pair.touch();
  if (solid.radius > S(0)) grow_cores(out, solid.radius, S(0), margin);
  out.normal = ta.rotation * out.normal;
  for (int i = 0; i < out.count; ++i) out.points[i].position = to_world(ta, out.points[i].position);
}

}  // namespace isostep
