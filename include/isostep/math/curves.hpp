// Interpolation: straight, smooth, polynomials and cubic curves, of numbers and of vectors.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

// A parameter t lies within [0, 1] unless its function says that it clamps it.

/// a + (b - a) t, rounded once where S is fixed: a and b themselves at the ends, and no difference that could overflow.
template <class S> S lerp(S a, S b, Unit<S> t);
template <class S> Vec3<S> lerp(Vec3<S> a, Vec3<S> b, Unit<S> t);
/// The place of x from a (0) to b (1), clamped; 0 where a is b.
template <class S> Unit<S> inverse_lerp(S a, S b, S x);
/// 3 t^2 - 2 t^3: level at both ends.
template <class U> U smooth_step(U t);
/// 6 t^5 - 15 t^4 + 10 t^3: no curvature at the ends either. Source: Perlin 2002, Improving Noise.
template <class U> U smoother_step(U t);

/// The sum of coefficients[i] x^i (Horner), rounded at every power; of none 0.
template <class S> S polynomial(std::span<const S> coefficients, S x);

/// A cubic from `a` to `b` that leaves with the slope `a_slope` and arrives with `b_slope`, per unit of t.
template <class S> S hermite(S a, S a_slope, S b, S b_slope, Unit<S> t);
template <class S> Vec3<S> hermite(Vec3<S> a, Vec3<S> a_slope, Vec3<S> b, Vec3<S> b_slope, Unit<S> t);
/// Its slope at t.
template <class S> S hermite_slope(S a, S a_slope, S b, S b_slope, Unit<S> t);
template <class S> Vec3<S> hermite_slope(Vec3<S> a, Vec3<S> a_slope, Vec3<S> b, Vec3<S> b_slope, Unit<S> t);
/// A cubic through b (t = 0) and c (t = 1), with the slopes (c - a) / 2 and (d - b) / 2: pieces of a row of points
/// join.
/// Source:  Catmull, Rom 1974, A class of local interpolating splines.
template <class S> S catmull_rom(S a, S b, S c, S d, Unit<S> t);
template <class S> Vec3<S> catmull_rom(Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d, Unit<S> t);
/// A cubic that leaves a (t = 0) towards b and reaches d (t = 1) from c.
template <class S> S bezier(S a, S b, S c, S d, Unit<S> t);
template <class S> Vec3<S> bezier(Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d, Unit<S> t);

#define ISO_CUBICS_OF(KEYWORD, S, T)                     \
  KEYWORD template T lerp(T, T, Unit<S>);                \
  KEYWORD template T hermite(T, T, T, T, Unit<S>);       \
  KEYWORD template T hermite_slope(T, T, T, T, Unit<S>); \
  KEYWORD template T catmull_rom(T, T, T, T, Unit<S>);   \
  KEYWORD template T bezier(T, T, T, T, Unit<S>);
#define ISO_CURVES_OF(KEYWORD, S)                    \
  ISO_CUBICS_OF(KEYWORD, S, S)                       \
  ISO_CUBICS_OF(KEYWORD, S, Vec3<S>)                 \
  KEYWORD template Unit<S> inverse_lerp<S>(S, S, S); \
  KEYWORD template S polynomial(std::span<const S>, S);
#define ISO_UNIT_CURVES_OF(KEYWORD, U) \
  KEYWORD template U smooth_step(U);   \
  KEYWORD template U smoother_step(U);
#define ISO_EXTERN_CURVES(S) ISO_CURVES_OF(extern, S) ISO_UNIT_CURVES_OF(extern, Unit<S>)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_CURVES)
#undef ISO_EXTERN_CURVES

}  // namespace isostep
