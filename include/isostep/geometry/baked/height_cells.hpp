// HeightCells: the cells of a height field one by one: what their corners and triangles span.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/geometry/baked/height_grid.hpp"
#include "isostep/geometry/baked/mesh_point.hpp"
#include "isostep/geometry/baked/surface_material.hpp"

namespace isostep {

/// The range of heights of cells, both ends included. An empty range has low above high.
struct HeightSpan {
  std::int16_t low = INT16_MAX, high = INT16_MIN;

  ISO_INLINE bool is_empty() const { return low > high; }
};
/// A rectangle of cells, x and z, both ends included.
struct CellRange {
  std::uint32_t low[2], high[2];
};
/// A rectangle of cells from one height to another, both included.
struct CellBox : CellRange {
  std::int32_t low_height, high_height;

  ISO_INLINE bool misses(HeightSpan span) const {
    return span.is_empty() || span.low > high_height || span.high < low_height;
  }
  /// Returns true if it meets a triangle with that corner, whose two other vertices have heights in least..greatest.
  ISO_INLINE bool meets(std::int32_t least, std::int32_t greatest, std::int32_t corner) const {
    return (least <= high_height || corner <= high_height) && (greatest >= low_height || corner >= low_height);
  }
};

/// A view of the data of a field. Input: the numbers of cells. Output: points, boxes and triangles, by their ids.
struct HeightCells {
  const HeightGrid& grid;
  const std::int16_t* heights;    // by rows
  const std::uint8_t* materials;  // by cells

  /// Returns true if the cell is neither a hole nor a ghost.
  ISO_INLINE bool is_solid(std::size_t cell) const { return materials[cell] < kGhostMaterial; }
  ISO_INLINE std::int32_t height(std::uint32_t i, std::uint32_t k) const {
    return heights[static_cast<std::size_t>(k) * grid.columns + i];
  }
  ISO_INLINE MeshPoint point(std::uint32_t i, std::uint32_t k) const {
    return {static_cast<std::int32_t>(i * grid.pitch), height(i, k) * (1 << grid.height_shift),
            static_cast<std::int32_t>(k * grid.pitch)};
  }
  ISO_INLINE void add_cell(HeightSpan& span, std::uint32_t i, std::uint32_t k) const {
    const std::int16_t* const row = heights + static_cast<std::size_t>(k) * grid.columns + i;
    const std::int16_t* const next = row + grid.columns;
    for (const std::int16_t h : {row[0], row[1], next[0], next[1]}) {
      if (h < span.low) span.low = h;
      if (h > span.high) span.high = h;
    }
  }
  ISO_INLINE MeshBox box_of(const CellRange& cells, HeightSpan span) const {
    const std::int64_t pitch = grid.pitch;
    return {{pitch * cells.low[0], grid.steps_of(span.low), pitch * cells.low[1]},
            {pitch * (cells.high[0] + 1), grid.steps_of(span.high), pitch * (cells.high[1] + 1)}};
  }
  /// Calls visit(id) for the triangles of a cell that the box meets, until it returns false.
  template <class Visit>
  ISO_INLINE bool visit_cell(std::uint32_t i, std::uint32_t k, const CellBox& box, Visit&& visit) const {
    const std::uint32_t cell = k * grid.cells_x() + i;
    if (!is_solid(cell)) return true;
    const std::int32_t a = height(i + 1, k), b = height(i, k + 1);
    const std::int32_t low = a < b ? a : b, high = a < b ? b : a;
    if (box.meets(low, high, height(i, k)) && !visit(2 * cell)) return false;
    return !box.meets(low, high, height(i + 1, k + 1)) || visit(2 * cell + 1);
  }
  /// Calls visit(id) for both triangles of each cell whose box overlaps() accepts, until it returns false.
  template <class Overlaps, class Visit>
  ISO_INLINE bool visit_cells(const CellRange& cells, Overlaps&& overlaps, Visit&& visit) const {
    for (std::uint32_t k = cells.low[1]; k <= cells.high[1]; ++k) {
      for (std::uint32_t i = cells.low[0]; i <= cells.high[0]; ++i) {
        const std::uint32_t cell = k * grid.cells_x() + i;
        if (!is_solid(cell)) continue;
        HeightSpan span;
        add_cell(span, i, k);
        if (!overlaps(box_of({{i, k}, {i, k}}, span))) continue;
        if (!visit(2 * cell) || !visit(2 * cell + 1)) return false;
      }
    }
    return true;
  }
};

}  // namespace isostep
