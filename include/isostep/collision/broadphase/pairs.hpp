// PairSet<S>: the sorted list of pairs of bodies whose fat boxes overlap and that may collide.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/bitset.hpp"

namespace isostep {

/// Returns a pair of slots a < b as one number. Ascending keys are the canonical order of pairs.
ISO_INLINE constexpr std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t low = a < b ? a : b;
  return low << 32 | (a < b ? b : a);
}
ISO_INLINE constexpr std::uint32_t pair_a(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32); }
ISO_INLINE constexpr std::uint32_t pair_b(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

/// Holds { (a, b) : a < b, the stored boxes of a and b overlap, may_collide(a, b) }, ascending. After `update` the set
/// depends on the boxes and the predicate alone, not on history, nor on the structure that holds the boxes, any
/// BroadPhase (broad_phase.hpp), as long as every slot whose box, presence or filter changed was marked. The set is not
/// state: a loaded world clears it and marks all. It is complete while it has `most` pairs or fewer. Beyond, or if the
/// search takes too many steps to tell, keys() are what the caller `choose`s instead, at every update, until it says
/// that they are the whole set again.
/// Cost: O(pairs + marked log n); from a third of the leaves on, one join of the tree with itself (measured break-even
/// 0.33 to 0.41). Memory and time end at a few times `most` and the leaves. No allocation once warm.
template <class S> class PairSet {
 public:
  /// Marks a slot whose box changed, that was inserted, or for which the predicate changed. Repeats are free.
  void mark_moved(std::uint32_t slot);
  /// Marks a slot that left the structure. It may be inserted again before `update`, and is then marked moved as well.
  void mark_removed(std::uint32_t slot);
  /// Updates the pairs. may_collide(a, b) -> bool, a < b, is called for overlapping pairs only. Returns false if the
  /// caller must choose.
  template <class Structure, class Predicate>
  ISO_INLINE bool update(const Structure& boxes, const Predicate& may_collide, std::uint64_t most = kAnyNumber);
  /// Replaces the pairs by `keys`, ascending. `whole`: they are all existing pairs.
  void choose(std::vector<std::uint64_t>& keys, bool whole);
  /// Forgets pairs and marks, keeps the memory.
  void clear();

  /// The `pair_key`s of all pairs, ascending.
  ISO_INLINE const std::vector<std::uint64_t>& keys() const { return keys_; }

 private:
  static constexpr std::uint64_t kAnyNumber = ~std::uint64_t{0} >> 2;
  template <class Predicate> struct Take;

  bool give_up();
  void forget_marks();
  void drop_marked();
  void merge_found();

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> found_;  // of this update, not yet in order
  std::vector<std::uint64_t> scratch_;
  std::vector<std::uint32_t> marked_;
  Bitset is_marked_;
  bool whole_ = true;
  typename AabbTree<S>::Matches matches_;
};

template <class S> template <class Predicate> struct PairSet<S>::Take {
  PairSet* pairs;
  const Predicate* may_collide;
  bool of_marked;  // pairs (marked, other): two marked slots meet twice, and each meets itself

  ISO_INLINE void operator()(std::uint32_t slot, std::uint32_t other) const {
    if (of_marked && (other == slot || (other < slot && pairs->is_marked_.test(other)))) return;
    const std::uint32_t a = other < slot ? other : slot;
    const std::uint32_t b = other < slot ? slot : other;
    if ((*may_collide)(a, b)) pairs->found_.push_back(pair_key(a, b));
  }
};

template <class S>
template <class Structure, class Predicate>
ISO_INLINE bool PairSet<S>::update(const Structure& boxes, const Predicate& may_collide, std::uint64_t most) {
  if (!whole_ || most < keys_.size()) return give_up();
  if (marked_.empty()) return true;
  const std::uint64_t most_steps =
      2u * most + 32u * std::uint64_t{boxes.size()};  // a search takes a few a pair and a leaf
  bool found_all = false;
  if (marked_.size() >= boxes.size() / 3u) {
    keys_.clear();
    found_all = boxes.overlapping_pairs(matches_, most_steps, Take<Predicate>{this, &may_collide, false});
  } else {
    drop_marked();
    found_all = boxes.overlapping_pairs_of(marked_, matches_, most_steps, Take<Predicate>{this, &may_collide, true});
  }
  if (!found_all || most < keys_.size() + found_.size()) return give_up();
  merge_found();
  return true;
}

#define ISO_EXTERN_PAIR_SET(S) extern template class PairSet<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_PAIR_SET)
#undef ISO_EXTERN_PAIR_SET

}  // namespace isostep
