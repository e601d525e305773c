// LinearSearch: the first of many by an order that changes, looked for among all.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A linear search, an alternative to TournamentTree. Here `before` may leave some unordered, if transitive in that.
/// Source: Millington 2007, pp. 338-346.
/// Cost:   O(n) when the first gives way, O(1) of any other change.
class LinearSearch {
 public:
  /// Compares all.
  template <class Before> ISO_INLINE void plant(std::uint32_t count, const Before& before) {
    count_ = count;
    first_ = 0;
    for (std::uint32_t i = 1; i < count_; ++i) {
      if (before(i, first_)) first_ = i;
    }
  }
  /// Handles a change of one.
  template <class Before> ISO_INLINE void replay(std::uint32_t index, const Before& before) {
    if (index == first_) plant(count_, before);
    else if (before(index, first_)) first_ = index;
  }
  /// Returns the index of the first. There is at least one.
  ISO_INLINE std::uint32_t first() const { return first_; }

 private:
  std::uint32_t count_ = 0, first_ = 0;
};

}  // namespace isostep
