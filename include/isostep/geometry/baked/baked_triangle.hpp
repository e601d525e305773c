// BakedTriangle: a triangle of static geometry with its neighbours' far vertices; what meshes and height fields give.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

#include "isostep/geometry/baked/mesh_point.hpp"
#include "isostep/geometry/baked/surface_material.hpp"

namespace isostep {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// The bend of the surface at an edge of a triangle. It is the same seen from both triangles of the edge.
enum class EdgeKind : std::uint8_t {
  border,   // there is no neighbour
  flat,     // the neighbour goes on in the plane
  convex,   // the neighbour goes down, away from the outward side
  concave,  // the neighbour goes up
  fold      // the neighbour lies back on this triangle, in its plane: the rim of a sheet with two sides
};

/// The corners of a triangle, in steps of its geometry's grid. The outward side is where its points run
/// counter-clockwise.
struct TriangleCorners {
  MeshPoint points[3];

  /// [steps^2] The outward normal; its length is twice the area.
  ISO_INLINE constexpr GridVector normal() const { return cross(points[1] - points[0], points[2] - points[0]); }
  ISO_INLINE constexpr MeshBox bounds() const {
    MeshBox box = MeshBox::empty();
    for (const MeshPoint p : points) box.add(p);
    return box;
  }
};
/// A triangle with its neighbours' far vertices, the kinds of its edges and its material.
struct BakedTriangle : TriangleCorners {
  MeshPoint
      opposite[3];  // the neighbour's vertex off edge k, which leads from points[k] to the next; 0, 0, 0 at a border
  EdgeKind edges[3];
  std::uint8_t material;

  ISO_INLINE constexpr bool has_neighbour(int k) const { return edges[k] != EdgeKind::border; }
  /// [steps^2] The normal of the neighbour across edge k, which there is.
  ISO_INLINE constexpr GridVector neighbour_normal(int k) const {
    const MeshPoint at = points[(k + 1) % 3];
    return cross(points[k] - at, opposite[k] - at);
  }
};

/// The kind of the edge from a to b of the triangle a, b, c, whose neighbour b, a has the vertex `opposite`. Both have
/// an area.
ISO_INLINE constexpr EdgeKind edge_kind(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint opposite) {
  const GridVector normal = cross(b - a, c - a);
  const Int128 height = wide_dot(normal, opposite - a);
  if (height < Int128(0)) return EdgeKind::convex;
  if (height > Int128(0)) return EdgeKind::concave;
  return wide_dot(normal, cross(a - b, opposite - b)) < Int128(0) ? EdgeKind::fold : EdgeKind::flat;
}

namespace detail {
struct AnyOverlap {
  ISO_INLINE bool operator()(const MeshBox&) const { return true; }
};
struct AnyVisit {
  ISO_INLINE bool operator()(std::uint32_t) const { return true; }
};
}  // namespace detail

/// Triangles with ids 0 to triangle_count() - 1, not all of which need be there. Ghosts (kGhostMaterial) are neighbours
/// and have corners, but are not there otherwise: has_triangle is false, and neither query nor traverse visits them. So
/// a tile that has the first triangles of the next one as ghosts is as smooth at its rim as inside.
///
/// `query` calls visit(id) for every triangle whose own box touches the box. `traverse` descends where overlaps(box of
/// a node) is true and calls visit(id) for the triangles of the leaves it reaches, whose own boxes it does not look at;
/// `overlaps` is asked as late as possible, so it may become stricter while triangles are visited. Both end when visit
/// returns false, and then return false. Their order follows from the content of the geometry alone; with a way before
/// the others, `traverse` takes what lies first along it first, as a rule.
template <class G>
concept TriangleGeometry = requires(const G& geometry, const MeshBox& box, std::uint32_t id) {
  { geometry.exponent() } -> std::same_as<int>;  // a step is 2^-exponent m
  { geometry.triangle_count() } -> std::same_as<std::uint32_t>;
  { geometry.bounds() } -> std::same_as<MeshBox>;
  { geometry.has_triangle(id) } -> std::same_as<bool>;
  { geometry.neighbour(id, 0) } -> std::same_as<std::uint32_t>;  // across edge k, a ghost too, or kNoTriangle
  { geometry.corners(id) } -> std::same_as<TriangleCorners>;     // of triangle(id)
  { geometry.triangle(id) } -> std::same_as<BakedTriangle>;
  { geometry.material(id) } -> std::same_as<std::uint8_t>;                 // its number
  { geometry.table() } -> std::same_as<std::span<const SurfaceMaterial>>;  // see SurfaceMaterials
  { geometry.query(box, detail::AnyVisit{}) } -> std::same_as<bool>;
  { geometry.traverse(detail::AnyOverlap{}, detail::AnyVisit{}) } -> std::same_as<bool>;
  { geometry.traverse(GridVector{}, detail::AnyOverlap{}, detail::AnyVisit{}) } -> std::same_as<bool>;
};

}  // namespace isostep
