// SweepAndPrune<S>: boxes in a list that is sorted along one axis.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/book/box_cells.hpp"
#include "isostep/book/box_table.hpp"
#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/lower_bound.hpp"

namespace isostep {

/// A BroadPhase. The list ascends by where boxes begin along the axis along which they are spread most; a pass over it
/// compares each box with those that begin before it ends. New boxes wait behind the list, unsorted, until they are
/// many or optimise() sorts all.
/// Source:  Baraff 1992, Dynamic Simulation of Non-Penetrating Rigid Bodies (bounds that are kept sorted); Ericson
///          2005, Real-Time Collision Detection, sec. 7.5 (one axis, chosen by variance).
/// Differs: positions are compared as whole numbers (BoxCells), ends by blocks of the list too, so that a question
///          skips blocks that end before it begins.
/// Cost:    update O(places by which a box moves in the list), pairs O(pairs of intervals on the axis that overlap):
///          boxes that lie along a line or a plane are cheap, a tower along another axis is not.
template <class S> class SweepAndPrune {
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

  /// Returns 0, 1, 2 for x, y, z.
  int axis() const { return axis_; }
  /// Returns how many boxes have their places in the list.
  std::uint32_t sorted() const { return sorted_ - gaps_; }
  bool validate() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kBlock = 64;        // items that have their farthest end in common
  static constexpr std::uint32_t kMostWaiting = 64;  // or an eighth of the list
  static constexpr std::uint32_t kMostPlaces = 64;   // that a box moves by; beyond, it waits

  struct Item {
    std::uint64_t low, high;  // along the axis, by number; a gap's high is 0, which no box ends at
    std::uint32_t slot;       // kNone: a gap, which keeps its low
    Aabb<S> box;              // [m] of the slot, here too: a pass reads one place after the other
  };
  struct ItemKey {
    ISO_INLINE std::uint64_t operator()(const Item& item) const { return item.low; }
  };
  using Cells = BoxCells<S>;

  Item item_of(std::uint32_t slot) const;
  void put(std::uint32_t at, const Item& item);
  void wait(const Item& item);
  void leave_gap(std::uint32_t at);
  std::uint32_t place_for(std::uint32_t at, std::uint64_t low) const;
  int spread_axis() const;
  void sort();
  /// Calls visit(item) -> bool for boxes of the list, then for waiting ones, that may meet low..high on the axis.
  template <class Visit> ISO_INLINE bool look(std::uint64_t low, std::uint64_t high, const Visit& visit) const;

  BoxTable<S> boxes_;
  std::vector<Item> items_;           // the list, sorted_ of them, then those that wait
  std::vector<std::uint32_t> place_;  // by slot, in items_
  std::vector<std::uint64_t> ends_;   // by block of the list: no item of it ends farther
  std::uint32_t sorted_ = 0, gaps_ = 0;
  int axis_ = 0;
  bool moved_ = false;  // ends_ may be nearer
  std::vector<Item> scratch_;
};

template <class S>
template <class Visit>
ISO_INLINE bool SweepAndPrune<S>::look(std::uint64_t low, std::uint64_t high, const Visit& visit) const {
  const auto end = static_cast<std::uint32_t>(
      lower_bound(sorted_, [&](std::size_t i) ISO_INLINE_LAMBDA { return items_[i].low <= high; }));
  for (std::uint32_t begin = 0; begin < end; begin += kBlock) {
    if (ends_[begin / kBlock] < low) continue;
    const std::uint32_t stop = begin + kBlock < end ? begin + kBlock : end;
    for (std::uint32_t i = begin; i < stop; ++i) {
      if (low <= items_[i].high && !visit(items_[i])) return false;
    }
  }
  for (std::size_t i = sorted_; i < items_.size(); ++i) {
    if (low <= items_[i].high && items_[i].low <= high && !visit(items_[i])) return false;
  }
  return true;
}

template <class S>
template <class Visit>
ISO_INLINE void SweepAndPrune<S>::query(const Aabb<S>& box, Visit&& visit) const {
  look(Cells::number(box.low[axis_]), Cells::number(box.high[axis_]),
       [&](const Item& item) ISO_INLINE_LAMBDA { return !overlap(item.box, box) || visit(item.slot); });
}

template <class S>
template <class Visit>
ISO_INLINE void SweepAndPrune<S>::sweep(const Sweep<S>& sweep, Visit&& visit) const {
  detail::SweepTest<S> test(sweep, boxes_.reach());
  Unit<S> fraction = sweep.max_fraction;
  look(Cells::number(test.reach.low[axis_]), Cells::number(test.reach.high[axis_]),
       [&](const Item& item) ISO_INLINE_LAMBDA {
         if (!test.touches(item.box)) return true;
         const Unit<S> shorter = visit(item.slot, fraction);
         if (shorter < fraction) test.shorten(fraction = shorter);
         return true;
       });
}

template <class S>
template <class Visit>
ISO_INLINE bool SweepAndPrune<S>::overlapping_pairs(Matches&, std::uint64_t most, Visit&& visit) const {
  const auto meet = [&](const Item& item, const Item& other) ISO_INLINE_LAMBDA {
    if (detail::overlap_flag(item.box, other.box) == 0) return true;
    if (most == 0) return false;
    --most;
    visit(item.slot, other.slot);
    return true;
  };
  for (std::uint32_t i = 0; i < sorted_; ++i) {
    const Item& item = items_[i];
    for (std::uint32_t k = i + 1u; k < sorted_ && items_[k].low <= item.high; ++k) {
      if (items_[k].slot != kNone && !meet(item, items_[k])) return false;
    }
  }
  for (std::size_t i = sorted_; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const bool more = look(item.low, item.high, [&](const Item& other) ISO_INLINE_LAMBDA {
      const std::uint32_t place = place_[other.slot];
      return (sorted_ <= place && place <= i) || meet(item, other);
    });
    if (!more) return false;
  }
  return true;
}
template <class S>
template <class Visit>
ISO_INLINE bool SweepAndPrune<S>::overlapping_pairs_of(std::span<const std::uint32_t> slot_list, Matches&,
                                                       std::uint64_t most, Visit&& visit) const {
  return detail::query_pairs_of(*this, slot_list, most, visit);
}

#define ISO_SWEEP_AND_PRUNE_OF(extern, S) extern template class SweepAndPrune<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SWEEP_AND_PRUNE_OF)

}  // namespace isostep
