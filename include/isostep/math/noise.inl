// Bodies of noise.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/curves.inl"
#include "isostep/math/noise.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {
namespace detail {

inline constexpr int kMostOctaves = 8;  // cells of 2^-7: what Q16.16 still divides into 512 parts

/// Source:  Wellons 2018, Prospecting for Hash Functions: lowbias32.
ISO_INLINE constexpr std::uint32_t mixed_bits(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
/// The place of a point among cells with edges of 2^-octave.
template <class U> struct NoiseCell {
  std::uint32_t corner[3];  // the lowest, modulo 2^32
  Vec3<U> within;           // [0, 1)

  ISO_INLINE std::uint32_t hash(int i, std::uint32_t seed) const {
    std::uint32_t h = seed;
    for (int axis = 0; axis < 3; ++axis) h = mixed_bits(h ^ (corner[axis] + static_cast<std::uint32_t>(i >> axis & 1)));
    return h;
  }
};
template <class S> ISO_INLINE NoiseCell<Unit<S>> cell_of(Vec3<S> p, int octave) {
  NoiseCell<Unit<S>> cell;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t whole = floor_scaled(p[axis], octave);
    cell.corner[axis] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(whole));
    const S rest = p[axis] - from_lattice<S>(whole, octave);
    cell.within[axis] = convert<Unit<S>>(rest * S(1 << octave));
  }
  return cell;
}
/// Blends eight values at a cell's corners, x fastest.
template <class U> ISO_INLINE U blended(const U (&corners)[8], Vec3<U> within) {
  U values[8];
  for (int i = 0; i < 8; ++i) values[i] = corners[i];
  for (int axis = 0; axis < 3; ++axis) {
    const U t = smoother_step(within[axis]);
    for (int i = 0; i < 4 >> axis; ++i) values[i] = lerp(values[2 * i], values[2 * i + 1], t);
  }
  return values[0];
}
/// Half the product of one of twelve slopes, towards the middle of a cube's edges, and the way from its corner.
template <class U> ISO_INLINE U half_slope(std::uint32_t hash, Vec3<U> way) {
  const int left_out = static_cast<int>((std::uint64_t{hash} * 3) >> 32);
  const U a = way[(left_out + 1) % 3] * U(0.5), b = way[(left_out + 2) % 3] * U(0.5);
  return ((hash & 1) != 0 ? a : -a) + ((hash & 2) != 0 ? b : -b);
}
/// Half of it: within [-1/2, 1/2].
template <class S> ISO_INLINE Unit<S> half_gradient_noise(Vec3<S> p, std::uint32_t seed, int octave) {
  using U = Unit<S>;
  const NoiseCell<U> cell = cell_of(p, octave);
  U corners[8];
  for (int i = 0; i < 8; ++i) {
    const Vec3<U> corner = {U(i & 1), U(i >> 1 & 1), U(i >> 2 & 1)};
    corners[i] = half_slope(cell.hash(i, seed), cell.within - corner);
  }
  return clamp(blended(corners, cell.within), U(-0.5), U(0.5));
}

}  // namespace detail

template <class S> Unit<S> value_noise(Vec3<S> p, std::uint32_t seed) {
  return pin_floats([&]() -> Unit<S> {
    using U = Unit<S>;
    const detail::NoiseCell<U> cell = detail::cell_of(p, 0);
    U corners[8];
    for (int i = 0; i < 8; ++i)
      corners[i] = from_lattice<U>(static_cast<std::int32_t>(cell.hash(i, seed)) >> 8, 23);  // 24 bits: exact in float
    return detail::blended(corners, cell.within);
  });
}
template <class S> Unit<S> gradient_noise(Vec3<S> p, std::uint32_t seed) {
  return pin_floats([&]() -> Unit<S> {
    const Unit<S> half = detail::half_gradient_noise(p, seed, 0);
    return half + half;
  });
}
template <class S> Unit<S> fractal_noise(Vec3<S> p, std::uint32_t seed, int octaves) {
  return pin_floats([&]() -> Unit<S> {
    using U = Unit<S>;
    U sum = U(0), height = U(1);
    for (int octave = 0; octave < octaves && octave < detail::kMostOctaves; ++octave) {
      sum += detail::half_gradient_noise(p, seed + static_cast<std::uint32_t>(octave), octave) * height;
      height = height * U(0.5);
    }
    return sum;
  });
}

}  // namespace isostep
