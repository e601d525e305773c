// BoxCells<S>: the corners of a box as whole numbers, by which grids, quad-trees and sorted lists place it.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "isostep/geometry/limits.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

/// The world within 4 position limits is divided into cubes of 2^-kFineness m, counted along each axis from 0; a cell
/// of level n is 2^n of them wide, and its number is theirs divided by 2^n, rounded down. What lies beyond is counted
/// as if it lay at the edge. So a number never falls where the coordinate rises, exactly and in every format: that is
/// all that structures rely on, and two boxes that overlap have numbers that do.
/// Counting starts where the binary digits of the world's origin are 0101...: the origin is at least a third of a cell
/// away from the borders of cells of every level, so what rests on a floor at height 0 lies across none of the coarse.
template <class S> struct BoxCells {
  static constexpr int kFineness = 8;
  /// Returns the level whose cells hold the whole world.
  static ISO_INLINE constexpr int top_level() { return exponent_above(edge()) + kFineness + 1; }

  std::uint64_t low[3], high[3];

  static ISO_INLINE constexpr BoxCells of(const Aabb<S>& box) {
    return {{number(box.low.x), number(box.low.y), number(box.low.z)},
            {number(box.high.x), number(box.high.y), number(box.high.z)}};
  }
  /// Returns the number of a cell of the finest level.
  static ISO_INLINE constexpr std::uint64_t number(S x) {
    const int top = top_level();
    const std::uint64_t origin = 0x5555555555555555u & ((std::uint64_t{1} << top) - 1u);
    return origin + static_cast<std::uint64_t>(floor_scaled(clamp(x, -edge(), edge()), kFineness));
  }
  /// Returns the least level whose cells are wider than the box: along each axis it lies in at most two of them.
  ISO_INLINE constexpr int size_class() const {
    std::uint64_t differing = 0;
    for (int axis = 0; axis < 3; ++axis) differing |= high[axis] - low[axis];
    return static_cast<int>(std::bit_width(differing));
  }

 private:
  /// [m] Numbers from the origin, with E = exponent_above(edge()) + kFineness, lie within 2^(E-1), and the origin,
  /// which has E + 1 digits 0101... or 1010..., between 2^(E-1) and 3 2^(E-1): sums are positive and below 2^(E+1).
  static ISO_INLINE constexpr S edge() { return Limits<S>::position() * S(4); }
};

}  // namespace isostep
