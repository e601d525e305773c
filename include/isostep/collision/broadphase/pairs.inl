// Bodies of PairSet<S>: what is done to the list of keys. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"

namespace isostep {

template <class S> void PairSet<S>::mark_moved(std::uint32_t slot) {
  if (is_marked_.insert(slot)) marked_.push_back(slot);
}
template <class S> void PairSet<S>::mark_removed(std::uint32_t slot) {
  mark_moved(slot);  // `update` drops the pairs of every marked slot and looks for new ones only of those in the tree
}

template <class S> void PairSet<S>::forget_marks() {
  for (const std::uint32_t slot : marked_) is_marked_.reset(slot);
  marked_.clear();
}
template <class S> bool PairSet<S>::give_up() {
  forget_marks();
  found_.clear();
  whole_ = false;
  return false;
}
template <class S> void PairSet<S>::choose(std::vector<std::uint64_t>& keys, bool whole) {
  keys_.swap(keys);
  whole_ = whole;
}

template <class S> void PairSet<S>::drop_marked() {
  std::size_t kept = 0;
  for (const std::uint64_t key : keys_) {
    keys_[kept] = key;
    kept += is_marked_.test(pair_a(key)) || is_marked_.test(pair_b(key)) ? 0u : 1u;
  }
  keys_.resize(kept);
}

/// Sorts the found keys and merges them into the kept keys, from the back. The two have no key in common.
template <class S> void PairSet<S>::merge_found() {
  forget_marks();
  std::size_t found = found_.size();
  if (scratch_.size() < found) scratch_.resize(found);
  stable_sort(found_.data(), scratch_.data(), static_cast<std::uint32_t>(found), OwnKey{});
  std::size_t kept = keys_.size();
  keys_.resize(kept + found);
  while (found != 0) {
    const bool take_kept = kept != 0 && found_[found - 1u] < keys_[kept - 1u];
    keys_[kept + found - 1u] = take_kept ? keys_[kept - 1u] : found_[found - 1u];
    kept -= take_kept ? 1u : 0u;
    found -= take_kept ? 0u : 1u;
  }
  found_.clear();
}

template <class S> void PairSet<S>::clear() {
  forget_marks();
  keys_.clear();
  found_.clear();
  whole_ = true;
}

}  // namespace isostep
