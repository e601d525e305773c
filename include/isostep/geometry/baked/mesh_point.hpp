// MeshPoint and MeshBox: places on the grid of static geometry, in whole steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/baked/grid_point.hpp"

namespace isostep {

/// A level is larger than a hull, so its grid is wider than that of GridPoint. Predicates are still exact, in 128 bits.
struct MeshPoint {
  /// [steps] The limit of a coordinate's magnitude, exclusive: float holds it. An edge has 24 bits and a sign, a
  /// component of the normal of a triangle 49, six times the volume of a tetrahedron 75.
  static constexpr std::int32_t kLimit = 1 << 23;

  std::int32_t x, y, z;

  friend ISO_INLINE constexpr bool operator==(MeshPoint a, MeshPoint b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  friend ISO_INLINE constexpr GridVector operator-(MeshPoint a, MeshPoint b) {
    return {static_cast<std::int64_t>(a.x) - b.x, static_cast<std::int64_t>(a.y) - b.y,
            static_cast<std::int64_t>(a.z) - b.z};
  }
  ISO_INLINE constexpr bool in_range() const { return in_range(x) && in_range(y) && in_range(z); }

  ISO_FIELDS(x, y, z)

 private:
  static ISO_INLINE constexpr bool in_range(std::int32_t v) { return -kLimit < v && v < kLimit; }
};

/// [steps] A closed box: it holds its faces. Components are x, y, z.
struct MeshBox {
  std::int64_t low[3], high[3];

  /// A box that holds nothing; the first point added to it becomes the box.
  static ISO_INLINE constexpr MeshBox empty() {
    return {{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  }
  ISO_INLINE constexpr void add(MeshPoint p) {
    const std::int64_t at[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] < low[axis]) low[axis] = at[axis];
      if (at[axis] > high[axis]) high[axis] = at[axis];
    }
  }
  ISO_INLINE constexpr bool touches(const MeshBox& other) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] > other.high[axis] || high[axis] < other.low[axis]) return false;
    }
    return true;
  }
};

/// Returns the dot product, which 64 bits may not hold.
ISO_INLINE constexpr Int128 wide_dot(GridVector a, GridVector b) {
  return Int128(a.x) * b.x + Int128(a.y) * b.y + Int128(a.z) * b.z;
}

}  // namespace isostep
