// A count of 64 bits as an index.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// `count` is below the length of something in memory. Where std::size_t is this type already, nothing is cast, which
/// g++ would call useless.
template <std::unsigned_integral Count> ISO_INLINE constexpr std::size_t as_index(Count count) {
  if constexpr (std::same_as<std::size_t, Count>) return count;
  else return static_cast<std::size_t>(count);
}

}  // namespace isostep
