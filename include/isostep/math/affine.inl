// Bodies of affine.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/affine.hpp"
#include "isostep/math/rotations.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// Returns the smallest determinant of three unit rows whose inverse fits S: its entries are at most 1 / determinant.
template <class S> ISO_INLINE Unit<S> least_determinant() {
  using U = Unit<S>;
  return max(parallel_sine<U>(), divide_to<U>(S(1), highest<S>()) + resolution<U>());
}
/// Returns true if a / b fits.
template <class S> ISO_INLINE bool divides(S a, S b) {
  return product(abs(a), S(1)) < product(abs(b), highest<S>()) && is_finite(a / b);
}

}  // namespace detail

template <class S> S determinant(const Mat3<S>& m) {
  return pin_floats([&]() -> S { return dot(m.rows[0], cross(m.rows[1], m.rows[2])); });
}

template <class S> Inverse<Mat3<S>> inverse_of(const Mat3<S>& m) {
  return pin_floats([&]() -> Inverse<Mat3<S>> {
    using U = Unit<S>;
    const Inverse<Mat3<S>> none = {Mat3<S>::identity(), false};
    const Heading<S> rows[3] = {heading_of(m.rows[0]), heading_of(m.rows[1]), heading_of(m.rows[2])};
    Vec3<U> columns[3];  // of the adjugate
    for (int i = 0; i < 3; ++i) columns[i] = cross(rows[(i + 1) % 3].direction, rows[(i + 2) % 3].direction);
    const U determinant = dot(rows[0].direction, columns[0]);
    if (!(abs(determinant) > detail::least_determinant<S>())) return none;
    Inverse<Mat3<S>> result = none;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const S of_unit_rows = divide_to<S>(columns[j][i], determinant);
        if (!detail::divides(of_unit_rows, rows[j].length)) return none;
        result.inverse.rows[i][j] = of_unit_rows / rows[j].length;
      }
    }
    result.exists = true;
    return result;
  });
}
template <class S> Inverse<Affine<S>> inverse_of(const Affine<S>& a) {
  return pin_floats([&]() -> Inverse<Affine<S>> {
    const Inverse<Mat3<S>> linear = inverse_of(a.linear);
    if (!linear.exists) return {Affine<S>::identity(), false};
    return {{linear.inverse, -(linear.inverse * a.position)}, true};
  });
}

}  // namespace isostep
