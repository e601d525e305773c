// BoxSolid<S>: a box as a Polyhedron, for its pairs with hulls.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/polyhedron.hpp"

namespace isostep {

namespace detail {
/// What convex_hull makes of eight corners: vertex 4 x + 2 y + z, where x, y, z are 1 on the positive sides.
inline constexpr HalfEdge kBoxHalfEdges[24] = {{0, 6, 0},  {1, 4, 2},  {0, 12, 1}, {2, 0, 0},  {0, 16, 2}, {4, 2, 1},
                                               {1, 11, 0}, {3, 8, 3},  {1, 20, 3}, {5, 1, 2},  {2, 14, 4}, {3, 3, 0},
                                               {2, 19, 1}, {6, 10, 4}, {3, 23, 4}, {7, 7, 3},  {4, 9, 2},  {5, 18, 5},
                                               {4, 22, 5}, {6, 5, 1},  {5, 15, 3}, {7, 17, 5}, {6, 21, 5}, {7, 13, 4}};
inline constexpr std::uint8_t kBoxFaces[6] = {0, 2, 4, 8, 10, 18};
inline constexpr std::int8_t kBoxFaceAxes[6] = {0, 2, 1, 2, 1, 0};
inline constexpr bool kBoxFaceIsPositive[6] = {false, false, false, true, true, true};
inline constexpr std::int8_t kBoxEdgeAxes[12] = {2, 1, 0, 1, 0, 2, 0, 0, 2, 1, 1, 2};
}  // namespace detail

template <class S> class BoxSolid {
 public:
  ISO_INLINE explicit BoxSolid(Vec3<S> half) : inner_radius_(min(half.x, min(half.y, half.z))) {
    using U = Unit<S>;
    for (int corner = 0; corner < 8; ++corner) {
      vertices_[corner] = {(corner & 4) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                           (corner & 1) != 0 ? half.z : -half.z};
    }
    for (int f = 0; f < 6; ++f) {
      normals_[f] = Vec3<U>::zero();
      normals_[f][detail::kBoxFaceAxes[f]] = detail::kBoxFaceIsPositive[f] ? U(1) : U(-1);
      offsets_[f] = half[detail::kBoxFaceAxes[f]];
    }
    for (int k = 0; k < 12; ++k) {
      directions_[k] = Vec3<U>::zero();
      directions_[k][detail::kBoxEdgeAxes[k]] = U(1);
    }
  }

  /// Valid as long as this is.
  ISO_INLINE Polyhedron<S> polyhedron() const {
    return {vertices_, detail::kBoxHalfEdges, detail::kBoxFaces, normals_, offsets_, directions_, inner_radius_};
  }

 private:
  Vec3<S> vertices_[8];
  Vec3<Unit<S>> normals_[6];
  S offsets_[6];
  Vec3<Unit<S>> directions_[12];
  S inner_radius_;
};

}  // namespace isostep
