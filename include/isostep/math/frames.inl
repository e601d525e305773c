// Bodies of frames.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/frames.hpp"
#include "isostep/math/rotations.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {

template <class S> Basis<Unit<S>> basis_of(Vec3<S> a, Vec3<S> b) {
  return pin_floats([&]() -> Basis<Unit<S>> {
    using U = Unit<S>;
    const Vec3<U> x = normalise(a);
    const Heading<U> across = heading_of(cross(x, normalise(b)));
    if (!(across.length > detail::parallel_sine<U>())) return {Mat3<U>::identity(), false};
    const Vec3<U> z = detail::perpendicular(across.direction, x);
    return {transpose(Mat3<U>{{x, cross(z, x), z}}), true};
  });
}
template <class S> Mat3<S> change_of_basis(const Mat3<Unit<S>>& r, const Mat3<S>& m) {
  return pin_floats([&]() -> Mat3<S> { return r * m * transpose(r); });
}

}  // namespace isostep
