// Random numbers, directions and rotations of a scalar, each from a fixed count of draws but where that is said.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/core/random.hpp"
#include "isostep/math/quat.hpp"

namespace isostep {

// R is Lcg or Pcg32. Whole numbers and uniform ones: core/random.hpp.

/// Normally distributed, of mean 0 and deviation 1, within +-5.8. Two draws; one more in 2^24 times.
/// Source:  Box, Muller 1958, A Note on the Generation of Random Normal Deviates.
template <class S, class R> S random_normal(R& random);
/// A unit vector, each direction as likely as another. Two draws. Source: Archimedes: heights on a sphere are uniform.
template <class S, class R> Vec3<Unit<S>> random_direction(R& random);
/// A point in a ball about the origin, each volume as likely as another. Five draws: of three uniform numbers the
/// largest is distributed as the cube root of one.
template <class S, class R> Vec3<S> random_in_ball(R& random, S radius);
/// A point in the disc across y about the origin. Three draws.
template <class S, class R> Vec3<S> random_in_disc(R& random, S radius);
/// Components between those of low and high. Three draws.
template <class S, class R> Vec3<S> random_in_box(R& random, Vec3<S> low, Vec3<S> high);
/// A rotation, each as likely as another. Three draws. Source: Shoemake 1992, Uniform Random Rotations, Graphics Gems
/// III.
template <class S, class R> Quat<Unit<S>> random_rotation(R& random);

/// Puts count things in any order, each as likely as another (Fisher, Yates): count - 1 draws, rarely more.
template <class T, RandomSource R> ISO_INLINE constexpr void shuffle(T* things, std::uint32_t count, R& random) {
  for (std::uint32_t left = count; left > 1; --left) {
    const std::uint32_t chosen = random_below(random, left);
    T moved = static_cast<T&&>(things[chosen]);
    things[chosen] = static_cast<T&&>(things[left - 1]);
    things[left - 1] = static_cast<T&&>(moved);
  }
}

#define ISO_DRAWS_BY(KEYWORD, S, R)                             \
  KEYWORD template S random_normal<S>(R&);                      \
  KEYWORD template Vec3<Unit<S>> random_direction<S>(R&);       \
  KEYWORD template Vec3<S> random_in_ball(R&, S);               \
  KEYWORD template Vec3<S> random_in_disc(R&, S);               \
  KEYWORD template Vec3<S> random_in_box(R&, Vec3<S>, Vec3<S>); \
  KEYWORD template Quat<Unit<S>> random_rotation<S>(R&);
#define ISO_DRAWS_OF(KEYWORD, S) ISO_DRAWS_BY(KEYWORD, S, Lcg) ISO_DRAWS_BY(KEYWORD, S, Pcg32)
#define ISO_EXTERN_DRAWS(S) ISO_DRAWS_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_DRAWS)
#undef ISO_EXTERN_DRAWS

}  // namespace isostep
