// Bodies of curves.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/curves.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

/// The weights of four points at t. Every weight fits Unit<S>.
template <class U> struct CubicWeights { U a, b, c, d; };

template <class S> ISO_INLINE S mixed(S a, S b, S c, S d, CubicWeights<Unit<S>> w) {
  return round_to<S>(product(a, w.a) + product(b, w.b) + product(c, w.c) + product(d, w.d));
}
template <class S> ISO_INLINE Vec3<S> mixed(Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d, CubicWeights<Unit<S>> w) {
  return {mixed(a.x, b.x, c.x, d.x, w), mixed(a.y, b.y, c.y, d.y, w), mixed(a.z, b.z, c.z, d.z, w)};
}
template <class U> ISO_INLINE CubicWeights<U> hermite_weights(U t) {
  const U u = U(1) - t, risen = smooth_step(t);
  return {U(1) - risen, t * u * u, risen, -(t * t * u)};
}
template <class U> ISO_INLINE CubicWeights<U> hermite_slopes(U t) {
  const U u = U(1) - t, tu = t * u, steep = tu + tu + tu + tu + tu + tu;  // at most 1.5
  return {-steep, u * (u - t - t), steep, t * (t - u - u)};
}
template <class U> ISO_INLINE CubicWeights<U> catmull_rom_weights(U t) {
  const CubicWeights<U> w = hermite_weights(t);
  const U at_b = w.b * U(0.5), at_c = w.d * U(0.5);
  return {-at_b, w.a - at_c, w.c + at_b, at_c};
}
template <class U> ISO_INLINE CubicWeights<U> bezier_weights(U t) {
  const U u = U(1) - t, tu = t * u, near_b = tu * u, near_c = tu * t;
  return {u * u * u, near_b + near_b + near_b, near_c + near_c + near_c, t * t * t};
}
template <class S> ISO_INLINE S number_between(S a, S b, Unit<S> t) {
  return round_to<S>(product(a, Unit<S>(1) - t) + product(b, t));
}

}  // namespace detail

template <class S> S lerp(S a, S b, Unit<S> t) {
  return pin_floats([&]() -> S { return detail::number_between(a, b, t); });
}
template <class S> Vec3<S> lerp(Vec3<S> a, Vec3<S> b, Unit<S> t) {
  return pin_floats([&]() -> Vec3<S> {
    using detail::number_between;
    return {number_between(a.x, b.x, t), number_between(a.y, b.y, t), number_between(a.z, b.z, t)};
  });
}
template <class S> Unit<S> inverse_lerp(S a, S b, S x) {
  return pin_floats([&]() -> Unit<S> {
    using U = Unit<S>;
    if (a == b) return U(0);
    const bool rises = a < b;
    if (rises ? x <= a : a <= x) return U(0);
    if (rises ? b <= x : x <= b) return U(1);
    return divide_to<U>(x - a, b - a);
  });
}
template <class U> U smooth_step(U t) {
  return pin_floats([&]() -> U {
    const U square = t * t, rest = square * (U(1) - t);
    return square + rest + rest;
  });
}
template <class U> U smoother_step(U t) {
  return pin_floats([&]() -> U {
    const U u = U(1) - t, cube = t * t * t, next = cube * u, last = next * u;  // t^3 (1 + 3 u + 6 u^2)
    const U thrice = last + last + last;
    return cube + next + next + next + thrice + thrice;
  });
}

template <class S> S polynomial(std::span<const S> coefficients, S x) {
  return pin_floats([&]() -> S {
    S sum = S(0);
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
  });
}

#define ISO_CUBIC(name, weights)                                                           \
  template <class S> S name(S a, S b, S c, S d, Unit<S> t) {                               \
    return pin_floats([&] { return detail::mixed(a, b, c, d, weights(t)); });              \
  }                                                                                        \
  template <class S> Vec3<S> name(Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d, Unit<S> t) { \
    return pin_floats([&] { return detail::mixed(a, b, c, d, weights(t)); });              \
  }
ISO_CUBIC(hermite, detail::hermite_weights)
ISO_CUBIC(hermite_slope, detail::hermite_slopes)
ISO_CUBIC(catmull_rom, detail::catmull_rom_weights)
ISO_CUBIC(bezier, detail::bezier_weights)
#undef ISO_CUBIC

}  // namespace isostep
