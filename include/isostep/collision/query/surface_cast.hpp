// A solid that is cast along a line against the triangles of a mesh or height field.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/collision/narrowphase/surface_triangle.hpp"
#include "isostep/collision/query/solid_cast.hpp"
#include "isostep/geometry/baked/surface_queries.hpp"

namespace isostep::detail {

/// A cast in the solid's frame, in which triangles near the start have all their digits however large the surface is.
template <class S, class G> class SurfaceCast {
 public:
  ISO_INLINE SurfaceCast(const SolidCast<S>& cast, const G& surface, const Transform<S>& t)
      : cast_(cast),
        surface_(surface),
        way_(transposed_times(cast.start.rotation, cast.motion.translation)),
        long_way_(length(cast.motion.translation)),
        surface_way_(transposed_times(t.rotation, cast.motion.translation)),
        frame_(cast.start, middle_of(cast.core), t, surface.exponent()),
        test_(sweep_of(t), box_of_surface<G, S>(surface)) {
    for (const Vec3<S>& v : cast.core.vertices) extent_ = max(extent_, max_abs(v));
  }

  /// Runs the cast. Calls found(hit) -> Unit<S>, the latest fraction that is of interest from then on.
  template <class Found> ISO_INLINE void run(const Found& found) {
    const bool leaves = cast_.skip_inside && starts_inside();
    Unit<S> latest = cast_.motion.latest;
    visit(latest, [&](std::uint32_t id, const TriangleCorners& corners) ISO_INLINE_LAMBDA {
      SolidHit<S> hit;
      if (!meet(id, corners, latest, hit) || (leaves && hit.fraction == Unit<S>(0))) return true;
      const Unit<S> sooner = found(hit);
      if (sooner < latest) shorten(latest = sooner);
      return true;
    });
  }

 private:
  static ISO_INLINE Vec3<S> middle_of(const ConvexCore<S>& core) {
    const Unit<S> share = divide_to<Unit<S>>(S(1), S(static_cast<std::int32_t>(core.vertices.size())));
    Vec3<S> middle = Vec3<S>::zero();
    for (const Vec3<S>& v : core.vertices) middle += v * share;
    return middle;
  }
  /// Returns the sweep of the solid's box, in the surface's frame.
  ISO_INLINE Sweep<S> sweep_of(const Transform<S>& t) const {
    const Transform<S> placed = relative(t, cast_.start);
    Vec3<S> low = placed.rotation * cast_.core.vertices[0], high = low;
    for (const Vec3<S>& v : cast_.core.vertices) {
      const Vec3<S> p = placed.rotation * v;
      low = min(low, p);
      high = max(high, p);
    }
    const Vec3<S> half = (high - low) * S(0.5);
    const Aabb<S> box = box_of_surface<G, S>(surface_);
    const S distant = max_abs(placed.position) + long_way_ + max(max_abs(box.low), max_abs(box.high));
    const S more = cast_.core.radius + cast_margin(distant);
    return {placed.position + low + half, surface_way_, half + Vec3<S>{more, more, more}, Unit<S>(1)};
  }
  /// Calls visit(id, corners) -> bool for triangles that the solid's box sweeps over, as a rule in order along the way.
  template <class Visit> ISO_INLINE void visit(Unit<S> latest, const Visit& each) {
    const Vec3<Unit<S>> along = normalise(surface_way_);
    const GridVector order = {floor_scaled(along.x, 20), floor_scaled(along.y, 20), floor_scaled(along.z, 20)};
    shorten(latest);
    surface_.traverse(
        order, [&](const MeshBox& box) ISO_INLINE_LAMBDA { return touches(box); },
        [&](std::uint32_t id) ISO_INLINE_LAMBDA {
          const TriangleCorners corners = surface_.corners(id);
          return !touches(corners.bounds()) || each(id, corners);
        });
  }
  /// Returns true if it overlaps a triangle deeply: other triangles that it touches are then no obstacle either.
  ISO_INLINE bool starts_inside() {
    bool inside = false;
    visit(Unit<S>(0), [&](std::uint32_t id, const TriangleCorners& corners) ISO_INLINE_LAMBDA {
      SolidHit<S> hit;
      inside = meet(id, corners, Unit<S>(0), hit) && hit.inside;
      return !inside;
    });
    return inside;
  }
  ISO_INLINE void shorten(Unit<S> latest) {
    const Unit<S> later = latest + Unit<S>(0x1p-16);
    test_.shorten(min(later, cast_.motion.max_fraction));
  }
  ISO_INLINE bool touches(const MeshBox& box) const {
    Aabb<S> bounds;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = from_lattice<S>(box.low[axis], surface_.exponent());
      bounds.high[axis] = from_lattice<S>(box.high[axis], surface_.exponent());
    }
    return test_.touches(bounds);
  }

