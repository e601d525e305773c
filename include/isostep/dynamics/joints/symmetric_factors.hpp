// L D L^T of a symmetric 3 x 3 matrix: what blocks of joints are solved with.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

template <class S> ISO_INLINE S reciprocal(S a) { return S(1) / a; }

/// The factors of a symmetric matrix. T may be lanes.
/// Symbols: m = L D L^T, L = [1; l10 1; l20 l21 1], D = 1 / (i0, i1, i2).
template <class T> struct SymmetricFactors {
  T l10, l20, l21, i0, i1, i2;

  /// Returns the inverse, for products with vectors. Its relative error is the format's times largest over least pivot.
  ISO_INLINE Mat3<T> inverse() const {
    // L^-1 = [1; -l10 1; l10 l21 - l20, -l21, 1]
    const T n20 = l10 * l21 - l20;
    const T zz = i2, yz = -(l21 * i2), xz = n20 * i2;
    const T yy = i1 - l21 * yz;
    const T xy = -(l10 * i1) - l21 * xz;
    const T xx = i0 + round_to<T>(product(l10 * l10, i1) + product(n20, xz));
    return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
  }
  /// Returns m^-1 b, for b^T m^-1 b: what eliminating this block subtracts from linked blocks.
  /// Why: the solution is exact for a matrix near m, so that along directions that m hardly moves its error is as small
  ///      as b is there. A product with the inverse is not: if a light body on a long arm carries many heavy ones, that
  ///      leaves noise instead of their weight.
  ISO_INLINE Mat3<T> solve(const Mat3<T>& b) const {
    const auto less = [](Vec3<T> v, T l, Vec3<T> w) ISO_INLINE_LAMBDA {
      return Vec3<T>{v.x - l * w.x, v.y - l * w.y, v.z - l * w.z};
    };
    const Vec3<T> y = less(b.rows[1], l10, b.rows[0]);
    const Vec3<T> z = less(less(b.rows[2], l20, b.rows[0]), l21, y) * i2;
    const Vec3<T> up = less(y * i1, l21, z);
    return {{less(less(b.rows[0] * i0, l20, z), l10, up), up, z}};
  }
};

/// Returns a in the lanes of the mask, b in the others.
template <class Mask, class T>
ISO_INLINE SymmetricFactors<T> select(Mask mask, const SymmetricFactors<T>& a, const SymmetricFactors<T>& b) {
  return {select(mask, a.l10, b.l10), select(mask, a.l20, b.l20), select(mask, a.l21, b.l21),
          select(mask, a.i0, b.i0),   select(mask, a.i1, b.i1),   select(mask, a.i2, b.i2)};
}

/// Factors a symmetric positive definite matrix plus `softness` times the identity, from the upper triangle.
/// Method: pivots stay near one where a determinant would vanish in fixed point. A pivot that rounding took below the
///         softness is held there: such a direction moves nothing.
/// Error:  measured in tests/unit/dynamics/joints_test.cpp.
template <class T> ISO_INLINE SymmetricFactors<T> factor_symmetric(const Mat3<T>& m, T softness) {
  SymmetricFactors<T> f;
  f.i0 = reciprocal(max(m.rows[0].x + softness, softness));
  f.l10 = m.rows[0].y * f.i0;
  f.l20 = m.rows[0].z * f.i0;
  f.i1 = reciprocal(max(m.rows[1].y + softness - f.l10 * m.rows[0].y, softness));
  const T e = m.rows[1].z - f.l10 * m.rows[0].z;
  f.l21 = e * f.i1;
  f.i2 =
      reciprocal(max(m.rows[2].z + softness - round_to<T>(product(f.l20, m.rows[0].z) + product(f.l21, e)), softness));
  return f;
}
template <class T> ISO_INLINE Mat3<T> invert_symmetric(const Mat3<T>& m, T softness) {
  return factor_symmetric(m, softness).inverse();
}

}  // namespace isostep
