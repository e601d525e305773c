// Bodies of SweepAndPrune<S>: places in the list. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/sweep_and_prune.hpp"
#include "isostep/core/stable_sort.hpp"

namespace isostep {

template <class S> typename SweepAndPrune<S>::Item SweepAndPrune<S>::item_of(std::uint32_t slot) const {
  return {Cells::number(boxes_[slot].low[axis_]), Cells::number(boxes_[slot].high[axis_]), slot, boxes_[slot]};
}
/// Puts an item into the list.
template <class S> void SweepAndPrune<S>::put(std::uint32_t at, const Item& item) {
  items_[at] = item;
  if (item.slot != kNone) place_[item.slot] = at;
  std::uint64_t& end = ends_[at / kBlock];
  end = max(end, item.high);
}
template <class S> void SweepAndPrune<S>::wait(const Item& item) {
  place_[item.slot] = static_cast<std::uint32_t>(items_.size());
  items_.push_back(item);
  const std::size_t waiting = items_.size() - sorted_;
  if (kMostWaiting < waiting && sorted_ / 8u < waiting) sort();
}
template <class S> void SweepAndPrune<S>::leave_gap(std::uint32_t at) {
  items_[at].high = 0;
  items_[at].slot = kNone;
  ++gaps_;
}

template <class S> void SweepAndPrune<S>::insert(std::uint32_t slot, const Aabb<S>& box) {
  boxes_.insert(slot, box);
  if (slot >= place_.size()) place_.resize(slot + 1u);
  wait(item_of(slot));
}

template <class S> void SweepAndPrune<S>::remove(std::uint32_t slot) {
  boxes_.remove(slot);
  const std::uint32_t at = place_[slot];
  if (at < sorted_) {
    leave_gap(at);
    return;
  }
  items_[at] = items_.back();
  place_[items_[at].slot] = at;
  items_.pop_back();
}

/// Returns the place of the item at `at` if it begins at `low`; kNone if that is more than kMostPlaces away.
template <class S> std::uint32_t SweepAndPrune<S>::place_for(std::uint32_t at, std::uint64_t low) const {
  std::uint32_t to = at, left = kMostPlaces;
  if (at > 0 && low < items_[at - 1u].low) {
    for (; to > 0 && low < items_[to - 1u].low; --to) {
      if (left-- == 0) return kNone;
    }
  } else {
    for (; to + 1u < sorted_ && items_[to + 1u].low < low; ++to) {
      if (left-- == 0) return kNone;
    }
  }
  return to;
}

template <class S> void SweepAndPrune<S>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  boxes_.replace(slot, box);
  const Item item = item_of(slot);
  std::uint32_t at = place_[slot];
  if (at >= sorted_) {
    items_[at] = item;
    return;
  }
  moved_ = true;
  const std::uint32_t to = place_for(at, item.low);
  if (to == kNone) {
    leave_gap(at);
    wait(item);
    return;
  }
  for (; at > to; --at) put(at, items_[at - 1u]);
  for (; at < to; ++at) put(at, items_[at + 1u]);
  put(to, item);
}

template <class S> void SweepAndPrune<S>::optimise() {
  if (moved_ || gaps_ != 0 || sorted_ != items_.size()) sort();
}
template <class S> void SweepAndPrune<S>::clear() {
  boxes_.clear();
  items_.clear();
  sorted_ = 0;
  gaps_ = 0;
  moved_ = false;
}

/// Returns the axis with the greatest sum of distances from the mean. In units of 2^-BoxCells::kFineness m, sums of
/// 2^20 boxes fit 64 bits.
template <class S> int SweepAndPrune<S>::spread_axis() const {
  int widest = 0;
  std::uint64_t greatest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint64_t sum = 0, distances = 0;
    for (const Item& item : items_) sum += Cells::number(boxes_[item.slot].low[axis]);
    const std::uint64_t mean = sum / items_.size();
    for (const Item& item : items_) {
      const std::uint64_t number = Cells::number(boxes_[item.slot].low[axis]);
      distances += number < mean ? mean - number : number - mean;
    }
    if (greatest < distances) {
      greatest = distances;
      widest = axis;
    }
  }
  return widest;
}

template <class S> void SweepAndPrune<S>::sort() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    items_[kept] = items_[i];
    kept += items_[i].slot == kNone ? 0u : 1u;
  }
  items_.resize(kept);
  sorted_ = size();
  gaps_ = 0;
  moved_ = false;
  if (kept == 0) return;
  const int axis = spread_axis();
  if (axis != axis_) {
    axis_ = axis;
    for (Item& item : items_) item = item_of(item.slot);
  }
  if (scratch_.size() < kept) scratch_.resize(kept);
  stable_sort(items_.data(), scratch_.data(), sorted_, ItemKey{});
  const std::size_t blocks = (kept + kBlock - 1u) / kBlock;
  if (ends_.size() < blocks) ends_.resize(blocks);
  for (std::uint64_t& end : ends_) end = 0;
  for (std::uint32_t i = 0; i < sorted_; ++i) put(i, items_[i]);
}

template <class S> bool SweepAndPrune<S>::validate() const {
  std::uint32_t found = 0, gaps = 0;
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const bool in_list = i < sorted_;
    if (in_list && i > 0 && item.low < items_[i - 1u].low) return false;
    if (in_list && ends_[i / kBlock] < item.high) return false;
    if (item.slot == kNone) {
      ++gaps;
      if (!in_list || item.high != 0) return false;
      continue;
    }
    const Item fresh = item_of(item.slot);
    if (!contains(item.slot) || place_[item.slot] != i || fresh.low != item.low || fresh.high != item.high ||
        !(item.box == fresh.box))
      return false;
    ++found;
  }
  return found == size() && gaps == gaps_ && sorted_ <= items_.size();
}

}  // namespace isostep
