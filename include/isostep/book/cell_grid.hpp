// CellGrid<S, kManySizes>: the grid and the multi-resolution map, cells in a table by hash.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/book/box_cells.hpp"
#include "isostep/book/box_table.hpp"
#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// A BroadPhase. A box is in one cell, that of its low corner, of a level whose cells are wider than it; so what
/// overlaps a box has its low corner in the cells of that box or one before them. Levels are powers of two.
///   MultiGrid  each box in the level of its size (multi-resolution map)
///   Grid       one level, which optimise() chooses so that seven of eight boxes fit its cells; what is larger is in a
///              single cell as wide as the world, where each question meets it
/// Source:  Millington 2007, ch. 12, p. 258-260: grids (each object in one cell, half of the neighbours), p. 260-261:
///          multi-resolution maps (pairs within a level and with coarser ones); Ericson 2005, Real-Time Collision
///          Detection, sec. 7.2 (hierarchical hash grid).
/// Cost:    insert, update, remove O(1). A question looks at its cells in every level in use, or at all boxes where
///          that is less.
template <class S, bool kManySizes> class CellGrid {
 public:
  using Matches = typename AabbTree<S>::Matches;

  void insert(std::uint32_t slot, const Aabb<S>& box);
  void update(std::uint32_t slot, const Aabb<S>& box);
  void remove(std::uint32_t slot);
  void optimise();
  void clear();

  ISO_INLINE std::uint32_t size() const { return boxes_.size(); }
  ISO_INLINE bool contains(std::uint32_t slot) const { return boxes_.contains(slot); }
  ISO_INLINE const Aabb<S>& box(std::uint32_t slot) const { return boxes_.box(slot); }

  template <class Visit> ISO_INLINE void query(const Aabb<S>& box, Visit&& visit) const;
  template <class Visit> ISO_INLINE void sweep(const Sweep<S>& sweep, Visit&& visit) const;
  template <class Visit> ISO_INLINE bool overlapping_pairs(Matches& matches, std::uint64_t most, Visit&& visit) const;
  template <class Visit>
  ISO_INLINE bool overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches& matches, std::uint64_t most,
                                       Visit&& visit) const;

  /// Returns how many sizes of cells are in use.
  std::uint32_t levels() const { return static_cast<std::uint32_t>(std::popcount(levels_)); }
  bool validate() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kLeastBuckets = 64;
  static constexpr std::uint32_t kBucketsPerBox = 4;  // at least: most cells that are looked into are empty
  static constexpr int kLevels = 64;
  static constexpr int kMostHalvings = 20;       // of a sweep
  static constexpr std::uint32_t kNewCells = 8;  // that a piece of a sweep looks into, or thereabouts
  using Cells = BoxCells<S>;

  /// A cell of one level, low 32 bits: cells that share them share lists, and what is in a list passes by its box. A
  /// question looks at fewer cells than there are boxes, so it meets no list twice.
  struct Cell {
    std::uint32_t x, y, z, level;
    friend ISO_INLINE bool operator==(const Cell& a, const Cell& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z && a.level == b.level;
    }
  };
  struct Link {
    Cell cell;
    std::uint32_t size_class;
    std::uint32_t next, previous;  // in the bucket; previous: kNone for its first
  };
  /// Cells of a level, inclusive. Numbers below zero are none that a box has.
  struct Block {
    std::int64_t low[3], high[3];

    /// The cells in which boxes that overlap this box have their low corners.
    ISO_INLINE Block(const Cells& cells, std::uint32_t level) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = static_cast<std::int64_t>(cells.low[axis] >> level) - 1;
        high[axis] = static_cast<std::int64_t>(cells.high[axis] >> level);
      }
    }
    /// Returns true if the block has at most `most` cells.
    ISO_INLINE bool is_within(std::uint64_t most) const {
      for (int axis = 0; axis < 3; ++axis) {
        const auto side = static_cast<std::uint64_t>(high[axis] - low[axis]) + 1u;
        if (most < side) return false;
        most /= side;
      }
      return true;
    }
    ISO_INLINE bool has(std::int64_t x, std::int64_t y, std::int64_t z) const {
      return low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1] && low[2] <= z && z <= high[2];
    }
  };

  static ISO_INLINE Cell cell(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t level) {
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z), level};
  }
  ISO_INLINE std::uint32_t bucket(const Cell& cell) const {
    const std::uint64_t xy = (std::uint64_t{cell.x} << 32 | cell.y) * 0x9e3779b97f4a7c15u;
    const std::uint64_t zl = (std::uint64_t{cell.z} << 32 | cell.level) * 0xbf58476d1ce4e5b9u;
    const std::uint64_t both = (xy ^ xy >> 32) + (zl ^ zl >> 29);
    return static_cast<std::uint32_t>(both * 0x94d049bb133111ebu >> 32) &
           (static_cast<std::uint32_t>(buckets_.size()) - 1u);
  }
  /// Calls visit(slot) -> bool for the boxes of a cell. Stops at false and returns it.
  template <class Visit> ISO_INLINE bool look_into(const Cell& cell, const Visit& visit) const;
  template <class Visit> ISO_INLINE bool look_into(const Block& block, std::uint32_t level, const Visit& visit) const;
  /// Visits the boxes of all levels in `levels`.
  template <class Visit> ISO_INLINE bool look_at_all(std::uint64_t levels, const Visit& visit) const;
  /// Visits the boxes in cells that follow the box's own, and in its own cell those of higher slots.
  template <class Visit> ISO_INLINE bool look_ahead(std::uint32_t slot, const Cells& cells, const Visit& visit) const;

  template <class Visit>
  ISO_INLINE void walk(const detail::SweepTest<S>& test, std::uint32_t level, int halvings, const Unit<S>& fraction,
                       const Visit& visit) const;

  ISO_INLINE std::uint32_t level_for(std::uint32_t size_class) const;
  Link link_of(const Aabb<S>& box) const;
  void link(std::uint32_t slot, const Link& fresh);
  void unlink(std::uint32_t slot);
  void spread(std::size_t buckets);
  bool choose_level();

  BoxTable<S> boxes_;
  std::vector<Link> links_;             // by slot
  std::vector<std::uint32_t> buckets_;  // the first slot; a power of two of them
  std::uint64_t levels_ = 0;            // bits of those in use
  std::uint32_t in_level_[kLevels] = {};
  std::uint32_t in_class_[kLevels] = {};
  std::uint32_t chosen_ = 0;  // Grid's level
};

