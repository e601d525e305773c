// Directions of vectors of integers.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class U> struct LatticeDirection { U x, y, z; };

/// Returns the direction, of unit length, rounded once by way of the finest unit format, also for floating scalars. A
/// vector of zeros has none. Components are below 2^51.
template <class U>
ISO_INLINE LatticeDirection<U> exact_lattice_direction(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto d = direction_of(Q32_32::from_raw(x), Q32_32::from_raw(y), Q32_32::from_raw(z));
  constexpr int kBits = decltype(d.x)::kFracBits;
  return {from_lattice<U>(d.x.raw(), kBits), from_lattice<U>(d.y.raw(), kBits), from_lattice<U>(d.z.raw(), kBits)};
}
/// Returns the direction to the last digits of U, by the shortest way: for what every step computes.
template <class U> ISO_INLINE LatticeDirection<U> lattice_direction(std::int64_t x, std::int64_t y, std::int64_t z) {
  if constexpr (kIsFixed<U>) {
    return exact_lattice_direction<U>(x, y, z);
  } else {
    const auto d = direction_of(static_cast<U>(x), static_cast<U>(y), static_cast<U>(z));
    return {d.x, d.y, d.z};
  }
}

}  // namespace isostep
