// BoxSolid<S>: a box as a Polyhedron, for its pairs with hulls.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/polyhedron.hpp"

namespace isostep {

namespace detail {
/// The half-edges that convex_hull makes of eight corners: vertex 4 x + 2 y + z, where x, y, z are 1 on the positive
/// sides.
inline constexpr HalfEdge kBoxHalfEdges[24] = {{0, 6, 0},  {1, 4, 2},  {0, 12, 1}, {2, 0, 0},  {0, 16, 2}, {4, 2, 1},
                                               {1, 11, 0}, {3, 8, 3},  {1, 20, 3}, {5, 1, 2},  {2, 14, 4}, {3, 3, 0},
                                               {2, 19, 1}, {6, 10, 4}, {3, 23, 4}, {7, 7, 3},  {4, 9, 2},  {5, 18, 5},
                                               {4, 22, 5}, {6, 5, 1},  {5, 15, 3}, {7, 17, 5}, {6, 21, 5}, {7, 13, 4}};
inline constexpr std::uint8_t kBoxFaces[6] = {0, 2, 4, 8, 10, 18};
inline constexpr std::uint8_t kBoxSpokes[8] = {0, 1, 3, 7, 5, 9, 13, 15};
inline constexpr std::int8_t kBoxFaceAxes[6] = {0, 2, 1, 2, 1, 0};
inline constexpr bool kBoxFaceIsPositive[6] = {false, false, false, true, true, true};
inline constexpr std::int8_t kBoxEdgeAxes[12] = {2, 1, 0, 1, 0, 2, 0, 0, 2, 1, 1, 2};

template <class U> constexpr Vec3<U> axis_of(int axis, bool positive) {
  const U length = positive ? U(1) : U(-1), none = U(0);
  return {axis == 0 ? length : none, axis == 1 ? length : none, axis == 2 ? length : none};
}
template <class U> constexpr Columns<U, 16> box_normals() {
  Columns<U, 16> normals;
  for (std::uint32_t f = 0; f < 6; ++f) normals.set(f, axis_of<U>(kBoxFaceAxes[f], kBoxFaceIsPositive[f]));
  normals.template pad<16>(6);
  return normals;
}
template <class U> constexpr Columns<U, 16> box_directions() {
  Columns<U, 16> directions;
  for (std::uint32_t k = 0; k < 12; ++k) directions.set(k, axis_of<U>(kBoxEdgeAxes[k], true));
  directions.template pad<16>(12);
  return directions;
}
template <class U> inline constexpr Columns<U, 16> kBoxNormals = box_normals<U>();
template <class U> inline constexpr Columns<U, 16> kBoxDirections = box_directions<U>();
}  // namespace detail

template <class S> class BoxSolid {
 public:
  ISO_INLINE explicit BoxSolid(Vec3<S> half) : inner_radius_(min(half.x, min(half.y, half.z))) {
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      vertices_.set(corner, {(corner & 4u) != 0 ? half.x : -half.x, (corner & 2u) != 0 ? half.y : -half.y,
                             (corner & 1u) != 0 ? half.z : -half.z});
    }
    vertices_.template pad<16>(8);
    for (int f = 0; f < 6; ++f) offsets_[f] = half[detail::kBoxFaceAxes[f]];
  }

  /// The box as a Polyhedron, valid as long as this is.
  ISO_INLINE Polyhedron<S> polyhedron() const {
    using U = Unit<S>;
    return {{&vertices_, 8},
            detail::kBoxHalfEdges,
            detail::kBoxFaces,
            detail::kBoxSpokes,
            {&detail::kBoxNormals<U>, 6},
            offsets_,
            {&detail::kBoxDirections<U>, 12},
            inner_radius_};
  }

 private:
  Columns<S, 16> vertices_;
  S offsets_[6];
  S inner_radius_;
};

}  // namespace isostep
