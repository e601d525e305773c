// Bodies of CellGrid<S, kManySizes>: lists of cells, and levels of boxes. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/cell_grid.hpp"

namespace isostep {

template <class S, bool kManySizes>
ISO_INLINE std::uint32_t CellGrid<S, kManySizes>::level_for(std::uint32_t size_class) const {
  if (kManySizes) return size_class;
  return size_class <= chosen_ ? chosen_ : static_cast<std::uint32_t>(Cells::top_level());
}

template <class S, bool kManySizes>
typename CellGrid<S, kManySizes>::Link CellGrid<S, kManySizes>::link_of(const Aabb<S>& box) const {
  const Cells cells = Cells::of(box);
  const auto size_class = static_cast<std::uint32_t>(cells.size_class());
  const std::uint32_t level = level_for(size_class);
  return {{static_cast<std::uint32_t>(cells.low[0] >> level), static_cast<std::uint32_t>(cells.low[1] >> level),
           static_cast<std::uint32_t>(cells.low[2] >> level), level},
          size_class,
          kNone,
          kNone};
}

template <class S, bool kManySizes> void CellGrid<S, kManySizes>::link(std::uint32_t slot, const Link& fresh) {
  std::uint32_t& first = buckets_[bucket(fresh.cell)];
  links_[slot] = fresh;
  links_[slot].next = first;
  links_[slot].previous = kNone;
  if (first != kNone) links_[first].previous = slot;
  first = slot;
  ++in_class_[fresh.size_class];
  ++in_level_[fresh.cell.level];
  levels_ |= std::uint64_t{1} << fresh.cell.level;
}
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::unlink(std::uint32_t slot) {
  const Link& gone = links_[slot];
  if (gone.next != kNone) links_[gone.next].previous = gone.previous;
  if (gone.previous != kNone) links_[gone.previous].next = gone.next;
  else buckets_[bucket(gone.cell)] = gone.next;
  --in_class_[gone.size_class];
  if (--in_level_[gone.cell.level] == 0) levels_ &= ~(std::uint64_t{1} << gone.cell.level);
}

/// Puts all boxes where they belong.
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::spread(std::size_t buckets) {
  buckets_.resize(buckets);
  for (std::uint32_t& first : buckets_) first = kNone;
  for (int i = 0; i < kLevels; ++i) in_level_[i] = in_class_[i] = 0;
  levels_ = 0;
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u))
    link(slot, link_of(boxes_[slot]));
}

template <class S, bool kManySizes> void CellGrid<S, kManySizes>::insert(std::uint32_t slot, const Aabb<S>& box) {
  if (buckets_.size() <= kBucketsPerBox * std::size_t{size()}) {
    choose_level();
    spread(buckets_.empty() ? kLeastBuckets : buckets_.size() * 2u);
  }
  boxes_.insert(slot, box);
  if (slot >= links_.size()) links_.resize(slot + 1u);
  link(slot, link_of(box));
}
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  boxes_.replace(slot, box);
  const Link fresh = link_of(box);
  if (fresh.cell == links_[slot].cell && fresh.size_class == links_[slot].size_class) return;
  unlink(slot);
  link(slot, fresh);
}
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::remove(std::uint32_t slot) {
  boxes_.remove(slot);
  unlink(slot);
}
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::clear() {
  boxes_.clear();
  spread(buckets_.size());
}

/// Chooses cells that seven of eight boxes fit. Cells shrink only if they are more than twice as wide, so that a few
/// boxes that come and go do not move all. Returns true if the level changed.
template <class S, bool kManySizes> bool CellGrid<S, kManySizes>::choose_level() {
  if (kManySizes || size() == 0) return false;
  std::uint32_t fitting = in_class_[0], wanted = 0;
  while (fitting < size() - size() / 8u) fitting += in_class_[++wanted];
  const bool differs = wanted != chosen_ && wanted + 1u != chosen_;
  if (differs) chosen_ = wanted;
  return differs;
}
template <class S, bool kManySizes> void CellGrid<S, kManySizes>::optimise() {
  if (choose_level()) spread(buckets_.size());
}

template <class S, bool kManySizes> bool CellGrid<S, kManySizes>::validate() const {
  std::uint32_t linked = 0;
  for (std::uint32_t first : buckets_) {
    std::uint32_t previous = kNone;
    for (std::uint32_t slot = first; slot != kNone; previous = slot, slot = links_[slot].next, ++linked) {
      if (!contains(slot) || links_[slot].previous != previous) return false;
      if (!(links_[slot].cell == link_of(boxes_[slot]).cell)) return false;
    }
  }
  std::uint32_t counted = 0, classed = 0;
  for (int i = 0; i < kLevels; ++i) {
    counted += in_level_[i];
    classed += in_class_[i];
    if ((in_level_[i] != 0) != ((levels_ >> i & 1u) != 0)) return false;
  }
  return linked == size() && counted == size() && classed == size();
}

}  // namespace isostep
