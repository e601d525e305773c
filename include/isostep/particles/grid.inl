// Bodies of ParticleGrid<S>.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/core/stable_sort.hpp"
#include "isostep/particles/grid.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

namespace detail {
/// Grows memory, which never shrinks.
template <class T> ISO_INLINE void grow(std::vector<T>& memory, std::size_t size) {
  if (memory.size() < size) memory.resize(size);
}
}  // namespace detail

template <class S>
bool ParticleGrid<S>::find_pairs(const Axes<S>& position, const std::uint32_t* slot_list, const S* reach,
                                 std::uint32_t count, std::vector<std::uint64_t>& pairs, std::uint32_t max_pairs) {
  const Input input{position, slot_list, reach};
  tests_ = 0;
  found_count_ = 0;
  max_pairs_ = max_pairs;
  detail::grow(rest_, count);
  detail::grow(entries_, count);
  detail::grow(entries_scratch_, count);
  for (std::uint32_t i = 0; i < count; ++i) rest_[i] = i;
  std::uint32_t left = count;
  while (left > 1 && !full()) left = meet_coarsest(input, left);
  const bool all = !full();
  if (!all) found_count_ = max_pairs;
  append_ordered(slot_list, pairs);
  return all;
}

template <class S> bool ParticleGrid<S>::full() const { return found_count_ > max_pairs_; }

template <class S> S ParticleGrid<S>::largest_reach(const Input& input, std::uint32_t left) const {
  S reach = resolution<S>();
  for (std::uint32_t i = 0; i < left; ++i) reach = max(reach, input.reach[rest_[i]]);
  return reach;
}

/// Finds the pairs of the class of largest reach with itself and with finer particles. The finer ones remain.
template <class S> std::uint32_t ParticleGrid<S>::meet_coarsest(const Input& input, std::uint32_t left) {
  const S reach = largest_reach(input, left);
  place_lattice(input, left, reach);
  const bool last = !(resolution<S>() < reach);
  std::uint32_t coarse = 0;
  std::uint32_t fine = left;  // finer ones fill the entries from behind
  for (std::uint32_t i = 0; i < left; ++i) {
    const std::uint32_t index = rest_[i];
    const std::uint32_t slot = input.slot_list[index];
    const std::uint64_t key = numbered(0, input.position.x[slot]) +
                              lattice_.stride_y * numbered(1, input.position.y[slot]) +
                              lattice_.stride_z * numbered(2, input.position.z[slot]);
    const bool is_coarse = last || reach <= input.reach[index] + input.reach[index];
    std::uint32_t at = coarse;
    if (is_coarse) ++coarse;
    if (!is_coarse) at = --fine;
    entries_[at] = {key, index};
  }
  sort_into(coarse_, input, entries_.data(), coarse);
  meet_own();
  if (coarse == left || full()) return 0;
  const std::uint32_t finer = left - coarse;
  sort_into(fine_, input, entries_.data() + coarse, finer);
  meet_finer();
  for (std::uint32_t i = 0; i < finer; ++i) rest_[i] = fine_.items[i].index;
  return finer;
}

/// Symbols: R [m] the largest reach; u = 2^-e m the lattice's unit, e chosen so that 2R has 10 bits and coordinates fit
///          61; t shifts lattice numbers so that their spread fits 42 bits.
/// Two particles that touch differ by at most floor(2R/u) + 1 along an axis, since floors differ by less than one more
/// than their arguments, and by (floor(2R/u) >> t) + 1 after the shift. D is one more, which absorbs the rounding of
/// float distances (2^-10 against 2^-22). With f = floor(2^22/D), cells floor(c f / 2^22) of two such particles differ
/// by at most one, since D f <= 2^22. D >= 2, so c f < 2^42 2^21 fits.
template <class S> void ParticleGrid<S>::place_lattice(const Input& input, std::uint32_t left, S reach) {
  Vec3<S> low = input.position[input.slot_list[rest_[0]]];
  Vec3<S> high = low;
  for (std::uint32_t i = 1; i < left; ++i) {
    const Vec3<S> p = input.position[input.slot_list[rest_[i]]];
    low = min(low, p);
    high = max(high, p);
  }
  int above = exponent_above(low.x);
  std::uint64_t spread = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int above_low = exponent_above(low[axis]);
    const int above_high = exponent_above(high[axis]);
    if (above < above_low) above = above_low;
    if (above < above_high) above = above_high;
  }
  const int fine = 9 - exponent_above(reach);
  lattice_.exponent = fine < 60 - above ? fine : 60 - above;
  std::uint64_t most[3];
  for (int axis = 0; axis < 3; ++axis) {
    lattice_.origin[axis] = floor_scaled(low[axis], lattice_.exponent);
    spread |= static_cast<std::uint64_t>(floor_scaled(high[axis], lattice_.exponent) - lattice_.origin[axis]);
  }
  const int bits = static_cast<int>(std::bit_width(spread));
  lattice_.shift = bits > 42 ? bits - 42 : 0;
  const auto width = static_cast<std::uint64_t>(floor_scaled(reach, lattice_.exponent + 1)) >> lattice_.shift;
  lattice_.factor = (std::uint64_t{1} << 22) / (width + 2u);
  lattice_.coarsening = 0;
  lattice_.ranked = false;
  for (int axis = 0; axis < 3; ++axis) most[axis] = cell_of(axis, high[axis]) + 1u;
  if (!number_cells(most)) rank_cells(input, left);
}

