// unit_of_steps: the direction of an integer vector in a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/grid_point.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

namespace detail {
/// To the last digits of U, whatever its length: components below 2^51.
template <class U> ISO_INLINE Vec3<U> unit_of_steps(GridVector v) {
  if constexpr (kIsFixed<U>) {
    const auto d = direction_of(Q32_32::from_raw(v.x), Q32_32::from_raw(v.y), Q32_32::from_raw(v.z));
    constexpr int kBits = decltype(d.x)::kFracBits;
    return {from_lattice<U>(d.x.raw(), kBits), from_lattice<U>(d.y.raw(), kBits), from_lattice<U>(d.z.raw(), kBits)};
  } else {
    return normalise(Vec3<U>{static_cast<U>(v.x), static_cast<U>(v.y), static_cast<U>(v.z)});
  }
}
}  // namespace detail

}  // namespace isostep
