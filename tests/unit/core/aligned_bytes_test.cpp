// Memory that begins at a cache line, whatever its size and however it grew.
// SPDX-License-Identifier: MIT
#include "isostep/core/aligned_bytes.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace isostep {
namespace aligned_bytes_test {

TEST(AlignedBytes, BeginAtACacheLineAndHoldWhatWasAskedFor) {
  AlignedBytes bytes;
  for (const std::size_t size : {0u, 1u, 63u, 64u, 65u, 1000u, 100000u, 128u}) {
    bytes.resize(size);
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(bytes.data()) % AlignedBytes::kAlignment, 0u) << size;
    std::memset(bytes.data(), 0x5a, size);  // a sanitizer sees what lies outside
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(bytes.data()[i], 0x5a);
  }
}

}  // namespace aligned_bytes_test
}  // namespace isostep
