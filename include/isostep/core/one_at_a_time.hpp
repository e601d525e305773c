// OneAtATime: keeps calls that change a thing from meeting inside it.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The running thread's own address: never null, different in each thread that runs.
const void* this_thread();

/// Entry reports a call inside another: a callback that changes what calls it. In builds with ISOSTEP_ASSERTS a second
/// thread ends the program; in others it may go unseen.
class OneAtATime {
 public:
  class Entry {
   public:
    ISO_INLINE explicit Entry(OneAtATime& of) : of_(of), alone_(of.enter()) {}
    ISO_INLINE ~Entry() {
      if (alone_) of_.inside_.store(nullptr, std::memory_order_release);
    }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    ISO_INLINE bool alone() const { return alone_; }

   private:
    OneAtATime& of_;
    bool alone_;
  };

 private:
  ISO_INLINE bool enter() {
#if defined(ISOSTEP_ASSERTS)
    const void* other = nullptr;
    if (inside_.compare_exchange_strong(other, this_thread(), std::memory_order_acquire)) return true;
    ISO_ASSERT(other == this_thread());  // two threads in one world
    return false;
#else
    if (inside_.load(std::memory_order_relaxed) != nullptr) return false;
    inside_.store(this, std::memory_order_relaxed);
    return true;
#endif
  }

  std::atomic<const void*> inside_ = nullptr;
};

}  // namespace isostep
