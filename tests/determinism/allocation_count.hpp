// Count: how often a scope asks for memory. Its program replaces operator new.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include "isostep/core/scalars.hpp"

namespace isostep::test {

/// Counts from here to the end of the scope.
class Count {
 public:
  Count() {
    allocations = 0;
    counting = true;
  }
  ~Count() { counting = false; }
  std::size_t so_far() const { return allocations; }

  static inline bool counting = false;
  static inline std::size_t allocations = 0;
};

using AllocationScalars = testing::Types<float, double, Q16_16, Q32_32>;

}  // namespace isostep::test
