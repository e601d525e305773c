// Every operator new of this program, counted while somebody counts.
// SPDX-License-Identifier: MIT
#include "determinism/allocation_count.hpp"

#include <cstdlib>
#include <new>

namespace {
void* counted(std::size_t size, std::size_t alignment) {
  if (isostep::test::Count::counting) ++isostep::test::Count::allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (memory == nullptr) std::abort();
  return memory;
}
}  // namespace

// These are not inlined: gcc would take one half of a pair for a mismatch with the other.
#define NOT_INLINED __attribute__((noinline))
NOT_INLINED void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, std::size_t(alignment));
}
NOT_INLINED void operator delete(void* memory) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