template <class S> using Grid = CellGrid<S, false>;
template <class S> using MultiGrid = CellGrid<S, true>;

template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::look_into(const Cell& cell, const Visit& visit) const {
  for (std::uint32_t slot = buckets_[bucket(cell)]; slot != kNone; slot = links_[slot].next) {
    if (links_[slot].cell == cell && !visit(slot)) return false;
  }
  return true;
}
template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::look_into(const Block& block, std::uint32_t level, const Visit& visit) const {
  for (std::int64_t z = block.low[2]; z <= block.high[2]; ++z) {
    for (std::int64_t y = block.low[1]; y <= block.high[1]; ++y) {
      for (std::int64_t x = block.low[0]; x <= block.high[0]; ++x) {
        if (!look_into(cell(x, y, z, level), visit)) return false;
      }
    }
  }
  return true;
}
template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::look_at_all(std::uint64_t levels, const Visit& visit) const {
  if (levels == 0) return true;
  for (std::uint32_t slot = 0; slot < links_.size(); ++slot) {
    if (contains(slot) && (levels >> links_[slot].cell.level & 1u) != 0 && !visit(slot)) return false;
  }
  return true;
}

template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE void CellGrid<S, kManySizes>::query(const Aabb<S>& box, Visit&& visit) const {
  const Cells cells = Cells::of(box);
  const auto take = [&](std::uint32_t slot)
                        ISO_INLINE_LAMBDA { return detail::overlap_flag(boxes_[slot], box) == 0 || visit(slot); };
  std::uint64_t whole = 0;
  for (std::uint64_t left = levels_; left != 0; left &= left - 1u) {
    const auto level = static_cast<std::uint32_t>(std::countr_zero(left));
    const Block block(cells, level);
    if (!block.is_within(size())) whole |= std::uint64_t{1} << level;
    else if (!look_into(block, level, take)) return;
  }
  look_at_all(whole, take);
}

