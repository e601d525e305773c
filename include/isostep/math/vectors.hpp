// Vectors for games, beyond sums and products: lengths, projections, angles.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// Returns v, or if it is longer than `most` a vector of that length in the same direction (the book's trim).
template <class S> Vec3<S> clamp_length(Vec3<S> v, S most);
/// Clamps each component to those of low and high.
template <class T> ISO_INLINE constexpr Vec3<T> clamp(Vec3<T> v, Vec3<T> low, Vec3<T> high) {
  return min(max(v, low), high);
}
/// Moves at most `most` nearer to `to`. Returns `to` itself once it is that near.
template <class S> Vec3<S> move_towards(Vec3<S> from, Vec3<S> to, S most);
/// Return the parts of v along the unit vector n and across it. Their sum is v, to one rounding.
template <class S> Vec3<S> project_on_line(Vec3<S> v, Vec3<Unit<S>> n);
template <class S> Vec3<S> project_on_plane(Vec3<S> v, Vec3<Unit<S>> n);
/// Returns v mirrored at a plane with the unit normal n.
template <class S> Vec3<S> reflect(Vec3<S> v, Vec3<Unit<S>> n);
/// Returns the angle [rad] of two vectors of any lengths, 0 to pi, with all digits near 0 and pi; 0 if one is zero.
template <class S> S angle_between(Vec3<S> a, Vec3<S> b);
/// Returns the angle with the sign of the turn from a to b about `axis`: positive if (a x b) . axis is.
template <class S> S signed_angle(Vec3<S> a, Vec3<S> b, Vec3<S> axis);

#define ISO_VECTORS_OF(KEYWORD, S)                                      \
  KEYWORD template Vec3<S> clamp_length(Vec3<S>, S);                    \
  KEYWORD template Vec3<S> move_towards(Vec3<S>, Vec3<S>, S);           \
  KEYWORD template Vec3<S> project_on_line<S>(Vec3<S>, Vec3<Unit<S>>);  \
  KEYWORD template Vec3<S> project_on_plane<S>(Vec3<S>, Vec3<Unit<S>>); \
  KEYWORD template Vec3<S> reflect<S>(Vec3<S>, Vec3<Unit<S>>);          \
  KEYWORD template S angle_between(Vec3<S>, Vec3<S>);                   \
  KEYWORD template S signed_angle(Vec3<S>, Vec3<S>, Vec3<S>);
#define ISO_EXTERN_VECTORS(S) ISO_VECTORS_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_VECTORS)
#undef ISO_EXTERN_VECTORS

}  // namespace isostep
