// Noise: smooth random functions of a point, the same on every machine, without a table.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

// `seed` chooses one of 2^32 functions. Cells have edges of 1; they repeat after 2^32. For cells of
// another size scale p, whose components are finite and below 2^54.

/// Random values at the corners of cells, blended smoothly: within [-1, 1].
template <class S> Unit<S> value_noise(Vec3<S> p, std::uint32_t seed);
/// Random slopes at the corners, where the noise itself is 0: within [-1, 1], of one size of detail.
/// Source:  Perlin 2002, Improving Noise. Differs: corners are hashed, not looked up in a permutation of 256.
template <class S> Unit<S> gradient_noise(Vec3<S> p, std::uint32_t seed);
/// The sum of `octaves` gradient noises, each of half the size and half the height of the one before, all of them
/// over 2: within [-1, 1]. At most 8 octaves: more are not added.
template <class S> Unit<S> fractal_noise(Vec3<S> p, std::uint32_t seed, int octaves);

#define ISO_NOISE_OF(KEYWORD, S)                                   \
  KEYWORD template Unit<S> value_noise(Vec3<S>, std::uint32_t);    \
  KEYWORD template Unit<S> gradient_noise(Vec3<S>, std::uint32_t); \
  KEYWORD template Unit<S> fractal_noise(Vec3<S>, std::uint32_t, int);
#define ISO_EXTERN_NOISE(S) ISO_NOISE_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_NOISE)
#undef ISO_EXTERN_NOISE

}  // namespace isostep
