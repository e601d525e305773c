// ConvexHull: the faces, edges and vertices of the convex hull of points on a grid.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/result.hpp"
#include "isostep/geometry/baked/grid_point.hpp"

namespace isostep {

/// Half-edges 2 k and 2 k + 1 are the two directions of edge k; the first leads from the lower vertex to the higher.
struct HalfEdge {
  std::uint8_t origin;  // vertex
  std::uint8_t next;    // half-edge of the same face, counter-clockwise seen from outside
  std::uint8_t face;

  friend ISO_INLINE constexpr bool operator==(HalfEdge a, HalfEdge b) {
    return a.origin == b.origin && a.next == b.next && a.face == b.face;
  }
};

/// A strictly convex hull: no three vertices of a face lie on a line, no two faces in a plane. It depends on the set of
/// points alone, not on their order, nor on points inside of it.
struct ConvexHull {
  static constexpr std::uint32_t kMaxVertices = 128, kMaxEdges = 128, kMaxFaces = 128;  // indices are bytes
  static constexpr std::int64_t kLeastThickness = 4;  // [steps] below it, rounding to the grid would shape the faces
  static constexpr std::int64_t kMostSlender = 1024;  // widths over thickness: beyond it, collisions lose their digits

  std::vector<GridPoint> vertices;   // ascending by GridPoint::key
  std::vector<HalfEdge> half_edges;  // edges ascend by their vertices
  std::vector<std::uint8_t> faces;   // of each, its half-edge that starts at its lowest vertex; ascending

  // These are what the compiler would make, but without weak functions in each of the files that hold hulls.
  ISO_INLINE ConvexHull() = default;
  ISO_INLINE ConvexHull(const ConvexHull&) = default;
  ISO_INLINE ConvexHull(ConvexHull&&) = default;
  ISO_INLINE ConvexHull& operator=(const ConvexHull&) = default;
  ISO_INLINE ConvexHull& operator=(ConvexHull&&) = default;
  ISO_INLINE ~ConvexHull() = default;

  ISO_INLINE std::uint8_t destination(std::uint8_t half_edge) const { return half_edges[half_edge ^ 1u].origin; }
  /// [steps^2] The outward normal of one face; its length says nothing.
  GridVector normal(std::uint8_t face) const;
};

/// Runs quickhull (Barber, Dobkin and Huhdanpaa 1996) in exact integers. Errors, whose place is "points":
/// ErrorCode::invalid for a coordinate not below GridPoint::kLimit and for points that are one, on a line or flat;
/// ErrorCode::limit for more vertices, edges or faces than there may be, with the count.
Result<ConvexHull> convex_hull(std::span<const GridPoint> points);

/// Chooses at most `count` of the points, at least 4, ascending: those that reach furthest beyond the ones before. The
/// caller judges the part that they leave out of the hull. Errors are those of convex_hull().
Result<std::vector<GridPoint>> simplified(std::span<const GridPoint> points, std::uint32_t count);

}  // namespace isostep
