// Replaces operator new and delete of the whole program: shuffled_heap.hpp says for what.
// SPDX-License-Identifier: MIT
#include "shuffled_heap.hpp"

#include <sys/mman.h>

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

#if defined(__GLIBC__)
#include <malloc.h>

#include "../../random/splitmix64.hpp"
#endif

namespace isostep::test {
namespace {

constexpr std::size_t kClasses = 17, kLeastSize = 16, kRegion = std::size_t{1} << 26;  // [bytes] up to 1 MB
constexpr std::uint32_t kMostSlots = 1u << 15;

/// Blocks of one size, and which of them are free, in no order.
struct Region {
  unsigned char* memory = nullptr;
  std::uint32_t* free = nullptr;
  std::uint32_t left = 0;

  void open(std::size_t size) {
    const std::size_t slots = kRegion / size < kMostSlots ? kRegion / size : kMostSlots;
    const auto map = [](std::size_t bytes) {
      return mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    };
    memory = static_cast<unsigned char*>(map(kRegion));
    free = static_cast<std::uint32_t*>(map(slots * sizeof(std::uint32_t)));
    for (left = 0; left < slots; ++left) free[left] = left;
  }
};

struct Heap {
  Region regions[kClasses];
  std::atomic_flag busy = ATOMIC_FLAG_INIT;
  std::uint64_t state = 0, blocks = 0;
  unsigned char pattern = 0;
  bool shuffles = false;
};
Heap heap;  // constant-initialised, for others' constructors allocate

class Lock {
 public:
  Lock() {
    while (heap.busy.test_and_set(std::memory_order_acquire)) {}
  }
  ~Lock() { heap.busy.clear(std::memory_order_release); }
};

std::uint64_t random_word() { return splitmix64(heap.state); }

void* take(std::size_t size, std::size_t alignment) {
  const std::size_t rounded = std::bit_ceil(size < alignment ? alignment : size < kLeastSize ? kLeastSize : size);
  const auto index = static_cast<std::size_t>(std::countr_zero(rounded / kLeastSize));
  const Lock lock;
  if (heap.shuffles && index < kClasses) {
    Region& region = heap.regions[index];
    if (region.memory == nullptr) region.open(rounded);
    if (region.left > 0) {
      ++heap.blocks;
      const auto i = static_cast<std::uint32_t>((random_word() >> 32) * region.left >> 32);
      const std::uint32_t slot = region.free[i];
      region.free[i] = region.free[--region.left];
      return std::memset(region.memory + slot * rounded, heap.pattern, size);
    }
  }
  void* const block = alignment > alignof(std::max_align_t)
                          ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                          : std::malloc(size == 0 ? 1 : size);
  if (block == nullptr) std::abort();
  return heap.shuffles ? std::memset(block, heap.pattern, size) : block;
}

void give_back(void* block) {
  auto* const byte = static_cast<unsigned char*>(block);
  for (std::size_t index = 0; index < kClasses; ++index) {
    Region& region = heap.regions[index];
    if (region.memory == nullptr || byte < region.memory || byte >= region.memory + kRegion) continue;
    const std::size_t size = kLeastSize << index;
    const Lock lock;
    std::memset(block, static_cast<unsigned char>(~heap.pattern), size);
    region.free[region.left++] = static_cast<std::uint32_t>(static_cast<std::size_t>(byte - region.memory) / size);
    return;
  }
  std::free(block);
}

/// Fills with rubbish what asks malloc itself too, where malloc can.
void perturb([[maybe_unused]] int pattern) {
#if defined(M_PERTURB)
  mallopt(M_PERTURB, pattern);
#endif
}

}  // namespace

ShuffledHeap::ShuffledHeap(std::uint64_t seed, unsigned char pattern) {
  const Lock lock;
  heap.state = seed;
  heap.pattern = pattern;
  heap.shuffles = true;
  perturb(pattern);
}
ShuffledHeap::~ShuffledHeap() {
  const Lock lock;
  heap.shuffles = false;
  perturb(0);
}
std::uint64_t ShuffledHeap::blocks() {
  const Lock lock;
  return heap.blocks;
}

}  // namespace isostep::test

void* operator new(std::size_t size) { return isostep::test::take(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return isostep::test::take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { isostep::test::give_back(block); }
void operator delete(void* block, std::size_t) noexcept { isostep::test::give_back(block); }
void operator delete(void* block, std::align_val_t) noexcept { isostep::test::give_back(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { isostep::test::give_back(block); }
