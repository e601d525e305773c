// TriangleMesh: a static surface of triangles on a grid, with their neighbours and a tree over them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/result.hpp"
#include "isostep/geometry/baked/baked_triangle.hpp"
#include "isostep/geometry/baked/mesh_tree.hpp"

namespace isostep {

/// Points of a triangle, counter-clockwise seen from its outward side.
struct MeshTriangle {
  std::uint32_t vertices[3];

  friend ISO_INLINE constexpr bool operator==(const MeshTriangle& a, const MeshTriangle& b) {
    return a.vertices[0] == b.vertices[0] && a.vertices[1] == b.vertices[1] && a.vertices[2] == b.vertices[2];
  }
  ISO_FIELDS(vertices)
};

/// The triangle across an edge of another, and the kind of the edge.
class MeshEdge {
 public:
  ISO_INLINE constexpr MeshEdge() : bits_(0) {}
  ISO_INLINE constexpr MeshEdge(std::uint32_t triangle, std::uint32_t edge, EdgeKind kind)
      : bits_(triangle << 5 | edge << 3 | static_cast<std::uint32_t>(kind)) {}

  ISO_INLINE constexpr EdgeKind kind() const { return static_cast<EdgeKind>(bits_ & 7u); }
  /// The neighbour, or kNoTriangle.
  ISO_INLINE constexpr std::uint32_t triangle() const { return kind() == EdgeKind::border ? kNoTriangle : bits_ >> 5; }
  /// The number of the edge in the neighbour.
  ISO_INLINE constexpr std::uint32_t edge() const { return bits_ >> 3 & 3u; }

 private:
  std::uint32_t bits_;
};
struct MeshEdges {
  MeshEdge edges[3];
};

/// An immutable surface. A triangle's id is its place in the builder's input, and its first vertex stays the first.
/// Points are kept once each, in the order in which the triangles first name them: so neither equal points, nor points
/// without a triangle, nor the order of points make another mesh.
class TriangleMesh {
 public:
  static constexpr int kMaxExponent = 16;
  static constexpr std::uint32_t kMaxTriangles = MeshTree::kMaxTriangles, kMaxPoints = 3 * kMaxTriangles;

  // These are what the compiler would make, but without weak functions in the files that hold meshes.
  ISO_INLINE TriangleMesh(const TriangleMesh&) = default;
  ISO_INLINE TriangleMesh(TriangleMesh&&) = default;
  ISO_INLINE TriangleMesh& operator=(const TriangleMesh&) = default;
  ISO_INLINE TriangleMesh& operator=(TriangleMesh&&) = default;
  ISO_INLINE ~TriangleMesh() = default;

