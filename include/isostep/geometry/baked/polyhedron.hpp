// Polyhedron<S>: a convex solid of flat faces, as one scalar has it.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/core/array_view.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/convex_hull.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// A set of edges.
struct EdgeSet {
  std::uint64_t words[2];

  static ISO_INLINE constexpr EdgeSet none() { return {{0, 0}}; }
  static ISO_INLINE constexpr EdgeSet first(std::uint32_t count) {
    const auto word = [](std::uint32_t n) ISO_INLINE_LAMBDA {
      return n >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1;
    };
    return {{word(count), count > 64 ? word(count - 64) : 0}};
  }
  /// Of up to 32 edges from k on, none across a word's end.
  ISO_INLINE constexpr void insert(std::uint32_t k, std::uint32_t bits) {
    words[k / 64] |= std::uint64_t{bits} << k % 64;
  }
  ISO_INLINE constexpr std::uint32_t bits(std::uint32_t k) const {
    return static_cast<std::uint32_t>(words[k / 64] >> k % 64);
  }

  friend ISO_INLINE constexpr EdgeSet operator&(EdgeSet a, EdgeSet b) {
    return {{a.words[0] & b.words[0], a.words[1] & b.words[1]}};
  }
};

/// What the collision of polyhedra reads. Directions are rounded from exact integers, so short edges and small faces
/// have no worse ones than long and large do.
template <class S> struct Polyhedron {
  ArrayView<Vec3<S>> vertices;          // [m]
  ArrayView<HalfEdge> half_edges;       // see ConvexHull
  ArrayView<std::uint8_t> faces;        // of each, its first half-edge
  ArrayView<Vec3<Unit<S>>> normals;     // [1] outward, of each face
  ArrayView<S> offsets;                 // [m] of each face along its normal: of its vertex furthest out
  ArrayView<Vec3<Unit<S>>> directions;  // [1] of half-edge 2 k, of each edge k
  S inner_radius;                       // [m] from the mean of the vertices to the nearest face

  ISO_INLINE std::uint32_t origin(std::uint32_t half_edge) const { return half_edges[half_edge].origin; }
  ISO_INLINE std::uint32_t edges() const { return directions.size(); }
};

/// A hull in a scalar: the memory that its Polyhedron shows.
template <class S> class HullSolid {
 public:
  HullSolid() = default;  // of nothing
  /// `exponent`: a step of the hull's grid is 2^-exponent m, 0 to 16. Coordinates must fit S.
  HullSolid(const ConvexHull& hull, int exponent);

  /// Valid as long as this is.
  ISO_INLINE Polyhedron<S> polyhedron() const {
    return {vertices_, half_edges_, faces_, normals_, offsets_, directions_, inner_radius_};
  }

 private:
  std::vector<Vec3<S>> vertices_;
  std::vector<HalfEdge> half_edges_;
  std::vector<std::uint8_t> faces_;
  std::vector<Vec3<Unit<S>>> normals_;
  std::vector<S> offsets_;
  std::vector<Vec3<Unit<S>>> directions_;
  S inner_radius_ = S(0);
};

#define ISO_EXTERN(S) extern template class HullSolid<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
