// ParticleGrid<S>: all pairs of particles within reach of each other, by a grid of cells that is a sorted list.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/axes.hpp"

namespace isostep {

/// This is no state: it remembers nothing from call to call but its memory, so no allocation once warm.
///
/// Particles of reach within a factor of two make a class. The coarsest class and all finer particles are counted into
/// cells as wide as two of its largest reach, sorted by cell, and a class meets itself in its own cell and the 13
/// neighbours ahead, finer particles in all 27; then the next class, with smaller cells. So a boulder does not make
/// coarse cells full of sand, and particles that share a cell without touching are few: cost is linear in particles,
/// pairs and classes.
///
/// Range: any finite positions. reach <= 2^(W-3) for fixed point with W whole bits (Q16.16: 4096 m, Q32.32: 2^28 m),
/// which keeps differences of neighbours and the sums of their squares inside the formats; <= 2^60 for float.
template <class S> class ParticleGrid {
 public:
  /// Appends to `pairs` every a << 32 | b of slots a < b with |p_a - p_b| <= reach_a + reach_b, ascending; compared by
  /// squares, as exact sums where the format has them. slots[0..count) ascend; reach[i] [m], >= 0, is slots[i]'s.
  /// False when there are more than `max_pairs` of them: then it appends max_pairs of them and stops. Which ones
  /// depends on the arguments alone.
  bool find_pairs(const Axes<S>& position, const std::uint32_t* slot_list, const S* reach, std::uint32_t count,
                  std::vector<std::uint64_t>& pairs, std::uint32_t max_pairs);

  /// The number of distances compared by the last call.
  ISO_INLINE std::uint64_t distance_tests() const { return tests_; }

 private:
  struct Input {
    const Axes<S>& position;
    const std::uint32_t* slot_list;
    const S* reach;
  };
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;  // into slots and reach
  };
  struct EntryKey {
    ISO_INLINE std::uint64_t operator()(const Entry& entry) const { return entry.key; }
  };
  struct Item {
    Vec3<S> position;  // [m]
    S reach;           // [m]
    std::uint32_t index;
  };
  struct Cell {
    std::uint64_t key;
    std::uint32_t first;  // of its items
  };
  /// Items by cell, ascending; closed by a cell with a key above all others.
  struct Sorted {
    std::vector<Item> items;
    std::vector<Cell> cells;
  };
  /// Three cells side by side along x, and where they lie in a list whose keys are asked for in ascending order.
  struct Row {
    std::uint64_t offset;  // from a cell to the first of the three, modulo 2^64
    std::uint32_t begin = 0, end = 0;
  };
  /// The layout of cells: position -> integer lattice -> cell -> rank among occupied cells, where cells are too many.
  struct Lattice {
    int exponent;            // lattice units are 2^-exponent m ...
    int shift;               // ... times 2^shift, counted from origin
    int coarsening;          // cells are joined by 2^coarsening
    std::uint64_t factor;    // cells per unit, times 2^22
    std::int64_t origin[3];  // in units of 2^-exponent m
    std::uint64_t stride_y, stride_z;
    bool ranked;
  };

  S largest_reach(const Input& input, std::uint32_t left) const;
  std::uint32_t meet_coarsest(const Input& input, std::uint32_t left);
  void place_lattice(const Input& input, std::uint32_t left, S reach);
  bool number_cells(const std::uint64_t* most);
  void rank_cells(const Input& input, std::uint32_t left);
  std::uint64_t rank_axis(const Input& input, std::uint32_t left, int axis);
  std::uint64_t cell_of(int axis, S x) const;
  std::uint64_t numbered(int axis, S x) const;
  void sort_into(Sorted& sorted, const Input& input, Entry* entries, std::uint32_t count);
  void meet_own();
  void meet_finer();
  static void advance(Row& row, const Cell* cells, std::uint64_t key);
  void test_range(const Item& one, const Item* from, const Item* to);
  bool full() const;
  void append_ordered(const std::uint32_t* slot_list, std::vector<std::uint64_t>& pairs);

  Lattice lattice_;
  std::vector<std::uint32_t> rest_;  // indices of particles whose class is to come
  std::vector<Entry> entries_, entries_scratch_;
  Sorted coarse_, fine_;
  std::vector<std::uint64_t> ranked_[3];  // the occupied cells of each axis, ascending
  std::vector<std::uint32_t> ranks_[3];   // and their new numbers
  std::vector<std::uint64_t> found_;      // index << 32 | index, in the order of the walk
  std::vector<std::uint64_t> scratch_;
  std::size_t found_count_ = 0;
  std::uint32_t max_pairs_ = 0;
  std::uint64_t tests_ = 0;
};

#define ISO_EXTERN_PARTICLE_GRID(S) extern template class ParticleGrid<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_PARTICLE_GRID)
#undef ISO_EXTERN_PARTICLE_GRID

}  // namespace isostep
