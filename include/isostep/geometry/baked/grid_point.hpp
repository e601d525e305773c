// GridPoint: a point of baked geometry, in whole steps of a power-of-two grid.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/scalar/wide_int.hpp"

namespace isostep {

/// Baked geometry is made of integers, so that every predicate is exact: all scalars and all machines get one topology.
struct GridPoint {
  /// [steps] The limit of a coordinate's magnitude, exclusive. An edge then has 20 bits and a sign, six times the
  /// volume of a tetrahedron 62.6 bits: a 64-bit integer holds it. Float and Q16.16 hold a coordinate.
  static constexpr std::int32_t kLimit = 1 << 19;

  std::int32_t x, y, z;

  ISO_FIELDS(x, y, z)

  friend ISO_INLINE constexpr bool operator==(GridPoint a, GridPoint b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  /// A number that ascends by x, then y, then z.
  ISO_INLINE constexpr std::uint64_t key() const {
    const auto digit = [](std::int32_t v) ISO_INLINE_LAMBDA { return static_cast<std::uint64_t>(v + kLimit); };
    return digit(x) << 40 | digit(y) << 20 | digit(z);
  }
};

/// [steps] A difference of points, or a product of two.
struct GridVector {
  std::int64_t x, y, z;

  friend ISO_INLINE constexpr GridVector cross(GridVector a, GridVector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend ISO_INLINE constexpr std::int64_t dot(GridVector a, GridVector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend ISO_INLINE constexpr bool operator==(GridVector a, GridVector b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};
/// The squared length: up to 2^83.6 of a face's normal.
ISO_INLINE constexpr Int128 squared_length(GridVector v) {
  return Int128(v.x) * v.x + Int128(v.y) * v.y + Int128(v.z) * v.z;
}
ISO_INLINE constexpr GridVector operator-(GridPoint a, GridPoint b) {
  return {static_cast<std::int64_t>(a.x) - b.x, static_cast<std::int64_t>(a.y) - b.y,
          static_cast<std::int64_t>(a.z) - b.z};
}

}  // namespace isostep
