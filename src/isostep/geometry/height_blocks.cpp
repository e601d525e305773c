// The pyramid of a height field's heights.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/height_blocks.hpp"

#include <algorithm>

namespace isostep {

void HeightBlocks::lay_out(const HeightGrid& grid) {
  cells_x_ = grid.cells_x();
  cells_z_ = grid.cells_z();
  std::size_t total = 0;
  for (levels_ = 0; levels_ == 0 || blocks_x(levels_ - 1) > 1 || blocks_z(levels_ - 1) > 1; ++levels_) {
    starts_[levels_] = total;
    total += static_cast<std::size_t>(blocks_x(levels_)) * blocks_z(levels_);
  }
  spans_.resize(total);
}

void HeightBlocks::refresh(const HeightCells& field, const CellRange& cells) {
  for (std::uint32_t level = 0; level < levels_; ++level) {
    const std::uint32_t bits = kBlockBits + level;
    for (std::uint32_t z = cells.low[1] >> bits; z <= cells.high[1] >> bits; ++z) {
      for (std::uint32_t x = cells.low[0] >> bits; x <= cells.high[0] >> bits; ++x) {
        const Block block = {x, z, level};
        spans_[place_of(block)] = computed_span(field, block);
      }
    }
  }
}

HeightSpan HeightBlocks::computed_span(const HeightCells& field, Block block) const {
  HeightSpan span;
  if (block.level > 0) {
    Block parts[4];
    int count = 0;
    push_parts(block, 0, parts, count);
    for (int i = 0; i < count; ++i) {
      const HeightSpan part = span_of(parts[i]);
      span = {std::min(span.low, part.low), std::max(span.high, part.high)};
    }
    return span;
  }
  const CellRange cells = cells_of(block);
  for (std::uint32_t k = cells.low[1]; k <= cells.high[1]; ++k) {
    for (std::uint32_t i = cells.low[0]; i <= cells.high[0]; ++i) {
      if (field.is_solid(static_cast<std::size_t>(k) * cells_x_ + i)) field.add_cell(span, i, k);
    }
  }
  return span;
}

}  // namespace isostep
