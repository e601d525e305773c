// SortedOrder: the first of many by an order that changes, all kept sorted.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A sorted list, as an alternative to TournamentTree. Here `before` may leave some in any order, if it is transitive
/// in that.
/// Source: Millington 2007, pp. 346-349: contacts kept in a sorted list, from which one that changes moves on.
/// Cost:   O(n log n) to plant; of a change as many swaps as it passes others, O(n) at worst.
class SortedOrder {
 public:
  /// Sorts all anew, by merging.
  template <class Before> ISO_INLINE void plant(std::uint32_t count, const Before& before) {
    order_.resize(count);
    other_.resize(count);
    place_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
    for (std::size_t width = 1; width < count; width *= 2) {
      for (std::size_t first = 0; first < count; first += 2 * width) merge(first, width, count, before);
      order_.swap(other_);
    }
    for (std::uint32_t i = 0; i < count; ++i) place_[order_[i]] = i;
  }
  /// Handles a change of one.
  template <class Before> ISO_INLINE void replay(std::uint32_t index, const Before& before) {
    std::size_t at = place_[index];
    for (; at > 0 && before(index, order_[at - 1]); --at) put(at, order_[at - 1]);
    for (; at + 1 < order_.size() && before(order_[at + 1], index); ++at) put(at, order_[at + 1]);
    put(at, index);
  }
  /// Returns the index of the first. There is at least one.
  ISO_INLINE std::uint32_t first() const { return order_[0]; }

 private:
  ISO_INLINE void put(std::size_t at, std::uint32_t index) {
    order_[at] = index;
    place_[index] = static_cast<std::uint32_t>(at);
  }
  template <class Before>
  ISO_INLINE void merge(std::size_t first, std::size_t width, std::size_t count, const Before& before) {
    const std::size_t middle = first + width < count ? first + width : count;
    const std::size_t end = middle + width < count ? middle + width : count;
    std::size_t left = first, right = middle;
    for (std::size_t at = first; at < end; ++at) {
      const bool takes_right = left == middle || (right < end && before(order_[right], order_[left]));
      other_[at] = order_[takes_right ? right++ : left++];
    }
  }

  std::vector<std::uint32_t> order_;  // sorted
  std::vector<std::uint32_t> other_;  // of merging
  std::vector<std::uint32_t> place_;  // in order_, by index
};

}  // namespace isostep
