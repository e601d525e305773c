// LiveHandles: which handles of a kind exist, so that one which was destroyed is refused and never followed.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <vector>

namespace isostep::c {

/// Any thread may call it. A new handle may have the address of one that was destroyed: nobody can tell those apart.
template <class T> class LiveHandles {
 public:
  static void add(const T* handle) {
    const Lock lock;
    handles_.push_back(handle);
  }
  static bool has(const T* handle) {
    const Lock lock;
    return find(handle) < handles_.size();
  }
  static void remove(const T* handle) {
    const Lock lock;
    const std::size_t at = find(handle);
    if (at == handles_.size()) return;
    handles_[at] = handles_.back();
    handles_.pop_back();
  }

 private:
  struct Lock {  // for some words, so nobody sleeps
    Lock() {
      while (flag_.test_and_set(std::memory_order_acquire)) {}
    }
    ~Lock() { flag_.clear(std::memory_order_release); }
  };
  static std::size_t find(const T* handle) {
    std::size_t at = 0;
    while (at < handles_.size() && handles_[at] != handle) ++at;
    return at;
  }

  static inline std::atomic_flag flag_ = ATOMIC_FLAG_INIT;
  static inline std::vector<const T*> handles_;
};

}  // namespace isostep::c
