// Whole numbers in the words that a program is called by.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Reads a number of decimal digits only. Returns false for anything else, and from 2^64 - 6 on.
ISO_INLINE constexpr bool read_number(std::string_view text, std::uint64_t& number) {
  constexpr std::uint64_t kLargest = (~std::uint64_t{0} - 9) / 10;  // to which any digit may be added
  number = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || number > kLargest) return false;
    number = 10 * number + static_cast<std::uint64_t>(c - '0');
  }
  return !text.empty();
}

}  // namespace isostep
