// DisjointSets: union-find in canonical order, for islands of bodies that contacts and joints tie together.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Disjoint sets of 0..n-1; every set is named by its least member, so the names depend on the sets alone.
class DisjointSets {
 public:
  /// Allocates memory for that many, so that begin() allocates none.
  ISO_INLINE void make_room(std::size_t count) {
    if (parent_.size() < count) parent_.resize(count);
  }
  ISO_INLINE void begin(std::size_t count) {
    parent_.resize(count);
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  ISO_INLINE std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  ISO_INLINE void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace isostep
