// A heap that hands out addresses in an order of its seed, full of rubbish: for tests that no address and no byte that
// nobody wrote decides anything.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::test {

/// A hostile heap: while one lives, `new` of this program, on every thread, takes its blocks from anywhere in its
/// regions and fills them with the pattern; what is freed is filled with its complement. One at a time.
class ShuffledHeap {
 public:
  ShuffledHeap(std::uint64_t seed, unsigned char pattern);
  ~ShuffledHeap();
  ShuffledHeap(const ShuffledHeap&) = delete;
  ShuffledHeap& operator=(const ShuffledHeap&) = delete;

  /// Blocks handed out so far.
  static std::uint64_t blocks();
};

}  // namespace isostep::test