/// Sweeps in pieces of a cell's width, 2^halvings of them. Both ends of the pieces' blocks move one way along each
/// axis, so a cell that an earlier piece had is one of the last piece.
template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE void CellGrid<S, kManySizes>::walk(const detail::SweepTest<S>& test, std::uint32_t level, int halvings,
                                              const Unit<S>& fraction, const Visit& visit) const {
  Unit<S> step = Unit<S>(1), from = Unit<S>(0);
  for (int i = 0; i < halvings; ++i) step = step * Unit<S>(0.5);
  Vec3<S> begin = test.origin;
  Block last(Cells::of({begin, begin}), level);
  for (std::uint32_t i = 0; i >> halvings == 0 && from <= fraction; ++i) {
    from = from + step;
    const Vec3<S> end = test.origin + test.displacement * from;
    const Block piece(Cells::of({min(begin, end) - test.half, max(begin, end) + test.half}), level);
    for (std::int64_t z = piece.low[2]; z <= piece.high[2]; ++z) {
      for (std::int64_t y = piece.low[1]; y <= piece.high[1]; ++y) {
        for (std::int64_t x = piece.low[0]; x <= piece.high[0]; ++x) {
          if (i == 0 || !last.has(x, y, z)) look_into(cell(x, y, z, level), visit);
        }
      }
    }
    last = piece;
    begin = end;
  }
}

template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE void CellGrid<S, kManySizes>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  if (size() == 0) return;
  detail::SweepTest<S> test(sweep, boxes_.reach());
  Unit<S> fraction = sweep.max_fraction;
  const auto take = [&](std::uint32_t slot) ISO_INLINE_LAMBDA {
    if (!test.touches(boxes_[slot])) return true;
    const Unit<S> shorter = visit(slot, fraction);
    if (shorter < fraction) test.shorten(fraction = shorter);
    return true;
  };
  const Cells asked = Cells::of(test.reach);
  std::uint64_t whole = 0;
  for (std::uint64_t left = levels_; left != 0; left &= left - 1u) {
    const auto level = static_cast<std::uint32_t>(std::countr_zero(left));
    std::uint64_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) cells |= (asked.high[axis] >> level) - (asked.low[axis] >> level);
    const int halvings = static_cast<int>(std::bit_width(cells));
    const bool is_long = halvings > kMostHalvings || size() >> halvings < kNewCells;
    if (is_long) whole |= std::uint64_t{1} << level;
    else walk(test, level, halvings, fraction, take);
  }
  look_at_all(whole, take);
}

/// Two overlapping boxes of one level have neighbouring cells: the box whose cell comes first by z, y and x finds the
/// pair.
template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::look_ahead(std::uint32_t slot, const Cells& cells, const Visit& visit) const {
  const std::uint32_t level = links_[slot].cell.level;
  const Block block(cells, level);
  const std::int64_t own[3] = {block.low[0] + 1, block.low[1] + 1, block.low[2] + 1};
  for (std::int64_t z = own[2]; z <= block.high[2]; ++z) {
    for (std::int64_t y = z == own[2] ? own[1] : block.low[1]; y <= block.high[1]; ++y) {
      const bool own_row = z == own[2] && y == own[1];
      for (std::int64_t x = own_row ? own[0] : block.low[0]; x <= block.high[0]; ++x) {
        const bool own_cell = own_row && x == own[0];
        const bool more = look_into(cell(x, y, z, level), [&](std::uint32_t other) ISO_INLINE_LAMBDA {
          return (own_cell && other <= slot) || visit(other);
        });
        if (!more) return false;
      }
    }
  }
  return true;
}

template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::overlapping_pairs(Matches&, std::uint64_t most, Visit&& visit) const {
  for (std::uint32_t slot = 0; slot < links_.size(); ++slot) {
    if (!contains(slot)) continue;
    const Aabb<S>& box = boxes_[slot];
    const Cells cells = Cells::of(box);
    const auto take = [&](std::uint32_t other) ISO_INLINE_LAMBDA {
      if (detail::overlap_flag(box, boxes_[other]) == 0) return true;
      if (most == 0) return false;
      --most;
      visit(slot, other);
      return true;
    };
    if (!look_ahead(slot, cells, take)) return false;
    const std::uint32_t own = links_[slot].cell.level;
    for (std::uint64_t left = levels_ >> own >> 1 << own << 1; left != 0; left &= left - 1u) {
      const auto level = static_cast<std::uint32_t>(std::countr_zero(left));
      if (!look_into(Block(cells, level), level, take)) return false;
    }
  }
  return true;
}
template <class S, bool kManySizes>
template <class Visit>
ISO_INLINE bool CellGrid<S, kManySizes>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches&,
                                                              std::uint64_t most, Visit&& visit) const {
  return detail::query_pairs_of(*this, slot_list, most, visit);
}

#define ISO_CELL_GRID_OF(extern, S)         \
  extern template class CellGrid<S, false>; \
  extern template class CellGrid<S, true>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CELL_GRID_OF)

}  // namespace isostep
