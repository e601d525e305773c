// Integers to bytes and back: little-endian, the one byte order of hashes, files and packets, or as short as they are.
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

inline constexpr std::size_t kLongestLeb128 = 10;  // [bytes] 64 bits, seven a byte

/// LEB128 (DWARF 5, 7.6): seven bits a byte, the lowest first; all bytes but the last have the high bit. Writes at most
/// kLongestLeb128 bytes and returns where they end.
ISO_INLINE constexpr std::uint8_t* store_leb128(std::uint8_t* at, std::uint64_t value) {
  for (; value >= 128; value >>= 7) *at++ = static_cast<std::uint8_t>(value | 128u);
  *at++ = static_cast<std::uint8_t>(value);
  return at;
}

enum class Leb128Flaw : std::uint8_t { none, cut, overlong, too_large };
/// A number as it stands at the front of some bytes. With a flaw value and size are 0.
struct Leb128 {
  std::uint64_t value = 0;
  std::size_t size = 0;  // [bytes]
  Leb128Flaw flaw = Leb128Flaw::none;
};
/// Each number up to `most` has one form, the shortest: longer ones are overlong.
ISO_INLINE constexpr Leb128 load_leb128(Bytes bytes, std::uint64_t most) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kLongestLeb128; ++i) {
    if (i == bytes.size()) return {0, 0, Leb128Flaw::cut};
    const std::uint64_t bits = bytes[i] & 127u, shift = 7 * i;
    value |= bits << shift;
    if (bytes[i] >= 128) continue;
    if (bits == 0 && i > 0) return {0, 0, Leb128Flaw::overlong};
    if (value > most || value >> shift != bits) return {0, 0, Leb128Flaw::too_large};
    return {value, i + 1, Leb128Flaw::none};
  }
  return {0, 0, Leb128Flaw::too_large};
}

}  // namespace isostep