/// Numbers cells 1..most along each axis row by row, with an empty cell between rows and an empty row between layers,
/// so that the neighbours of a cell are at fixed distances. Returns false if the numbers would not fit 63 bits.
template <class S> bool ParticleGrid<S>::number_cells(const std::uint64_t* most) {
  if (std::bit_width(most[0] + 1u) + std::bit_width(most[1] + 1u) + std::bit_width(most[2] + 2u) > 63) return false;
  lattice_.stride_y = most[0] + 1u;
  lattice_.stride_z = lattice_.stride_y * (most[1] + 1u);
  return true;
}

/// Numbers only the occupied coordinates, for a few particles far from a pile; neighbours get consecutive numbers. If
/// even these are too many, cells are joined.
template <class S> void ParticleGrid<S>::rank_cells(const Input& input, std::uint32_t left) {
  lattice_.ranked = true;
  std::uint64_t most[3];
  for (;; ++lattice_.coarsening) {
    for (int axis = 0; axis < 3; ++axis) most[axis] = rank_axis(input, left, axis);
    if (number_cells(most)) return;
  }
}

template <class S> std::uint64_t ParticleGrid<S>::rank_axis(const Input& input, std::uint32_t left, int axis) {
  std::vector<std::uint64_t>& cells = ranked_[axis];
  std::vector<std::uint32_t>& ranks = ranks_[axis];
  const std::vector<S>& x = axis == 0 ? input.position.x : axis == 1 ? input.position.y : input.position.z;
  cells.resize(left);
  ranks.resize(left);
  detail::grow(scratch_, left);
  for (std::uint32_t i = 0; i < left; ++i) cells[i] = cell_of(axis, x[input.slot_list[rest_[i]]]);
  stable_sort(cells.data(), scratch_.data(), left, OwnKey{});
  std::uint32_t kept = 1;
  ranks[0] = 1;
  for (std::uint32_t i = 1; i < left; ++i) {
    const std::uint64_t gap = cells[i] - cells[kept - 1u];
    if (gap == 0) continue;
    ranks[kept] = ranks[kept - 1u] + (gap == 1 ? 1u : 2u);
    cells[kept++] = cells[i];
  }
  cells.resize(kept);
  ranks.resize(kept);
  return ranks[kept - 1u];
}

template <class S> ISO_INLINE std::uint64_t ParticleGrid<S>::cell_of(int axis, S x) const {
  const std::int64_t unit = floor_scaled(x, lattice_.exponent) - lattice_.origin[axis];
  return (static_cast<std::uint64_t>(unit) >> lattice_.shift) * lattice_.factor >> 22 >> lattice_.coarsening;
}

template <class S> ISO_INLINE std::uint64_t ParticleGrid<S>::numbered(int axis, S x) const {
  const std::uint64_t cell = cell_of(axis, x);
  if (!lattice_.ranked) return cell + 1u;
  const std::uint64_t* const cells = ranked_[axis].data();
  std::size_t at = 0;  // cells[at] <= cell < cells[end]
  std::size_t end = ranked_[axis].size();
  while (end - at > 1) {
    const std::size_t middle = at + (end - at) / 2;
    if (cells[middle] <= cell) at = middle;
    if (cell < cells[middle]) end = middle;
  }
  return ranks_[axis][at];
}

template <class S>
void ParticleGrid<S>::sort_into(Sorted& sorted, const Input& input, Entry* entries, std::uint32_t count) {
  stable_sort(entries, entries_scratch_.data(), count, EntryKey{});
  detail::grow(sorted.items, count);
  detail::grow(sorted.cells, count + 1u);
  std::uint32_t cells = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t index = entries[i].index;
    sorted.items[i] = {input.position[input.slot_list[index]], input.reach[index], index};
    if (i == 0 || entries[i].key != entries[i - 1u].key) sorted.cells[cells++] = {entries[i].key, i};
  }
  sorted.cells[cells] = {~std::uint64_t{0}, count};
}

