// Elementary functions with one result on every machine: square roots and normalising inline, the rest compiled once.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>

#include "isostep/scalar/rsqrt.hpp"
#include "isostep/scalar/scalar.hpp"

#if defined(__SSE2__) || defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP == 2)
#include <emmintrin.h>
#elif defined(__aarch64__) || defined(_M_ARM64)
#include <arm_neon.h>
#endif

namespace isostep {

// ---- square roots

/// Square root to nearest, by the processor's own instruction: IEEE 754 leaves it no choice. Negative gives NaN.
/// A target not named here gets __builtin_sqrt: the instruction on WebAssembly and others, except that without
/// -fno-math-errno a negative argument may reach the C library, whose NaN is the same.
ISO_INLINE float sqrt(float x) {
#if defined(__SSE2__) || defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP == 2)
  return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
#elif defined(__aarch64__) || defined(_M_ARM64)
  return vget_lane_f32(vsqrt_f32(vdup_n_f32(x)), 0);
#else
  return __builtin_sqrtf(x);
#endif
}
ISO_INLINE double sqrt(double x) {
#if defined(__SSE2__) || defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP == 2)
  const __m128d wide = _mm_set_sd(x);
  return _mm_cvtsd_f64(_mm_sqrt_sd(wide, wide));
#elif defined(__aarch64__) || defined(_M_ARM64)
  return vget_lane_f64(vsqrt_f64(vdup_n_f64(x)), 0);
#else
  return __builtin_sqrt(x);
#endif
}
/// The square root to nearest for every format, by trial of the exact square; a tie cannot occur. Negative gives 0.
template <class Rep, int F, Overflow P> ISO_INLINE constexpr Fixed<Rep, F, P> sqrt(Fixed<Rep, F, P> x) {
  if (x.raw() <= 0) return Fixed<Rep, F, P>::from_raw(0);
  const auto u = static_cast<std::uint64_t>(x.raw());
  const int zeros = detail::leading_zeros(u);
  const int k = zeros - ((zeros ^ F) & 1);  // makes the exponent of 2 under the root even
  const std::uint64_t m = u << k;
  const std::uint64_t root = detail::multiply_high(m, detail::rsqrt_q64(m));  // [2^62, 2^63)
  const std::uint64_t guess = detail::shift_right_rounded(root, 62 - (62 - k + F) / 2);
  std::uint64_t s;
  if constexpr (F <= 48) {  // the guess is within 1, so n - guess^2 fits 64 bits though n may not
    s = detail::nearest_root(static_cast<std::int64_t>((u << F) - guess * guess), guess);
  } else {
    const Int128 n = int128_from(multiply(u, std::uint64_t{1} << F));
    s = detail::nearest_root(n - int128_from(multiply(guess, guess)), guess);
  }
  return Fixed<Rep, F, P>::from_raw(static_cast<Rep>(s));
}

/// 1 / sqrt(x). float, double: two roundings, within 1.5 ulp; 0 gives infinity.
template <std::floating_point S> ISO_INLINE S rsqrt(S x) { return S(1) / sqrt(x); }
/// Fixed: within 0.51 ulp while F <= 56, 1 ulp for Unit<S>. Zero, negative and what does not fit give highest().
template <class Rep, int F, Overflow P> ISO_INLINE constexpr Fixed<Rep, F, P> rsqrt(Fixed<Rep, F, P> x) {
  if (x.raw() <= 0) return Fixed<Rep, F, P>::highest();
  const auto u = static_cast<std::uint64_t>(x.raw());
  const int zeros = detail::leading_zeros(u);
  const int k = zeros - ((zeros ^ F) & 1);
  const int shift = 64 - (3 * F - 62 + k) / 2;
  if (shift < 0) return Fixed<Rep, F, P>::highest();
  const std::uint64_t r = detail::shift_right_rounded(detail::rsqrt_q64(u << k), shift);
  constexpr auto highest = static_cast<std::uint64_t>(std::numeric_limits<Rep>::max());
  return Fixed<Rep, F, P>::from_raw(static_cast<Rep>(r < highest ? r : highest));
}

// ---- directions

/// The direction and the length of a vector. For the zero vector all are zero.
template <class S> struct Direction {
  Unit<S> x, y, z;  // [1]
  S length;         // in the vector's unit
};

namespace detail {

/// 1/sqrt of a sum of squares q, ready to multiply its terms: component = (c << half) y / 2^64 in Q1.63.
struct InverseLength {
  std::uint64_t m;  // q 2^(2 half) / 2^64 to nearest, in [2^62, 2^64)
  std::uint64_t y;  // 2^64 / sqrt(m / 2^62)
  int half;
};
/// m to nearest and y within a unit make the error of a component of size 1 less than 1/2 ulp: a vector along an axis
/// has exactly that axis for its direction.
ISO_INLINE constexpr InverseLength inverse_length(UInt128Parts q) {
  const int zeros = leading_zeros(q) & ~1;
  const UInt128Parts shifted = shift_left(q, zeros);
  const std::uint64_t rounded = shifted.high + (shifted.low >> 63);
  const std::uint64_t m = rounded - (rounded == 0 ? 1u : 0u);
  return {m, rsqrt_q64(m), zeros / 2};
}
template <class U> ISO_INLINE constexpr U scaled_component(std::int64_t c, InverseLength inverse) {
  constexpr int drop = 63 - U::kFracBits;
  const std::uint64_t fine = multiply_high(magnitude(c) << inverse.half, inverse.y);
  const auto size = static_cast<std::int64_t>((fine + (std::uint64_t{1} << (drop - 1))) >> drop);
  const std::int64_t sign = c >> 63;
  return U::from_raw(static_cast<typename U::Raw>((size ^ sign) - sign));
}
ISO_INLINE constexpr UInt128Parts squared(std::int64_t a) { return multiply(magnitude(a), magnitude(a)); }
ISO_INLINE constexpr std::uint64_t squared32(std::int64_t a) { return static_cast<std::uint64_t>(a * a); }

/// sqrt(q) to nearest. Below 2^58 the difference from the guess's square fits 64 bits.
ISO_INLINE constexpr std::uint64_t length_of(UInt128Parts q, InverseLength inverse) {
  const std::uint64_t root = multiply_high(inverse.m, inverse.y);
  const std::uint64_t guess = shift_right_rounded(root << 1, inverse.half);
  if (inverse.half >= 6) return nearest_root(static_cast<std::int64_t>(q.low - guess * guess), guess);
  return nearest_root(int128_from(subtract(q, multiply(guess, guess))), guess);
}

/// Powers of two that bring the squares of a vector with squared length n2 into range, and their inverses.
template <class S> struct Rescale { S up, down; };
template <class S> struct RescaleLimits;
template <> struct RescaleLimits<float> {
  static constexpr float kLow = 0x1p-100f, kHigh = 0x1p120f;
  static constexpr Rescale<float> kTiny = {0x1p100f, 0x1p-100f}, kHuge = {0x1p-70f, 0x1p70f};
};
template <> struct RescaleLimits<double> {
  static constexpr double kLow = 0x1p-900, kHigh = 0x1p1000;
  static constexpr Rescale<double> kTiny = {0x1p600, 0x1p-600}, kHuge = {0x1p-600, 0x1p600};
};
template <class S> ISO_INLINE Rescale<S> rescale(S n2) {
  using Limits = RescaleLimits<S>;
  if (n2 < Limits::kLow) return {Limits::kTiny.up, Limits::kTiny.down};
  if (n2 > Limits::kHigh) return {Limits::kHuge.up, Limits::kHuge.down};
  return {S(1), S(1)};
}

}  // namespace detail

/// Direction and length of (x, y, z), whatever its magnitude: down to one raw unit, up to the format's ends.
/// Error:  fixed: components < 2 ulp of Unit<S>, length to nearest, highest() when it does not fit;
///         float, double: components < 2.5 ulp, length < 1.5 ulp. Measured in tests/unit/scalar/math_test.cpp. A
///         fixed-point vector along an axis gives exactly that axis.
/// Limits: float, double: a length above the largest number is infinite, its direction still right. Where squares would
///         leave the range, components below 2^-40 of the length may lose digits.
template <class Rep, int F, Overflow P>
ISO_INLINE constexpr Direction<Fixed<Rep, F, P>> direction_of(Fixed<Rep, F, P> x, Fixed<Rep, F, P> y,
                                                              Fixed<Rep, F, P> z) {
  using S = Fixed<Rep, F, P>;
  UInt128Parts q;
  if constexpr (sizeof(Rep) == 4) {  // at most 3 2^62
    q = {0, detail::squared32(x.raw()) + detail::squared32(y.raw()) + detail::squared32(z.raw())};
  } else {  // at most 3 2^126
    q = detail::add(detail::add(detail::squared(x.raw()), detail::squared(y.raw())), detail::squared(z.raw()));
  }
  if ((q.high | q.low) == 0) {
    const Unit<S> zero = Unit<S>::from_raw(0);
    return {zero, zero, zero, S::from_raw(0)};
  }
  const detail::InverseLength inverse = detail::inverse_length(q);
  constexpr auto highest = static_cast<std::uint64_t>(std::numeric_limits<Rep>::max());
  const std::uint64_t length = detail::length_of(q, inverse);
  return {detail::scaled_component<Unit<S>>(x.raw(), inverse), detail::scaled_component<Unit<S>>(y.raw(), inverse),
          detail::scaled_component<Unit<S>>(z.raw(), inverse),
          S::from_raw(static_cast<Rep>(length < highest ? length : highest))};
}
template <std::floating_point S> ISO_INLINE Direction<S> direction_of(S x, S y, S z) {
  const S plain = x * x + y * y + z * z;
  const detail::Rescale<S> scale = detail::rescale(plain);
  const S a = x * scale.up;
  const S b = y * scale.up;
  const S c = z * scale.up;
  const S length = sqrt(a * a + b * b + c * c);
  if (length == S(0)) return {S(0), S(0), S(0), S(0)};
  return {a / length, b / length, c / length, length * scale.down};
}

/// Scales a quaternion to unit norm. Zero becomes the identity (0, 0, 0, 1).
/// Range:  norm at most 2; intended for [1/4, 2], where float and double cannot under- or overflow.
/// Error:  components < 2 ulp of U (fixed), < 3 ulp (float, double).
template <class Rep, int F, Overflow P>
ISO_INLINE constexpr void normalise4(Fixed<Rep, F, P>& x, Fixed<Rep, F, P>& y, Fixed<Rep, F, P>& z,
                                     Fixed<Rep, F, P>& w) {
  using U = Fixed<Rep, F, P>;
  static_assert(F == U::kBits - 2, "a quaternion's components are Unit<S>");
  UInt128Parts q;
  if constexpr (sizeof(Rep) == 4) {
    q = {0, detail::squared32(x.raw()) + detail::squared32(y.raw()) + detail::squared32(z.raw()) +
                detail::squared32(w.raw())};
  } else {
    q = detail::add(detail::add(detail::squared(x.raw()), detail::squared(y.raw())),
                    detail::add(detail::squared(z.raw()), detail::squared(w.raw())));
  }
  if ((q.high | q.low) == 0) {
    w = U::from_raw(Rep{1} << F);
    return;
  }
  const detail::InverseLength inverse = detail::inverse_length(q);
  x = detail::scaled_component<U>(x.raw(), inverse);
  y = detail::scaled_component<U>(y.raw(), inverse);
  z = detail::scaled_component<U>(z.raw(), inverse);
  w = detail::scaled_component<U>(w.raw(), inverse);
}
template <std::floating_point U> ISO_INLINE void normalise4(U& x, U& y, U& z, U& w) {
  const U squared = x * x + y * y + z * z + w * w;
  if (squared == U(0)) {
    w = U(1);
    return;
  }
  const U inverse = U(1) / sqrt(squared);
  x = x * inverse;
  y = y * inverse;
  z = z * inverse;
  w = w * inverse;
}

// ---- circular functions, exponential and logarithm, compiled once in scalar/src/math.cpp
//
// Integer arithmetic for every scalar, float and double included: no contraction, rounding mode or compiler option can
// reach a result. Angles in radians. Errors per scalar: scalar/README.md.

template <class S> struct SinCos { S sin, cos; };

/// Takes any argument, however large. float, double: not finite gives NaN.
float sin(float x);
double sin(double x);
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> sin(Fixed<Rep, F, P> x);
float cos(float x);
double cos(double x);
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> cos(Fixed<Rep, F, P> x);

/// Computes both from one reduction. The `_to` form chooses the result's format: a quaternion from an angle is
/// sin_cos_to<Unit<S>>(angle), not a rounding to S and a widening.
SinCos<float> sin_cos(float x);
SinCos<double> sin_cos(double x);
template <class Out, class Rep, int F, Overflow P> SinCos<Out> sin_cos_to(Fixed<Rep, F, P> x);
template <class Out, std::floating_point S> ISO_INLINE SinCos<Out> sin_cos_to(S x) { return sin_cos(x); }
template <class Rep, int F, Overflow P> ISO_INLINE SinCos<Fixed<Rep, F, P>> sin_cos(Fixed<Rep, F, P> x) {
  return sin_cos_to<Fixed<Rep, F, P>>(x);
}

/// Angle of (x, y) from the x axis in [-pi, pi]. (0, 0) gives 0; float and double follow IEEE 754 on signed zeros and
/// infinities. The `_to` form takes and gives different formats: atan2_to<S>(sine, cosine) of two Unit<S>, whose own
/// atan2 ends at +-highest(), just below 2.
float atan2(float y, float x);
double atan2(double y, double x);
template <class Out, class Rep, int F, Overflow P> Out atan2_to(Fixed<Rep, F, P> y, Fixed<Rep, F, P> x);
template <class Out, std::floating_point S> ISO_INLINE Out atan2_to(S y, S x) { return atan2(y, x); }
template <class Rep, int F, Overflow P> ISO_INLINE Fixed<Rep, F, P> atan2(Fixed<Rep, F, P> y, Fixed<Rep, F, P> x) {
  return atan2_to<Fixed<Rep, F, P>>(y, x);
}

/// Arguments beyond [-1, 1] count as the nearer end; NaN stays NaN. acos of a Unit<S> ends at highest().
float asin(float x);
double asin(double x);
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> asin(Fixed<Rep, F, P> x);
float acos(float x);
double acos(double x);
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> acos(Fixed<Rep, F, P> x);

/// e^x. Beyond the format: fixed point ends at highest() and 0, float and double at infinity and 0, by way of the
/// subnormal numbers. The `_to` form chooses the result's format: exp_to<Step<S>>(x) for x <= 0 is a factor of decay
/// with all of Step's digits; 1, which Step cannot hold, becomes highest().
float exp(float x);
double exp(double x);
template <class Out, class Rep, int F, Overflow P> Out exp_to(Fixed<Rep, F, P> x);
template <class Out, std::floating_point S> ISO_INLINE Out exp_to(S x) { return exp(x); }
template <class Rep, int F, Overflow P> ISO_INLINE Fixed<Rep, F, P> exp(Fixed<Rep, F, P> x) {
  return exp_to<Fixed<Rep, F, P>>(x);
}

/// Natural logarithm. Fixed point: zero and negative give lowest(), what is below the format -highest(). float, double:
/// zero gives minus infinity, negative NaN.
float log(float x);
double log(double x);
template <class Out, class Rep, int F, Overflow P> Out log_to(Fixed<Rep, F, P> x);
template <class Out, std::floating_point S> ISO_INLINE Out log_to(S x) { return log(x); }
template <class Rep, int F, Overflow P> ISO_INLINE Fixed<Rep, F, P> log(Fixed<Rep, F, P> x) {
  return log_to<Fixed<Rep, F, P>>(x);
}

/// base^exponent, rounded once: power_to<Step<S>>(damping, h) is what damping per second leaves after h [s].
/// Zero to the power of zero is 1. Fixed point: a negative base counts as zero; ends as exp_to does.
/// float, double: any exponent; a negative base or a NaN gives NaN, zero and infinity their limits.
float power(float base, float exponent);
double power(double base, double exponent);
template <class Out, class Rep, int F, int G, Overflow P>
Out power_to(Fixed<Rep, F, P> base, Fixed<Rep, G, P> exponent);
template <class Out, std::floating_point S> ISO_INLINE Out power_to(S base, S exponent) {
  return power(base, exponent);
}

/// The functions in the formats that the library holds; for a format of your own include math.inl as well.
#define ISO_SCALAR_MATH_OF(KEYWORD, S)         \
  KEYWORD template S sin(S);                   \
  KEYWORD template S cos(S);                   \
  KEYWORD template SinCos<S> sin_cos_to<S>(S); \
  KEYWORD template S atan2_to<S>(S, S);        \
  KEYWORD template S asin(S);                  \
  KEYWORD template S acos(S);                  \
  KEYWORD template S exp_to<S>(S);             \
  KEYWORD template S log_to<S>(S);
/// The functions that lead from one format to another.
#define ISO_SCALAR_MATH_BETWEEN(KEYWORD, S)                \
  KEYWORD template SinCos<Unit<S>> sin_cos_to<Unit<S>>(S); \
  KEYWORD template S atan2_to<S>(Unit<S>, Unit<S>);        \
  KEYWORD template Unit<S> exp_to<Unit<S>>(S);             \
  KEYWORD template Step<S> exp_to<Step<S>>(S);             \
  KEYWORD template S log_to<S>(Unit<S>);                   \
  KEYWORD template S log_to<S>(Step<S>);                   \
  KEYWORD template Step<S> power_to<Step<S>>(S, Step<S>);
#define ISO_SCALAR_MATH(KEYWORD, S)    \
  ISO_SCALAR_MATH_OF(KEYWORD, S)       \
  ISO_SCALAR_MATH_OF(KEYWORD, Unit<S>) \
  ISO_SCALAR_MATH_BETWEEN(KEYWORD, S)
ISO_SCALAR_MATH(extern, Q16_16)
ISO_SCALAR_MATH(extern, Q32_32)

}  // namespace isostep