  /// The solid's height over a triangle's plane, and its motion against it.
  struct Approach {
    Vec3<Unit<S>> up;  // [1] of the side that it moves against
    S middle;          // [m] of the middle above it
    S gap;             // [m] of the solid's lowest point above it
    S fall;            // [m] against it, along the whole way
  };
  ISO_INLINE Approach approach_of(const SurfaceTriangle<S>& triangle) const {
    const S fall = -dot(triangle.normal, way_);
    const bool behind = fall < S(0);
    Approach a = {behind ? -triangle.normal : triangle.normal, behind ? -triangle.height : triangle.height, S(0),
                  behind ? -fall : fall};
    S lowest = dot(a.up, cast_.core.vertices[0]);
    for (const Vec3<S>& v : cast_.core.vertices) lowest = min(lowest, dot(a.up, v));
    a.gap = lowest - cast_.core.radius - (behind ? -triangle.offset : triangle.offset);
    return a;
  }
  /// Returns true if the plane alone decides a miss: the solid does not come down to it, or touches it and moves
  /// along.
  ISO_INLINE bool passes(const Approach& a, S nearby) const {
    const S fall = a.fall * cast_.motion.max_fraction, touch = max(cast_.motion.touch, nearby);
    if (a.gap > fall + nearby) return true;
    const S along = max(min(cast_.motion.touch, long_way_ * cast_.motion.max_fraction * S(0.00390625)), nearby);
    return a.gap <= nearby && a.gap >= -touch && fall <= along;
  }
  bool meet(std::uint32_t id, const TriangleCorners& corners, Unit<S> latest, SolidHit<S>& out) const {
    SurfaceTriangle<S> triangle(frame_, corners);
    const bool behind = -dot(triangle.normal, way_) < S(0);
    if (behind && !cast_.back_faces) return false;
    const Approach approach = approach_of(triangle);
    S distant = extent_;
    for (const Vec3<S>& p : triangle.points) distant = max(distant, max_abs(p));
    if (passes(approach, gap_noise(distant) * S(4))) return false;
    const Transform<S> here = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
    CastMotion<S> motion = cast_.motion;
    motion.translation = way_;
    motion.latest = latest;
    CastHit<S> hit;
    if (!cast_convex(cast_.core, here, {triangle.points, S(0)}, here, motion, hit)) return false;
    const BakedTriangle baked = surface_.triangle(id);
    if (hit.inside) {
      if (approach.middle < S(0)) return false;
      hit.normal = approach.up;
    } else if (!behind) {
      triangle.find_edges(frame_, baked);
      if (!is_clear(id, baked, triangle, hit)) hit.normal = triangle.normal;
    }
    out = {hit.fraction,
           cast_.start.rotation * hit.normal,
           to_world(cast_.start, hit.point),
           hit.inside,
           baked.material,
           id};
    return true;
  }
  /// Returns true if the normal found at an edge or corner is one of the surface there: the triangles around it lie
  /// below the plane across that normal. If they do not, the face was hit.
  ISO_INLINE bool is_clear(std::uint32_t id, const BakedTriangle& baked, const SurfaceTriangle<S>& triangle,
                           const CastHit<S>& hit) const {
    bool at[3];
    for (int k = 0; k < 3; ++k) at[k] = triangle.inside_of(k, hit.point) <= triangle.slack();
    for (int k = 0; k < 3; ++k) {
      if (at[k] && at[(k + 2) % 3]) return is_corner_clear(id, baked.points[k], hit.normal);
    }
    for (int k = 0; k < 3; ++k) {
      if (at[k] && !triangle.edges[k].touchable) return false;
    }
    return true;
  }
  ISO_INLINE bool is_corner_clear(std::uint32_t id, MeshPoint corner, Vec3<Unit<S>> normal) const {
    const Vec3<Unit<S>> up = transposed_times(frame_.turn, normal);
    for (int way = 1; way <= 2; ++way) {  // round the corner one way, and if there is a border, the other way
      std::uint32_t at = id;
      for (int steps = 0; steps < kMostSpokes; ++steps) {
        const TriangleCorners corners = surface_.corners(at);
        int i = 0;
        while (i < 2 && !(corners.points[i] == corner)) ++i;
        const MeshPoint spoke = corners.points[(i + way) % 3];
        if (dot(up, unit_of_steps<Unit<S>>(spoke - corner)) > Unit<S>(kLevel)) return false;
        at = surface_.neighbour(at, way == 1 ? i : (i + 2) % 3);
        if (at == id) return true;
        if (at == kNoTriangle) break;
      }
    }
    return true;
  }

  static constexpr int kMostSpokes = 64;
  static constexpr double kLevel = 0.002;  // [1] of a slope that rounding makes of none

  const SolidCast<S>& cast_;
  const G& surface_;
  Vec3<S> way_;          // [m] in the solid's frame
  S long_way_;           // [m]
  Vec3<S> surface_way_;  // [m] in the surface's frame
  SurfaceFrame<S> frame_;
  SweepTest<S> test_;
  S extent_ = S(0);  // [m] of the core
};

}  // namespace isostep::detail
