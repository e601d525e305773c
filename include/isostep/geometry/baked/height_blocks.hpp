// HeightBlocks: which cells of a height field may lie at a height: a pyramid of blocks of cells.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/geometry/baked/grid_point.hpp"
#include "isostep/geometry/baked/height_cells.hpp"

namespace isostep {

/// Input:   a field's cells, all of them and then those that change.
/// Output:  the blocks that a search has to look into.
/// Keeps:   least and greatest heights of blocks of cells, and of blocks of blocks, but for holes and ghosts.
class HeightBlocks {
 public:
  static constexpr std::uint32_t kBlock = 4, kBlockBits = 2;  // cells along a block of level 0

  // As in BakedHeightField.
  ISO_INLINE HeightBlocks() = default;
  ISO_INLINE HeightBlocks(const HeightBlocks&) = default;
  ISO_INLINE HeightBlocks(HeightBlocks&&) = default;
  ISO_INLINE HeightBlocks& operator=(const HeightBlocks&) = default;
  ISO_INLINE HeightBlocks& operator=(HeightBlocks&&) = default;
  ISO_INLINE ~HeightBlocks() = default;

  /// Makes room for the blocks of a grid.
  void lay_out(const HeightGrid& grid);
  /// Renews the spans of all blocks that contain the cells.
  void refresh(const HeightCells& field, const CellRange& cells);

  /// Returns the span of all cells.
  ISO_INLINE HeightSpan span() const { return spans_.back(); }
  ISO_INLINE std::size_t memory() const { return spans_.size() * sizeof(HeightSpan); }  // [bytes]
  /// Returns the first column >= i in row k that may have triangles in the box: the one behind the largest block around
  /// i that has none, or i.
  ISO_INLINE std::uint32_t next_candidate(std::uint32_t i, std::uint32_t k, const CellBox& box) const {
    std::uint32_t next = i;
    for (std::uint32_t level = 0; level < levels_; ++level) {
      const std::uint32_t bits = kBlockBits + level;
      if (!box.misses(span_of({i >> bits, k >> bits, level}))) break;
      next = ((i >> bits) + 1) << bits;
    }
    return next;
  }
  /// Descends into the blocks for which overlaps(cells, span) is true, and calls visit(cells) for those of level 0, the
  /// first along the way first, until visit returns false.
  template <class Overlaps, class Visit>
  ISO_INLINE bool traverse(GridVector way, Overlaps&& overlaps, Visit&& visit) const {
    const std::uint32_t first = (way.x < 0 ? 1u : 0u) + (way.z < 0 ? 2u : 0u);  // of a block's parts
    Block stack[kStack];
    int size = 0;
    stack[size++] = {0, 0, levels_ - 1};
    while (size > 0) {
      const Block block = stack[--size];
      const HeightSpan span = span_of(block);
      if (span.is_empty() || !overlaps(cells_of(block), span)) continue;
      if (block.level > 0) push_parts(block, first, stack, size);
      else if (!visit(cells_of(block))) return false;
    }
    return true;
  }

 private:
  static constexpr int kLevels = 22;  // 2^23 cells along a side are 2^21 blocks, 2^0 at the top
  /// A block leaves three of its parts waiting and continues with the fourth.
  static constexpr int kStack = 3 * kLevels + 1;

  struct Block {
    std::uint32_t x, z;  // in blocks of its level
    std::uint32_t level;
  };

  ISO_INLINE std::uint32_t blocks_x(std::uint32_t level) const { return ((cells_x_ - 1) >> (kBlockBits + level)) + 1; }
  ISO_INLINE std::uint32_t blocks_z(std::uint32_t level) const { return ((cells_z_ - 1) >> (kBlockBits + level)) + 1; }
  ISO_INLINE std::size_t place_of(Block block) const {
    return starts_[block.level] + static_cast<std::size_t>(block.z) * blocks_x(block.level) + block.x;
  }
  ISO_INLINE HeightSpan span_of(Block block) const { return spans_[place_of(block)]; }
  ISO_INLINE CellRange cells_of(Block block) const {
    const std::uint32_t bits = kBlockBits + block.level;
    const std::uint32_t end_x = (block.x + 1) << bits, end_z = (block.z + 1) << bits;
    return {{block.x << bits, block.z << bits},
            {(end_x < cells_x_ ? end_x : cells_x_) - 1, (end_z < cells_z_ ? end_z : cells_z_) - 1}};
  }
  ISO_INLINE void push_parts(Block block, std::uint32_t first, Block* stack, int& size) const {
    for (std::uint32_t i = 4; i-- > 0;) {
      const std::uint32_t part = i ^ first;
      const Block below = {2 * block.x + part % 2, 2 * block.z + part / 2, block.level - 1};
      if (below.x < blocks_x(below.level) && below.z < blocks_z(below.level)) stack[size++] = below;
    }
  }
  HeightSpan computed_span(const HeightCells& field, Block block) const;

  std::uint32_t cells_x_ = 0, cells_z_ = 0, levels_ = 0;
  std::size_t starts_[kLevels] = {};  // of each level, in spans_
  std::vector<HeightSpan> spans_;
};

}  // namespace isostep
