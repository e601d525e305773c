// BakedHeightField: a static surface over a grid of heights, two triangles a cell.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/result.hpp"
#include "isostep/geometry/baked/baked_triangle.hpp"

namespace isostep {

/// The places of the heights. Column i is at x = i pitch, row k at z = k pitch, a height h at y = h 2^height_shift, all
/// in steps: one grid for all three, the one of meshes.
struct HeightGrid {
  std::uint32_t exponent;      // a step is 2^-exponent m
  std::uint32_t height_shift;  // a unit of height is 2^height_shift steps
  std::uint32_t columns, rows;
  std::uint32_t pitch;  // [steps] between columns, and between rows

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

/// An immutable surface. Cell (i, k) is number k (columns - 1) + i and lies between columns i, i + 1 and rows k, k + 1.
/// It is cut from (i + 1, k) to (i, k + 1); both triangles face up. Triangle 2 cell + half: half 0 has the corner (i,
/// k) and the points (i, k), (i, k + 1), (i + 1, k); half 1 has (i + 1, k + 1), (i + 1, k), (i, k + 1).
/// All but heights and materials is computed when it is asked for; least and greatest heights are kept of blocks of
/// cells, and of blocks of blocks.
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
  ISO_INLINE std::uint32_t triangle_count() const { return 2 * cells_x() * cells_z(); }
  ISO_INLINE MeshBox bounds() const { return box_of({0, 0, levels_ - 1}); }

  ISO_INLINE bool has_triangle(std::uint32_t id) const { return id < triangle_count() && is_solid(id / 2); }
  /// The triangle across edge k of one that is there, or kNoTriangle.
  std::uint32_t neighbour(std::uint32_t id, int k) const;
  ISO_INLINE TriangleCorners corners(std::uint32_t id) const {
    const std::uint32_t i = id / 2 % cells_x(), k = id / 2 / cells_x();
    const MeshPoint right = point(i + 1, k), below = point(i, k + 1);
    if (id % 2 == 0) return {{point(i, k), below, right}};
    return {{point(i + 1, k + 1), right, below}};
  }
  BakedTriangle triangle(std::uint32_t id) const;

