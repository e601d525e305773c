// Numbers on a lattice of integers: magnitudes and floors by powers of two, so that cells are counted without rounding.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// Returns the least n with |a| < 2^n, but for zero and subnormal numbers, which get that of the least normal one. a
/// must be finite.
template <class S> ISO_INLINE constexpr int exponent_above(S a) {
  if constexpr (kIsFixed<S>) return static_cast<int>(std::bit_width(detail::magnitude(a.raw()))) - S::kFracBits;
  if constexpr (std::same_as<S, float>) {
    const int field = static_cast<int>(to_bits(a) >> 23 & 0xffu);
    return field == 0 ? -126 : field - 126;
  }
  if constexpr (std::same_as<S, double>) {
    const int field = static_cast<int>(to_bits(a) >> 52 & 0x7ffu);
    return field == 0 ? -1022 : field - 1022;
  }
}

/// floor(a 2^exponent), exact; not above floor(b 2^exponent) for a <= b. |a| 2^exponent < 2^62, and exponent within
/// -126..127 for float, -1022..1023 for double, F-63..F+62 for fixed point with F fraction bits. Where a product is
/// subnormal the floor may be that of zero.
template <class S> ISO_INLINE constexpr std::int64_t floor_scaled(S a, int exponent) {
  if constexpr (kIsFixed<S>) {
    const int left = exponent - S::kFracBits;
    const std::int64_t raw = a.raw();
    return left < 0 ? raw >> -left : static_cast<std::int64_t>(static_cast<std::uint64_t>(raw) << left);
  } else {
    constexpr int kMantissa = std::same_as<S, float> ? 23 : 52;
    constexpr int kBias = std::same_as<S, float> ? 127 : 1023;
    // A product with a power of two is exact, and so is a truncation below 2^62 taken back to S.
    const S power = from_bits<S>(static_cast<RawBits<S>>(exponent + kBias) << kMantissa);
    const S scaled = a * power;
    const std::int64_t whole = static_cast<std::int64_t>(scaled);
    return whole - (scaled < static_cast<S>(whole) ? 1 : 0);
  }
}

/// a 2^exponent to nearest, halves upwards; limits as above, for exponent + 1.
template <class S> ISO_INLINE constexpr std::int64_t nearest_scaled(S a, int exponent) {
  return (floor_scaled(a, exponent + 1) + 1) >> 1;
}
/// Returns the largest exponent up to `finest` at which magnitudes up to `most` are below `limit` steps of 2^-exponent;
/// -1 if they are not at 0.
template <class S> ISO_INLINE constexpr int finest_lattice(S most, std::int64_t limit, int finest) {
  int exponent = finest;
  while (exponent >= 0 && floor_scaled(most, exponent) + 1 >= limit) --exponent;
  return exponent;
}

/// whole 2^-exponent, to nearest, ties of fixed point upwards: exact where S has the digits. It must fit S, and the
/// exponent lie within 0..62.
template <class S> ISO_INLINE constexpr S from_lattice(std::int64_t whole, int exponent) {
  if constexpr (kIsFixed<S>) {
    const int right = exponent - S::kFracBits;
    const std::int64_t raw = right <= 0 ? static_cast<std::int64_t>(static_cast<std::uint64_t>(whole) << -right)
                                        : (whole >> right) + ((whole >> (right - 1)) & 1);
    return S::from_raw(static_cast<typename S::Raw>(raw));
  } else {
    constexpr int kMantissa = std::same_as<S, float> ? 23 : 52;
    constexpr int kBias = std::same_as<S, float> ? 127 : 1023;
    return static_cast<S>(whole) * from_bits<S>(static_cast<RawBits<S>>(kBias - exponent) << kMantissa);
  }
}

}  // namespace isostep
