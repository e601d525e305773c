// Remembered: a number computed from something that rarely changes.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A value computed from something at most once between two changes, by whoever calls first; a copy may know it.
/// Several threads may call at once: they come to the same value. A value of 0 is computed again every time.
class Remembered {
 public:
  ISO_INLINE Remembered() : value_(0) {}
  ISO_INLINE Remembered(const Remembered& other) : value_(other.value_.load(std::memory_order_relaxed)) {}
  ISO_INLINE Remembered& operator=(const Remembered& other) {
    value_.store(other.value_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    return *this;
  }
  ISO_INLINE void forget() { value_.store(0, std::memory_order_relaxed); }
  template <class Compute> ISO_INLINE std::uint64_t get(const Compute& compute) const {
    std::uint64_t value = value_.load(std::memory_order_relaxed);
    if (value == 0) {
      value = compute();
      value_.store(value, std::memory_order_relaxed);
    }
    return value;
  }

 private:
  mutable std::atomic<std::uint64_t> value_;
};

}  // namespace isostep
