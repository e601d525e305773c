// Affine<S>: a linear map and a translation (the book's 3x4 matrix), with inverses that say when there is none.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// p -> linear p + position [m]. Scales, shears and mirrors as well; for rigid motions Transform is quicker and exact.
template <class S> struct Affine {
  Mat3<S> linear;
  Vec3<S> position;

  static ISO_INLINE constexpr Affine identity() { return {Mat3<S>::identity(), Vec3<S>::zero()}; }
  /// Maps a point, or a direction, which does not move with the frame.
  ISO_INLINE constexpr Vec3<S> point(Vec3<S> p) const { return position + linear * p; }
  ISO_INLINE constexpr Vec3<S> direction(Vec3<S> v) const { return linear * v; }
};
/// Returns the map of `inner`, followed by that of `outer`.
template <class S> ISO_INLINE constexpr Affine<S> compose(const Affine<S>& outer, const Affine<S>& inner) {
  return {outer.linear * inner.linear, outer.point(inner.position)};
}
template <class S> ISO_INLINE constexpr Affine<S> affine_of(const Transform<S>& t) {
  const auto row = [&](int i) ISO_INLINE_LAMBDA { return convert<S>(t.rotation.rows[i]); };
  return {{{row(0), row(1), row(2)}}, t.position};
}

/// Returns the determinant. In fixed point every product of three entries must fit S.
template <class S> S determinant(const Mat3<S>& m);

template <class M> struct Inverse {
  M inverse;  // the identity where there is none
  bool exists;
};
/// Rows of any length are brought to length 1 first, so that sizes cost no digits. None: three rows in a plane, to some
/// sixteen steps of the format of directions, or an inverse that does not fit S.
template <class S> Inverse<Mat3<S>> inverse_of(const Mat3<S>& m);
template <class S> Inverse<Affine<S>> inverse_of(const Affine<S>& a);

#define ISO_AFFINE_OF(KEYWORD, S)                               \
  KEYWORD template S determinant(const Mat3<S>&);               \
  KEYWORD template Inverse<Mat3<S>> inverse_of(const Mat3<S>&); \
  KEYWORD template Inverse<Affine<S>> inverse_of(const Affine<S>&);
#define ISO_EXTERN_AFFINE(S) ISO_AFFINE_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_AFFINE)
#undef ISO_EXTERN_AFFINE

}  // namespace isostep
