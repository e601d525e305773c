// Every allocation of this program is counted, so that tests can say what a peer's words cost.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <new>

#include "hostile_scene.hpp"

isostep::hostile::AllocationCount isostep::hostile::allocation_count;

namespace {
void* counted(std::size_t size) {
  ++isostep::hostile::allocation_count.times;
  isostep::hostile::allocation_count.bytes += size;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) std::abort();
  return memory;
}
}  // namespace

// These are not inlined: gcc would take one half of a pair for a mismatch with the other.
#define NOT_INLINED __attribute__((noinline))
NOT_INLINED void* operator new(std::size_t size) { return counted(size); }
NOT_INLINED void operator delete(void* memory) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