  /// See TriangleGeometry. Ids ascend.
  template <class Visit> ISO_INLINE bool query(const MeshBox& box, Visit&& visit) const {
    CellRange range;
    if (!range_of(box, range)) return true;
    for (std::uint32_t k = range.low[1]; k <= range.high[1]; ++k) {
      for (std::uint32_t i = range.low[0]; i <= range.high[0];) {
        const std::uint32_t after = next_candidate(i, k, range);
        if (after != i) {
          i = after;
          continue;
        }
        do {
          if (!visit_cell(i, k, range, visit)) return false;
          ++i;
        } while (i % kBlock != 0 && i <= range.high[0]);
      }
    }
    return true;
  }
  template <class Overlaps, class Visit> ISO_INLINE bool traverse(Overlaps&& overlaps, Visit&& visit) const {
    return traverse({0, 0, 0}, overlaps, visit);
  }
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse(GridVector way, Overlaps&& overlaps, Visit&& visit) const {
    const std::uint32_t first = (way.x < 0 ? 1u : 0u) + (way.z < 0 ? 2u : 0u);  // of a block's parts
    Block stack[kStack];
    int size = 0;
    stack[size++] = {0, 0, levels_ - 1};
    while (size > 0) {
      const Block block = stack[--size];
      const Span span = span_of(block);
      if (span.low > span.high || !overlaps(box_of(block))) continue;
      if (block.level > 0) push_parts(block, first, stack, size);
      else if (!traverse_cells(block, overlaps, visit)) return false;
    }
    return true;
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

  static constexpr std::uint32_t kBlock = 4, kBlockBits = 2;  // cells along a block of level 0
  static constexpr int kLevels = 22;                          // 2^23 cells along a side are 2^21 blocks, 2^0 at the top
  /// A block leaves three of its parts waiting and goes on with the fourth.
  static constexpr int kStack = 3 * kLevels + 1;

  /// The heights of a block's cells that are neither holes nor ghosts; there are none where low is above high.
  struct Span {
    std::int16_t low, high;
  };
  struct Block {
    std::uint32_t x, z;  // in blocks of its level
    std::uint32_t level;
  };
  /// The place of a triangle: its cell, and 1 for half 0, -1 for half 1.
  struct Place {
    std::uint32_t i, k;
    std::int32_t sign;
  };
  struct CellRange {
    std::uint32_t low[2], high[2];         // x and z, closed
    std::int32_t low_height, high_height;  // closed
  };

  ISO_INLINE bool is_solid(std::size_t cell) const { return materials_[cell] < kGhostMaterial; }
  ISO_INLINE std::uint32_t cells_x() const { return grid_.columns - 1; }
  ISO_INLINE std::uint32_t cells_z() const { return grid_.rows - 1; }
  ISO_INLINE std::uint32_t blocks_x(std::uint32_t level) const { return ((cells_x() - 1) >> (kBlockBits + level)) + 1; }
  ISO_INLINE std::uint32_t blocks_z(std::uint32_t level) const { return ((cells_z() - 1) >> (kBlockBits + level)) + 1; }
  ISO_INLINE std::size_t place_of(Block block) const {
    return starts_[block.level] + static_cast<std::size_t>(block.z) * blocks_x(block.level) + block.x;
  }
  ISO_INLINE Span span_of(Block block) const { return spans_[place_of(block)]; }
  ISO_INLINE std::int32_t height(std::uint32_t i, std::uint32_t k) const {
    return heights_[static_cast<std::size_t>(k) * grid_.columns + i];
  }
  ISO_INLINE MeshPoint point(std::uint32_t i, std::uint32_t k) const {
    return {static_cast<std::int32_t>(i * grid_.pitch), height(i, k) * (1 << grid_.height_shift),
            static_cast<std::int32_t>(k * grid_.pitch)};
  }
  ISO_INLINE std::int64_t steps_of(std::int32_t height) const {
    return std::int64_t{height} * (1 << grid_.height_shift);
  }
  Place place_of(std::uint32_t id) const;
  /// The number of the cell across edge k, a ghost's too, or kNoTriangle where it is outside or a hole.
  std::uint32_t cell_across(Place place, int k) const;

  bool range_of(const MeshBox& box, CellRange& range) const;
  ISO_INLINE bool misses(Block block, const CellRange& range) const {
    const Span span = span_of(block);
    return span.low > span.high || span.low > range.high_height || span.high < range.low_height;
  }
  /// The column from which row k may have triangles in the range: behind the largest block that has none, if i lies in
  /// one.
  ISO_INLINE std::uint32_t next_candidate(std::uint32_t i, std::uint32_t k, const CellRange& range) const {
    std::uint32_t next = i;
    for (std::uint32_t level = 0; level < levels_; ++level) {
      const std::uint32_t bits = kBlockBits + level;
      if (!misses({i >> bits, k >> bits, level}, range)) break;
      next = ((i >> bits) + 1) << bits;
    }
    return next;
  }
  template <class Visit>
  ISO_INLINE bool visit_cell(std::uint32_t i, std::uint32_t k, const CellRange& range, Visit&& visit) const {
    const std::uint32_t cell = k * cells_x() + i;
    if (!is_solid(cell)) return true;
    const std::int32_t a = height(i + 1, k), b = height(i, k + 1);
    const std::int32_t low = a < b ? a : b, high = a < b ? b : a;
    if (touches(low, high, height(i, k), range) && !visit(2 * cell)) return false;
    return !touches(low, high, height(i + 1, k + 1), range) || visit(2 * cell + 1);
  }
  static ISO_INLINE bool touches(std::int32_t low, std::int32_t high, std::int32_t corner, const CellRange& range) {
    return (low <= range.high_height || corner <= range.high_height) &&
           (high >= range.low_height || corner >= range.low_height);
  }

  ISO_INLINE MeshBox box_of(Block block) const {
    const std::uint32_t bits = kBlockBits + block.level;
    const std::uint32_t end_x = (block.x + 1) << bits, end_z = (block.z + 1) << bits;
    const Span span = span_of(block);
    return box_of(block.x << bits, block.z << bits, end_x < cells_x() ? end_x : cells_x(),
                  end_z < cells_z() ? end_z : cells_z(), span.low, span.high);
  }
  ISO_INLINE MeshBox box_of(std::uint32_t i, std::uint32_t k, std::uint32_t end_i, std::uint32_t end_k,
                            std::int32_t low, std::int32_t high) const {
    const std::int64_t pitch = grid_.pitch;
    return {{pitch * i, steps_of(low), pitch * k}, {pitch * end_i, steps_of(high), pitch * end_k}};
  }
  ISO_INLINE void push_parts(Block block, std::uint32_t first, Block* stack, int& size) const {
    for (std::uint32_t i = 4; i-- > 0;) {
      const std::uint32_t part = i ^ first;
      const Block below = {2 * block.x + part % 2, 2 * block.z + part / 2, block.level - 1};
      if (below.x < blocks_x(below.level) && below.z < blocks_z(below.level)) stack[size++] = below;
    }
  }
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse_cells(Block block, Overlaps&& overlaps, Visit&& visit) const {
    for (std::uint32_t k = block.z * kBlock; k < (block.z + 1) * kBlock && k < cells_z(); ++k) {
      for (std::uint32_t i = block.x * kBlock; i < (block.x + 1) * kBlock && i < cells_x(); ++i) {
        const std::uint32_t cell = k * cells_x() + i;
        if (!is_solid(cell)) continue;
        Span span = {INT16_MAX, INT16_MIN};
        add_cell(span, i, k);
        if (!overlaps(box_of(i, k, i + 1, k + 1, span.low, span.high))) continue;
        if (!visit(2 * cell) || !visit(2 * cell + 1)) return false;
      }
    }
    return true;
  }
  ISO_INLINE void add_cell(Span& span, std::uint32_t i, std::uint32_t k) const {
    const std::int16_t* const row = heights_.data() + static_cast<std::size_t>(k) * grid_.columns + i;
    const std::int16_t* const next = row + grid_.columns;
    for (const std::int16_t h : {row[0], row[1], next[0], next[1]}) {
      if (h < span.low) span.low = h;
      if (h > span.high) span.high = h;
    }
  }

  ISO_INLINE bool is_empty() const { return spans_.back().low > spans_.back().high; }
  void lay_out();
  void refresh(const CellRange& cells);
  Span computed_span(Block block) const;
  CellRange cells_about(const HeightPatch& patch) const;

  HeightGrid grid_ = {};
  std::uint32_t levels_ = 0;
  std::size_t starts_[kLevels] = {};  // of each level, in spans_
  std::vector<std::int16_t> heights_;
  std::vector<std::uint8_t> materials_;
  std::vector<SurfaceMaterial> table_;
  std::vector<Span> spans_;
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
