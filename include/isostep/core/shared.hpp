// Shared<T>: a value that copies have in common until one of them changes it.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "isostep/core/remembered.hpp"

namespace isostep {

/// It holds large values that rarely change. A change is made in place while one copy is left, else in a copy; a value
/// that two share is never written, so they may live on different threads. It is never empty.
template <class T> class Shared {
 public:
  ISO_INLINE Shared() : node_(new Node) {}
  ISO_INLINE Shared(const Shared& other) : node_(other.node_) { node_->owners.fetch_add(1, std::memory_order_relaxed); }
  ISO_INLINE ~Shared() { release(node_); }
  ISO_INLINE Shared& operator=(const Shared& other) {
    if (node_ == other.node_) return *this;
    other.node_->owners.fetch_add(1, std::memory_order_relaxed);
    release(std::exchange(node_, other.node_));
    return *this;
  }

  ISO_INLINE const T& operator*() const { return node_->value; }
  ISO_INLINE const T* operator->() const { return &node_->value; }
  /// Returns the value to be written. The reference holds until the next copy.
  ISO_INLINE T& change() {
    if (node_->owners.load(std::memory_order_acquire) != 1) release(std::exchange(node_, new Node(node_->value)));
    for (Remembered& remembered : node_->remembered) remembered.forget();
    return node_->value;
  }
  ISO_INLINE bool is_same(const Shared& other) const { return node_ == other.node_; }
  /// Returns a number computed from the value. There are three, 0 to 2. Hashes use 0 and 1.
  ISO_INLINE const Remembered& remembered(int which = 0) const { return node_->remembered[which]; }

 private:
  struct Node {
    ISO_INLINE Node() : owners(1), value() {}
    ISO_INLINE explicit Node(const T& from) : owners(1), value(from) {}
    ISO_INLINE ~Node() {}
    std::atomic<std::uint32_t> owners;
    Remembered remembered[3];
    T value;
  };
  static ISO_INLINE void release(Node* node) {
    if (node->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete node;
  }

  Node* node_;
};

}  // namespace isostep
