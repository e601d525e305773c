// Binary search over indices.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The first of 0..count-1 for which before(index) is false, or count. `before` is true for the indices below it.
template <class Before> ISO_INLINE constexpr std::size_t lower_bound(std::size_t count, const Before& before) {
  std::size_t low = 0, high = count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (before(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}

}  // namespace isostep
