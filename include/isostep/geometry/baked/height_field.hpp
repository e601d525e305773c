// BakedHeightField: a static surface over a grid of heights, two triangles a cell.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/geometry/baked/baked_triangle.hpp"
#include "isostep/geometry/baked/height_blocks.hpp"
#include "isostep/geometry/baked/height_cells.hpp"
#include "isostep/geometry/baked/height_grid.hpp"

namespace isostep {

/// An immutable surface. Cell (i, k) is number k (columns - 1) + i and lies between columns i, i + 1 and rows k, k + 1.
/// It is cut from (i + 1, k) to (i, k + 1); both triangles face up. Triangle 2 cell + half: half 0 has the corner (i,
/// k) and the points (i, k), (i, k + 1), (i + 1, k); half 1 has (i + 1, k + 1), (i + 1, k), (i, k + 1).
/// Keeps heights, materials and their table, and the blocks by which searches skip cells. All else is computed when it
/// is asked for.
class BakedHeightField {
 public:
  static constexpr std::uint32_t kMaxExponent = 16, kMaxHeightShift = 7, kMaxCells = 1u << 24;
  static constexpr std::uint8_t kHole = 255;  // material of a cell without triangles; kGhostMaterial: with ghosts

  // These are what the compiler would make, but without weak functions in the files that hold height fields.
  ISO_INLINE BakedHeightField(const BakedHeightField&) = default;
  ISO_INLINE BakedHeightField(BakedHeightField&&) = default;
  ISO_INLINE BakedHeightField& operator=(const BakedHeightField&) = default;
  ISO_INLINE BakedHeightField& operator=(BakedHeightField&&) = default;
  ISO_INLINE ~BakedHeightField() = default;

  ISO_INLINE const HeightGrid& grid() const { return grid_; }
  ISO_INLINE int exponent() const { return static_cast<int>(grid_.exponent); }
  /// All heights, by rows.
  ISO_INLINE std::span<const std::int16_t> heights() const { return heights_; }
  /// The materials, by cells.
  ISO_INLINE std::span<const std::uint8_t> materials() const { return materials_; }
  ISO_INLINE std::uint8_t material(std::uint32_t id) const { return materials_[id / 2]; }
  ISO_INLINE std::span<const SurfaceMaterial> table() const { return table_; }
  /// The number of triangles, those of holes and ghosts included.
  ISO_INLINE std::uint32_t triangle_count() const { return 2 * grid_.cells_x() * grid_.cells_z(); }
  ISO_INLINE MeshBox bounds() const { return cells().box_of(all_cells(), blocks_.span()); }

  ISO_INLINE bool has_triangle(std::uint32_t id) const { return id < triangle_count() && cells().is_solid(id / 2); }
  /// The triangle across edge k of one that is there, or kNoTriangle.
  std::uint32_t neighbour(std::uint32_t id, int k) const;
  ISO_INLINE TriangleCorners corners(std::uint32_t id) const {
    const HeightCells field = cells();
    const std::uint32_t i = id / 2 % grid_.cells_x(), k = id / 2 / grid_.cells_x();
    const MeshPoint right = field.point(i + 1, k), below = field.point(i, k + 1);
    if (id % 2 == 0) return {{field.point(i, k), below, right}};
    return {{field.point(i + 1, k + 1), right, below}};
  }
  BakedTriangle triangle(std::uint32_t id) const;

  /// See TriangleGeometry. Ids ascend.
  template <class Visit> ISO_INLINE bool query(const MeshBox& box, Visit&& visit) const {
    CellBox within;
    if (!range_of(box, within)) return true;
    const HeightCells field = cells();
    for (std::uint32_t k = within.low[1]; k <= within.high[1]; ++k) {
      for (std::uint32_t i = within.low[0]; i <= within.high[0];) {
        const std::uint32_t after = blocks_.next_candidate(i, k, within);
        if (after != i) {
          i = after;
          continue;
        }
        do {
          if (!field.visit_cell(i, k, within, visit)) return false;
          ++i;
        } while (i % HeightBlocks::kBlock != 0 && i <= within.high[0]);
      }
    }
    return true;
  }
  template <class Overlaps, class Visit> ISO_INLINE bool traverse(Overlaps&& overlaps, Visit&& visit) const {
    return traverse({0, 0, 0}, overlaps, visit);
  }
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse(GridVector way, Overlaps&& overlaps, Visit&& visit) const {
    const HeightCells field = cells();
    return blocks_.traverse(
        way,
        [&](const CellRange& of_block, HeightSpan span)
            ISO_INLINE_LAMBDA { return overlaps(field.box_of(of_block, span)); },
        [&](const CellRange& of_block) ISO_INLINE_LAMBDA { return field.visit_cells(of_block, overlaps, visit); });
  }

  /// Makes the field with other heights, and other materials. ErrorCode::invalid: "heights", the rectangle leaves the
  /// field, or there are not as many heights as it has places; "materials" of another count, or all that is left are
  /// holes.
  Result<BakedHeightField> with_heights(const HeightPatch& patch) const;
  /// [steps] The box of the cells that have one of the patch's places as a corner, as they are now; the rectangle must
  /// be inside the field.
  MeshBox bounds_about(const HeightPatch& patch) const;

  /// [bytes] The size of this object and all it holds.
  std::size_t memory() const;
  /// The canonical content, little-endian: the fields of the grid, u32 each; heights i16; materials u8; if there is a
  /// table, its count u32 and u16 x 2 each.
  std::vector<std::uint8_t> bytes() const;

 private:
  friend Result<BakedHeightField> height_field(const HeightGrid&, std::span<const std::int16_t>,
                                               const SurfaceMaterials&);
  ISO_INLINE BakedHeightField() = default;

  ISO_INLINE HeightCells cells() const { return {grid_, heights_.data(), materials_.data()}; }
  ISO_INLINE CellRange all_cells() const { return {{0, 0}, {grid_.cells_x() - 1, grid_.cells_z() - 1}}; }
  /// Returns false where no triangle touches the box.
  bool range_of(const MeshBox& box, CellBox& range) const;

  HeightGrid grid_ = {};
  std::vector<std::int16_t> heights_;
  std::vector<std::uint8_t> materials_;
  std::vector<SurfaceMaterial> table_;
  HeightBlocks blocks_;
};

/// Builds a height field. `heights` has columns times rows numbers.
/// ErrorCode::invalid: "exponent" above 16; "height_shift" above 7; "columns" or "rows" below 2; "pitch" 0, or so large
/// that a coordinate leaves the range of MeshPoint; "heights" or "materials" of another count; "materials" that are all
/// holes or ghosts; at "table[i]" a material out of range. ErrorCode::limit: more "cells" than kMaxCells, or a longer
/// "table".
Result<BakedHeightField> height_field(const HeightGrid& grid, std::span<const std::int16_t> heights,
                                      const SurfaceMaterials& materials);

/// Reads what `bytes` gave, from bytes nobody vouches for.
Result<BakedHeightField> read_height_field(Bytes bytes);

}  // namespace isostep
