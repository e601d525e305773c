// AlignedBytes: one array of bytes that begins at a cache line, for records whose size is known when they are laid out.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Scratch: what it holds is lost when it grows.
class AlignedBytes {
 public:
  static constexpr std::size_t kAlignment = 64;  // [bytes] a cache line, and the widest register

  ISO_INLINE void resize(std::size_t size) { bytes_.resize(size + kAlignment); }
  ISO_INLINE unsigned char* data() {
    const std::size_t past = reinterpret_cast<std::uintptr_t>(bytes_.data()) % kAlignment;
    return bytes_.data() + (past == 0 ? 0 : kAlignment - past);
  }

 private:
  std::vector<unsigned char> bytes_;
};

}  // namespace isostep
