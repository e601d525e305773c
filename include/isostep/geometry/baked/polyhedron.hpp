// Polyhedron<S>: a convex solid of flat faces, as one scalar has it.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/core/array_view.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/convex_hull.hpp"
#include "isostep/math/columns.hpp"

namespace isostep {

/// The solid that the collision of polyhedra reads. Directions are rounded from exact integers, so short edges and
/// small faces have no worse ones than long and large do.
template <class S> struct Polyhedron {
  ColumnsView<S> vertices;          // [m]
  ArrayView<HalfEdge> half_edges;   // see ConvexHull
  ArrayView<std::uint8_t> faces;    // of each, its first half-edge
  ArrayView<std::uint8_t> spokes;   // of each vertex, one of the half-edges that leave it
  ColumnsView<Unit<S>> normals;     // [1] outward, of each face
  ArrayView<S> offsets;             // [m] of each face along its normal: of its vertex furthest out
  ColumnsView<Unit<S>> directions;  // [1] of half-edge 2 k, of each edge k
  S inner_radius;                   // [m] from the mean of the vertices to the nearest face

  ISO_INLINE std::uint32_t origin(std::uint32_t half_edge) const { return half_edges[half_edge].origin; }
  ISO_INLINE std::uint32_t edges() const { return directions.size(); }
  /// Calls triangle(i, j, k) with vertices, for a face as a fan about its lowest.
  template <class Triangle> ISO_INLINE void visit_fan(std::uint32_t face, const Triangle& triangle) const {
    const std::uint32_t first = faces[face];
    std::uint32_t edge = half_edges[first].next;
    for (std::uint32_t next = half_edges[edge].next; next != first; next = half_edges[next].next) {
      triangle(origin(first), origin(edge), origin(next));
      edge = next;
    }
  }
  /// Calls visit(half_edge) for all half-edges that leave a vertex, around it.
  template <class Visit> ISO_INLINE void visit_spokes(std::uint32_t vertex, const Visit& visit) const {
    const std::uint32_t first = spokes[vertex];
    std::uint32_t half_edge = first;
    do {
      visit(half_edge);
      half_edge = half_edges[half_edge ^ 1u].next;
    } while (half_edge != first);
  }
};

/// The memory behind the Polyhedron of a hull.
template <class S> class HullSolid {
 public:
  HullSolid() = default;  // of nothing
  /// `exponent`: a step of the hull's grid is 2^-exponent m, 0 to 16. Coordinates must fit S.
  HullSolid(const ConvexHull& hull, int exponent);

  /// The hull as a Polyhedron, valid as long as this is.
  ISO_INLINE Polyhedron<S> polyhedron() const {
    const ColumnsView<S> vertices = vertices_.view();
    const ColumnsView<Unit<S>> normals = normals_.view();
    const std::uint8_t* const spokes = starts_.data() + normals.size();
    return {vertices,
            half_edges_,
            {starts_.data(), normals.size()},
            {spokes, vertices.size()},
            normals,
            offsets_,
            directions_.view(),
            inner_radius_};
  }
  /// [bytes] The size of the memory that it points to.
  std::size_t memory() const;

 private:
  ColumnsArray<S> vertices_;
  std::vector<HalfEdge> half_edges_;
  std::vector<std::uint8_t> starts_;  // of the faces, then of the vertices
  ColumnsArray<Unit<S>> normals_;
  std::vector<S> offsets_;
  ColumnsArray<Unit<S>> directions_;
  S inner_radius_ = S(0);
};

#define ISO_HULL_SOLID_OF(extern, S) extern template class HullSolid<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HULL_SOLID_OF)

}  // namespace isostep
