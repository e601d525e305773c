// Integers to little-endian bytes and back: the one byte order of hashes, files and packets.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/scalar/platform.hpp"

namespace isostep {

using Bytes = std::span<const std::uint8_t>;

/// Stores and loads work by shifts, so that every machine runs the same code; compilers make one instruction of them.
template <std::unsigned_integral U> ISO_INLINE constexpr void store_le(std::uint8_t* at, U value) {
  for (std::size_t i = 0; i < sizeof(U); ++i) at[i] = static_cast<std::uint8_t>(std::uint64_t{value} >> (8 * i));
}
template <std::unsigned_integral U> ISO_INLINE constexpr U load_le(const std::uint8_t* at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(U); ++i) value |= std::uint64_t{at[i]} << (8 * i);
  return static_cast<U>(value);
}

}  // namespace isostep
