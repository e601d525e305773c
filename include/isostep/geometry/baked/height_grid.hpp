// HeightGrid: where the heights of a field lie. HeightPatch: new ones for a rectangle of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// The places of the heights. Column i is at x = i pitch, row k at z = k pitch, a height h at y = h 2^height_shift, all
/// in steps: one grid for all three, the one of meshes.
struct HeightGrid {
  std::uint32_t exponent;      // a step is 2^-exponent m
  std::uint32_t height_shift;  // a unit of height is 2^height_shift steps
  std::uint32_t columns, rows;
  std::uint32_t pitch;  // [steps] between columns, and between rows

  ISO_INLINE constexpr std::uint32_t cells_x() const { return columns - 1; }
  ISO_INLINE constexpr std::uint32_t cells_z() const { return rows - 1; }
  ISO_INLINE constexpr std::int64_t steps_of(std::int32_t height) const {
    return std::int64_t{height} * (1 << height_shift);
  }
  friend ISO_INLINE constexpr bool operator==(const HeightGrid& a, const HeightGrid& b) {
    return a.exponent == b.exponent && a.height_shift == b.height_shift && a.columns == b.columns && a.rows == b.rows &&
           a.pitch == b.pitch;
  }
  ISO_FIELDS(exponent, height_shift, columns, rows, pitch)
};

/// A rectangle of a field's places and its new heights: columns times rows of them, by rows; and the materials of the
/// cells between its places, (columns - 1) times (rows - 1), or none at all: they stay.
struct HeightPatch {
  std::uint32_t column, row;    // of its first place
  std::uint32_t columns, rows;  // places along each side
  std::span<const std::int16_t> heights;
  std::span<const std::uint8_t> materials = {};
};

}  // namespace isostep