template <class S> ISO_INLINE void ParticleGrid<S>::advance(Row& row, const Cell* cells, std::uint64_t key) {
  const std::uint64_t first = key + row.offset;
  while (cells[row.begin].key < first) ++row.begin;
  if (row.end < row.begin) row.end = row.begin;
  while (cells[row.end].key <= first + 2u) ++row.end;
}

/// Finds pairs within the class: in the rest of the own cell and the next one along x, then in four rows of three.
template <class S> void ParticleGrid<S>::meet_own() {
  const std::uint64_t y = lattice_.stride_y;
  const std::uint64_t z = lattice_.stride_z;
  Row rows[4] = {{y - 1u}, {z - y - 1u}, {z - 1u}, {z + y - 1u}};
  const Cell* const cells = coarse_.cells.data();
  const Item* const items = coarse_.items.data();
  for (const Cell* cell = cells; cell->key != ~std::uint64_t{0}; ++cell) {
    const Item* const end = items + cell[1].first;
    const Item* const row_end = cell[1].key == cell->key + 1u ? items + cell[2].first : end;
    for (const Item* one = items + cell->first; one != end; ++one) test_range(*one, one + 1, row_end);
    for (Row& row : rows) {
      advance(row, cells, cell->key);
      if (row.begin == row.end) continue;
      const Item* const from = items + cells[row.begin].first;
      const Item* const to = items + cells[row.end].first;
      for (const Item* one = items + cell->first; one != end; ++one) test_range(*one, from, to);
    }
    if (full()) return;
  }
}

/// Finds pairs of the class with finer particles: in nine rows of three.
template <class S> void ParticleGrid<S>::meet_finer() {
  const std::uint64_t y = lattice_.stride_y;
  const std::uint64_t z = lattice_.stride_z;
  const std::uint64_t back = ~std::uint64_t{0};  // -1
  Row rows[9] = {{back - z - y}, {back - z},     {back - z + y}, {back - y},    {back},
                 {back + y},     {back + z - y}, {back + z},     {back + z + y}};
  const Cell* const cells = fine_.cells.data();
  const Item* const items = fine_.items.data();
  for (const Cell* cell = coarse_.cells.data(); cell->key != ~std::uint64_t{0}; ++cell) {
    const Item* const first = coarse_.items.data() + cell->first;
    const Item* const end = coarse_.items.data() + cell[1].first;
    for (Row& row : rows) {
      advance(row, cells, cell->key);
      if (row.begin == row.end) continue;
      const Item* const from = items + cells[row.begin].first;
      const Item* const to = items + cells[row.end].first;
      for (const Item* one = first; one != end; ++one) test_range(*one, from, to);
    }
    if (full()) return;
  }
}

/// Every pair is written and counted if it touches: whether it does is not predictable. Too many are noticed by the
/// caller; what is beyond max_pairs is at most one range.
template <class S> ISO_INLINE void ParticleGrid<S>::test_range(const Item& one, const Item* from, const Item* to) {
  if (full()) return;
  const auto length = static_cast<std::size_t>(to - from);
  tests_ += length;
  if (found_.size() < found_count_ + length) found_.resize(2u * (found_count_ + length));
  std::uint64_t* const found = found_.data();
  std::size_t count = found_count_;
  const Item self = one;
  for (const Item* other = from; other != to; ++other) {
    const Vec3<S> apart = other->position - self.position;
    const S reach = self.reach + other->reach;
    const std::uint32_t low = self.index < other->index ? self.index : other->index;
    const std::uint32_t high = self.index < other->index ? other->index : self.index;
    found[count] = std::uint64_t{low} << 32 | high;
    count += dot_sum(apart, apart) <= product(reach, reach) ? 1u : 0u;
  }
  found_count_ = count;
}

/// One radix sort of all pairs: counting them by lower index and sorting each particle's partners was no faster.
template <class S>
void ParticleGrid<S>::append_ordered(const std::uint32_t* slot_list, std::vector<std::uint64_t>& pairs) {
  const std::size_t before = pairs.size();
  const auto count = static_cast<std::uint32_t>(found_count_);
  pairs.resize(before + count);
  detail::grow(scratch_, count);
  std::uint64_t* const out = pairs.data() + before;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t a = slot_list[found_[i] >> 32];
    out[i] = a << 32 | slot_list[static_cast<std::uint32_t>(found_[i])];
  }
  stable_sort(out, scratch_.data(), count, OwnKey{});
}

}  // namespace isostep
