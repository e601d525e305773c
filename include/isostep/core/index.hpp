// A count of 64 bits as an index.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Casts `count`, which is below the length of something in memory. If std::size_t is the type already nothing is cast,
/// as g++ would call that useless.
template <std::unsigned_integral Count> ISO_INLINE constexpr std::size_t as_index(Count count) {
  if constexpr (std::same_as<std::size_t, Count>) return count;
  else return static_cast<std::size_t>(count);
}

}  // namespace isostep
