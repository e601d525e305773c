// BoundedQueue: first in, first out, of a size fixed at construction; the oldest gives way, and that is counted.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

template <class T> class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : items_(capacity) {}

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// The number of items that were dropped so far.
  std::uint64_t lost() const { return lost_; }
  void push(const T& item) {
    if (size_ == items_.size()) {
      pop();
      ++lost_;
    }
    items_[(first_ + size_++) % items_.size()] = item;
  }
  /// Removes and returns the oldest item. The queue must not be empty.
  T pop() {
    const T item = items_[first_];
    first_ = (first_ + 1) % items_.size();
    --size_;
    return item;
  }

 private:
  std::vector<T> items_;
  std::size_t first_ = 0, size_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace isostep
