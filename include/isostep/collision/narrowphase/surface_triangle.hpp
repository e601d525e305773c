// SurfaceTriangle<S>: a triangle of a mesh or height field as the convex beside it sees it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/baked_triangle.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/closest.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

/// The pose of a convex relative to a surface. The convex's centre is subtracted on the surface's grid, exactly: a
/// small body far out on a large mesh loses no digit.
template <class S> struct SurfaceFrame {
  int exponent;           // a step of the grid is 2^-exponent m
  std::int64_t steps[3];  // the convex's centre on the grid, rounded down
  Vec3<S> rest;           // [m] from there to the centre, in the surface's frame
  Vec3<S> centre;         // [m] in the convex's frame
  Mat3<Unit<S>> turn;     // from the surface's frame to the convex's

  ISO_INLINE SurfaceFrame(const Transform<S>& convex, Vec3<S> centre_in_convex, const Transform<S>& surface,
                          int surface_exponent)
      : exponent(surface_exponent), centre(centre_in_convex), turn(transpose(convex.rotation) * surface.rotation) {
    const Vec3<S> at = to_local(surface, to_world(convex, centre));
    for (int axis = 0; axis < 3; ++axis) {
      steps[axis] = floor_scaled(at[axis], exponent);
      rest[axis] = at[axis] - from_lattice<S>(steps[axis], exponent);
    }
  }
  /// [m] Returns the vector from the convex's centre to p, in the surface's axes.
  ISO_INLINE Vec3<S> beside(MeshPoint p) const {
    return Vec3<S>{from_lattice<S>(p.x - steps[0], exponent), from_lattice<S>(p.y - steps[1], exponent),
                   from_lattice<S>(p.z - steps[2], exponent)} -
           rest;
  }
};

/// An edge of a SurfaceTriangle, in the convex's frame. Its arc on the Gauss map leads from the triangle's normal to
/// `other`.
template <class S> struct SurfaceEdge {
  Vec3<Unit<S>> along;   // [1] from its point to the next one
  Vec3<Unit<S>> inward;  // [1] in the plane, into the triangle
  Vec3<Unit<S>> other;   // [1] normal of the neighbour; outward, in the plane, where there is none
  Vec3<Unit<S>> away;    // [1] in the neighbour's plane, into it; against the normal where there is none
  S length;              // [m]
  bool touchable;        // convex, or without neighbour: else the arc is empty, and `other` and `away` hold nothing
  bool has_neighbour;    // of one that is touchable
  bool flat;             // the neighbour goes on in the plane
};

/// A triangle of a surface in the frame of the convex.
template <class S> struct SurfaceTriangle {
  Vec3<S> points[3];     // [m]
  Vec3<Unit<S>> normal;  // [1] outward
  S offset;              // [m] of its plane along the normal
  S height;              // [m] of the convex's centre above it
  SurfaceEdge<S> edges[3];

  /// Leaves out the edges: most triangles are ruled out before they are needed.
  ISO_INLINE SurfaceTriangle(const SurfaceFrame<S>& frame, const TriangleCorners& baked) {
    Vec3<S> nearest = frame.beside(baked.points[0]);
    points[0] = frame.centre + frame.turn * nearest;
    for (int i = 1; i < 3; ++i) {
      const Vec3<S> p = frame.beside(baked.points[i]);
      points[i] = frame.centre + frame.turn * p;
      if (max_abs(p) < max_abs(nearest)) nearest = p;
    }
    const Vec3<Unit<S>> up = detail::unit_of_steps<Unit<S>>(baked.normal());
    normal = frame.turn * up;
    height = -dot(up, nearest);
    offset = dot(normal, frame.centre) - height;
  }
  ISO_INLINE void find_edges(const SurfaceFrame<S>& frame, const BakedTriangle& baked) {
    for (int k = 0; k < 3; ++k) {
      SurfaceEdge<S>& edge = edges[k];
      const GridVector way = baked.points[(k + 1) % 3] - baked.points[k];
      edge.along = frame.turn * detail::unit_of_steps<Unit<S>>(way);
      edge.inward = cross(normal, edge.along);
      edge.length = dot(edge.along, points[(k + 1) % 3] - points[k]);
      edge.flat = baked.edges[k] == EdgeKind::flat;
      edge.has_neighbour = baked.edges[k] == EdgeKind::convex;
      edge.touchable = edge.has_neighbour || baked.edges[k] == EdgeKind::border || baked.edges[k] == EdgeKind::fold;
      if (edge.has_neighbour) {
        edge.other = frame.turn * detail::unit_of_steps<Unit<S>>(baked.neighbour_normal(k));
        edge.away = cross(edge.along, edge.other);
      } else if (edge.touchable) {
        edge.other = -edge.inward;
        edge.away = -normal;
      }
    }
  }
  ISO_INLINE S height_of(Vec3<S> p) const { return dot(normal, p) - offset; }
  /// [m] Returns the distance of p from edge k, positive on the inner side.
  ISO_INLINE S inside_of(int k, Vec3<S> p) const { return dot(edges[k].inward, p - points[k]); }
  /// [m] Returns the distance beyond an edge that may be rounding alone. Both neighbours count it as theirs: nothing
  /// falls between them.
  ISO_INLINE S slack() const {
    const S reach = max(max_abs(points[0]), max(max_abs(points[1]), max_abs(points[2])));
    return detail::gap_noise(reach) + detail::gap_noise(reach);
  }

  /// Returns true if a direction looks out of the surface at edge k: within the arc, to kAcross. Beyond the arc the
  /// neighbour makes the contact.
  ISO_INLINE bool owns_at_edge(int k, Vec3<Unit<S>> direction) const {
    const SurfaceEdge<S>& edge = edges[k];
    return edge.touchable && dot(direction, edge.away) <= Unit<S>(kAcross) &&
           dot(direction, edge.inward) <= Unit<S>(kAcross);
  }
  /// Returns true if a direction from edge k leads under both planes that meet there, by more than kAcross. A point in
  /// the plane of one of them may be beyond that one's far edge, outside everything.
  ISO_INLINE bool is_under_edge(int k, Vec3<Unit<S>> direction) const {
    return dot(direction, normal) < Unit<S>(-kAcross) && dot(direction, edges[k].other) < Unit<S>(-kAcross);
  }
  /// Returns true if a direction at point i is not beyond either of the neighbours that meet there.
  ISO_INLINE bool owns_at_point(int i, Vec3<Unit<S>> direction) const {
    return is_short_of(i, direction) && is_short_of((i + 2) % 3, direction);
  }

 private:
  static constexpr double kAcross = 0.002;  // [rad] of directions, whose rounding is less

  ISO_INLINE bool is_short_of(int k, Vec3<Unit<S>> direction) const {
    const SurfaceEdge<S>& edge = edges[k];
    if (edge.touchable) return dot(direction, edge.away) <= Unit<S>(kAcross);
    return dot(direction, edge.inward) >= Unit<S>(0);
  }
};

/// Bits of the features of contacts with triangles.
namespace triangle_feature {
/// Names a feature of the convex and none of the triangle: it is the same on the next triangle, so impulses go with it.
inline constexpr std::uint32_t kOfConvexAlone = 1u << 28;
}  // namespace triangle_feature

}  // namespace isostep
