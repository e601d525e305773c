// BoxTable<S>: boxes by slot, which every coarse structure but the tree of boxes decides by in the end.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/bitset.hpp"

namespace isostep {

/// Structures sort slots by approximations of their boxes that miss no overlap; what is visited passes by the box
/// itself.
template <class S> class BoxTable {
 public:
  ISO_INLINE void insert(std::uint32_t slot, const Aabb<S>& box) {
    ISO_ASSERT(!contains(slot));
    if (slot >= boxes_.size()) boxes_.resize(slot + 1u);
    present_.set(slot);
    ++size_;
    replace(slot, box);
  }
  ISO_INLINE void replace(std::uint32_t slot, const Aabb<S>& box) {
    boxes_[slot] = box;
    reach_ = {min(reach_.low, box.low), max(reach_.high, box.high)};
  }
  ISO_INLINE void remove(std::uint32_t slot) {
    ISO_ASSERT(contains(slot));
    present_.reset(slot);
    --size_;
  }
  ISO_INLINE void clear() {
    present_.clear();
    size_ = 0;
    reach_ = Aabb<S>{};
  }

  ISO_INLINE std::uint32_t size() const { return size_; }
  ISO_INLINE bool contains(std::uint32_t slot) const { return present_.test(slot); }
  ISO_INLINE const Aabb<S>& box(std::uint32_t slot) const { return boxes_[slot]; }
  ISO_INLINE const Aabb<S>& operator[](std::uint32_t slot) const { return boxes_[slot]; }
  /// Returns the least taken slot from `from` on, or Bitset::kNone.
  ISO_INLINE std::uint32_t next(std::uint32_t from) const { return present_.find_next(from); }
  /// Returns the box around the origin and all boxes since the table was empty, which bounds a SweepTest's numbers.
  ISO_INLINE const Aabb<S>& reach() const { return reach_; }

 private:
  std::vector<Aabb<S>> boxes_;
  Bitset present_;
  std::uint32_t size_ = 0;
  Aabb<S> reach_{};
};

namespace detail {

/// Computes overlapping_pairs_of by a query for every box.
template <class Structure, class Visit>
ISO_INLINE bool query_pairs_of(const Structure& structure, std::span<const std::uint32_t> slot_list, std::uint64_t most,
                               const Visit& visit) {
  bool within = true;
  for (const std::uint32_t slot : slot_list) {
    if (!structure.contains(slot)) continue;
    structure.query(structure.box(slot), [&](std::uint32_t other) ISO_INLINE_LAMBDA {
      within = most != 0;
      if (!within) return false;
      --most;
      visit(slot, other);
      return true;
    });
    if (!within) return false;
  }
  return true;
}

}  // namespace detail

}  // namespace isostep