  /// A step is 2^-exponent m.
  ISO_INLINE int exponent() const { return exponent_; }
  ISO_INLINE std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangles_.size()); }
  ISO_INLINE std::span<const MeshPoint> points() const { return points_; }
  ISO_INLINE std::span<const MeshTriangle> triangles() const { return triangles_; }
  ISO_INLINE std::span<const std::uint8_t> materials() const { return materials_; }
  ISO_INLINE std::uint8_t material(std::uint32_t id) const { return materials_[id]; }
  ISO_INLINE std::span<const SurfaceMaterial> table() const { return table_; }
  ISO_INLINE const MeshTree& tree() const { return tree_; }
  ISO_INLINE MeshBox bounds() const { return tree_.bounds(); }

  /// The edge k, from vertex k to the one after it, and what is across.
  ISO_INLINE MeshEdge edge(std::uint32_t triangle, int k) const { return edges_[triangle].edges[k]; }
  ISO_INLINE std::uint32_t neighbour(std::uint32_t triangle, int k) const { return edge(triangle, k).triangle(); }
  ISO_INLINE bool has_triangle(std::uint32_t id) const {
    return id < triangles_.size() && materials_[id] != kGhostMaterial;
  }
  ISO_INLINE TriangleCorners corners(std::uint32_t id) const {
    const std::uint32_t(&of)[3] = triangles_[id].vertices;
    return {{points_[of[0]], points_[of[1]], points_[of[2]]}};
  }
  BakedTriangle triangle(std::uint32_t id) const;

  /// See TriangleGeometry.
  template <class Visit> ISO_INLINE bool query(const MeshBox& box, Visit&& visit) const {
    const MeshPoint low = clamped(box.low), high = clamped(box.high);
    return tree_.query(box, [&](std::uint32_t id) ISO_INLINE_LAMBDA { return !touches(id, low, high) || visit(id); });
  }
  template <class Overlaps, class Visit> ISO_INLINE bool traverse(Overlaps&& overlaps, Visit&& visit) const {
    return tree_.traverse(overlaps, visit);
  }
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse(GridVector way, Overlaps&& overlaps, Visit&& visit) const {
    return tree_.traverse(way, overlaps, visit);
  }

  /// [bytes] The size of this object and all it holds.
  std::size_t memory() const;
  /// The canonical content, little-endian: exponent u32; count u32 and points i32 x 3; count u32 and vertices u32 x 3;
  /// materials u8; if there is a table, its count u32 and u16 x 2 each. All else follows from it.
  std::vector<std::uint8_t> bytes() const;

 private:
  friend Result<TriangleMesh> triangle_mesh(std::span<const MeshPoint>, std::span<const MeshTriangle>,
                                            const SurfaceMaterials&, int);
  ISO_INLINE TriangleMesh() = default;

  /// Clamps a coordinate to the range of points; beyond it nothing changes.
  static ISO_INLINE std::int32_t clamped(std::int64_t v) {
    constexpr std::int32_t kLimit = MeshPoint::kLimit;
    return v < -kLimit ? -kLimit : v > kLimit ? kLimit : static_cast<std::int32_t>(v);
  }
  static ISO_INLINE MeshPoint clamped(const std::int64_t (&at)[3]) {
    return {clamped(at[0]), clamped(at[1]), clamped(at[2])};
  }
  /// Returns true if the box of the triangle has a point between the two.
  ISO_INLINE bool touches(std::uint32_t id, MeshPoint low, MeshPoint high) const {
    const MeshTriangle& triangle = triangles_[id];
    const MeshPoint a = points_[triangle.vertices[0]], b = points_[triangle.vertices[1]],
                    c = points_[triangle.vertices[2]];
    const std::uint32_t apart = is_apart(a.x, b.x, c.x, low.x, high.x) | is_apart(a.y, b.y, c.y, low.y, high.y) |
                                is_apart(a.z, b.z, c.z, low.z, high.z);
    return apart == 0;
  }
  /// Returns 1 if the triangle's box is beyond the range on this axis, else 0. It has no branches: it is as good as
  /// random which triangles of a leaf touch.
  static ISO_INLINE std::uint32_t is_apart(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t low,
                                           std::int32_t high) {
    const std::int32_t least = a < b ? a : b, most = a < b ? b : a;
    const bool above = (least < c ? least : c) > high, below = (most > c ? most : c) < low;
    return std::uint32_t{above} | std::uint32_t{below};
  }

  int exponent_ = 0;
  std::vector<MeshPoint> points_;
  std::vector<MeshTriangle> triangles_;
  std::vector<std::uint8_t> materials_;
  std::vector<SurfaceMaterial> table_;
  std::vector<MeshEdges> edges_;
  MeshTree tree_;  // of what is no ghost
};

/// Builds a mesh. Points with equal coordinates become one, points without a triangle are dropped. Borders may be open.
/// ErrorCode::invalid: "exponent" above 16; "materials" of another count, or all ghosts; at "table[i]" a material out
/// of range; "triangles" that are none; at "points[i]" a coordinate out of range; at "triangles[i]" a vertex that is no
/// point, a triangle without area (exactly), one that is there already, more than two triangles at an edge, two that
/// run along an edge in the same direction.
/// ErrorCode::limit: more "points" or "triangles" than there may be, or a longer "table".
Result<TriangleMesh> triangle_mesh(std::span<const MeshPoint> points, std::span<const MeshTriangle> triangles,
                                   const SurfaceMaterials& materials, int exponent);

/// Reads what `bytes` gave, from bytes nobody vouches for. It accepts nothing else: one content, one form.
Result<TriangleMesh> read_triangle_mesh(Bytes bytes);

}  // namespace isostep
