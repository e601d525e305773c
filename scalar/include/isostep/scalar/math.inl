// Bodies of sin, cos, atan2, asin, acos, and in exp_log.inl of exp and log: integers for every scalar, whatever flags.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/exp_log.inl"
#include "isostep/scalar/math.hpp"
#include "isostep/scalar/math_tables.hpp"
#include "isostep/scalar/soft.hpp"

namespace isostep::detail {

// ---- sine and cosine

/// |x| as a whole number of quarter turns, of which only the last two bits matter, and a fraction of one.
struct QuarterTurns {
  UInt128Parts fraction;  // units of 2^-128
  unsigned quadrant;      // 0 .. 3
};

/// mantissa 2^exponent, for exponents from -127 up, so from the whole range of a double. Error below 2^-126.
/// Source: Payne, Hanek 1983, ACM SIGNUM Newsletter 18(1): only those digits of 2/pi are multiplied whose product with
///         x is neither a multiple of four quarters nor below the digits wanted. Here 192 digits, the first two of the
///         product's 192 bits being the quadrant.
ISO_INLINE constexpr QuarterTurns quarter_turns(std::uint64_t mantissa, int exponent) {
  const int first = exponent - 2 + 128;  // of the table's digits, counting the leading zeros
  const int word = first >> 6;
  const int bit = first & 63;
  std::uint64_t k[3] = {};  // most significant first
  for (int i = 0; i < 3; ++i) {
    k[i] = (kTwoOverPi[word + i] << bit) | ((kTwoOverPi[word + i + 1] >> 1) >> (63 - bit));
  }
  const UInt128Parts low = multiply(mantissa, k[2]);
  const UInt128Parts middle = add(multiply(mantissa, k[1]), {0, low.high});
  const UInt128Parts top = {mantissa * k[0] + middle.high, middle.low};
  const UInt128Parts fraction = shift_left(top, 2);
  return {{fraction.high, fraction.low | (low.low >> 62)}, static_cast<unsigned>(top.high >> 62)};
}
/// The quarter turns of |raw| 2^-F: 128 digits of 2/pi times 64 bits leave an error below 2^(-63-F).
template <int F> ISO_INLINE constexpr QuarterTurns quarter_turns_fixed(std::uint64_t raw) {
  const UInt128Parts product =
      add(multiply(raw, kTwoOverPi[2]), {0, multiply_high(raw, kTwoOverPi[3])});  // units of 2^(-64-F)
  return {shift_left(product, 64 - F), static_cast<unsigned>(shift_right(product, 64 + F).low) & 3u};
}

/// kQuarterWave[row] at t in Q0.64, t <= 1/4, as Q1.63: within 2 units of 2^-63.
ISO_INLINE constexpr std::uint64_t quarter_wave(unsigned row, std::uint64_t t) {
  const std::uint64_t* c = kQuarterWave[row];
  std::uint64_t sum = c[7];
  for (int i = 6; i >= 0; --i) sum = c[i] - multiply_high(sum, t);
  return sum;
}

/// Returns the sine of `turns` plus `more` quarter turns, folded at an eighth of a turn.
ISO_INLINE constexpr Soft sine(QuarterTurns turns, unsigned more, bool negative) {
  const unsigned quadrant = turns.quadrant + more;
  const bool fold = (turns.fraction.high >> 63) != 0;
  const UInt128Parts f = fold ? subtract({0, 0}, turns.fraction) : turns.fraction;
  const unsigned row = (quadrant & 1u) ^ (fold ? 1u : 0u);
  const std::uint64_t wave = quarter_wave(row, multiply_high(f.high, f.high));
  const bool below = ((quadrant & 2u) != 0) != negative;
  // Row 1 is multiplied by 1 - 2^-64 rather than by f: no branch that half of all arguments would mispredict. The last
  // bit, far below the error, gives a zero fraction a leading one.
  const std::uint64_t all = 0 - static_cast<std::uint64_t>(row);
  const UInt128Parts factor = {f.high | all, f.low | 1u};
  const int zeros = leading_zeros(factor);
  return {multiply_high(wave, shift_left(factor, zeros).high), -63 - zeros, below};
}

/// The sine in units of 2^-bits, for fixed point, where 64 bits of fraction are enough.
template <class Out> ISO_INLINE constexpr Out sine_fixed(QuarterTurns turns, unsigned more, bool negative) {
  static_assert(Out::kFracBits <= Out::kBits - 2, "the format must hold 1");
  const unsigned quadrant = turns.quadrant + more;
  const bool fold = (turns.fraction.high >> 63) != 0;
  const std::uint64_t f = fold ? 0 - turns.fraction.high : turns.fraction.high;
  const unsigned row = (quadrant & 1u) ^ (fold ? 1u : 0u);
  const std::uint64_t wave = quarter_wave(row, multiply_high(f, f));
  const std::uint64_t product = multiply_high(wave, f);
  const std::uint64_t size = ((row == 1 ? wave : product) >> (62 - Out::kFracBits)) + 1;  // last bit: half a unit
  const auto raw = static_cast<typename Out::Raw>(size >> 1);
  const bool below = ((quadrant & 2u) != 0) != negative;
  return Out::from_raw(below ? static_cast<typename Out::Raw>(-raw) : raw);
}

/// Returns true if |x| is below 2^-27, where sin(x) = x and cos(x) = 1 to within a tenth of an ulp of double.
template <class S> ISO_INLINE constexpr bool is_tiny(S x) {
  constexpr int field = FloatFormat<S>::kBias - 27;
  return (to_bits(x) << 1 >> 1) < (static_cast<RawBits<S>>(field) << FloatFormat<S>::kMantissa);
}
template <class S> ISO_INLINE constexpr SinCos<S> sin_cos_float(S x) {
  if (!is_finite(x)) return {kQuietNan<S>, kQuietNan<S>};
  if (is_tiny(x)) return {x, S(1)};
  const Soft a = to_soft(x);
  const QuarterTurns turns = quarter_turns(a.mantissa, a.exponent);
  return {from_soft<S>(sine(turns, 0, a.negative)), from_soft<S>(sine(turns, 1, false))};
}
template <class S> ISO_INLINE constexpr S sin_float(S x) {
  if (!is_finite(x)) return kQuietNan<S>;
  if (is_tiny(x)) return x;
  const Soft a = to_soft(x);
  return from_soft<S>(sine(quarter_turns(a.mantissa, a.exponent), 0, a.negative));
}
template <class S> ISO_INLINE constexpr S cos_float(S x) {
  if (!is_finite(x)) return kQuietNan<S>;
  if (is_tiny(x)) return S(1);
  const Soft a = to_soft(x);
  return from_soft<S>(sine(quarter_turns(a.mantissa, a.exponent), 1, false));
}

// ---- the angle of a vector

/// 2^63 atan(r) / r for t = r^2 in Q0.64, t <= 2^-13: the series to r^9 / 9, truncated at 2^-68.
ISO_INLINE constexpr std::uint64_t atan_series(std::uint64_t t) {
  constexpr std::uint64_t unit = std::uint64_t{1} << 63;
  std::uint64_t sum = unit / 7 - multiply_high(unit / 9, t);
  sum = unit / 5 - multiply_high(sum, t);
  sum = unit / 3 - multiply_high(sum, t);
  return unit - multiply_high(sum, t);
}

/// atan(a / b) for a 2^-gap <= b, both mantissas in [2^62, 2^63). Relative error below 2^-60.
/// Method: i = round(64 a/b); atan(a/b) = atan(i/64) + atan(r), r = (64 a - i b) / (64 b + i a), |r| < 1/126;
///         numerator exact, i from the leading 16 bits of b. For i = 0 the quotient keeps 64 significant bits.
ISO_INLINE constexpr Soft atan_of_ratio(std::uint64_t a, std::uint64_t b, int gap) {
  const std::uint64_t aligned = gap < 63 ? a >> gap : 0;
  const auto b_leading = static_cast<std::uint32_t>(b >> 47);
  const std::uint32_t i = (static_cast<std::uint32_t>(aligned >> 41) + b_leading / 2) / b_leading;
  if (i == 0) {
    const int halve = a >= b ? 1 : 0;
    const std::uint64_t q = divide({a >> halve, halve != 0 ? a << 63 : 0}, b).quotient;  // a/b 2^(64 - halve)
    const int down = gap - halve;
    const std::uint64_t r = down < 64 ? q >> down : 0;
    return {multiply_high(q, atan_series(multiply_high(r, r))), -63 - down, false};
  }
  const std::uint64_t a64 = gap <= 6 ? a << (6 - gap) : a >> 1;   // modulo 2^64; here gap <= 7
  const auto numerator = static_cast<std::int64_t>(a64 - i * b);  // within 0.51 b
  const std::uint64_t denominator = b + (multiply_high(aligned, std::uint64_t{i} << 57) << 1);
  const std::uint64_t q = divide({magnitude(numerator), 0}, denominator).quotient;  // 64 |r| in Q0.64
  const std::uint64_t r = q >> 6;
  const int octave = 63 - leading_zeros(std::uint64_t{i});
  const std::uint64_t atan_r = multiply_high(q, atan_series(multiply_high(r, r))) >> octave;  // units of kAtan64ths[i]
  const auto sign = static_cast<std::uint64_t>(numerator >> 63);
  return {kAtan64ths[i] + ((atan_r ^ sign) - sign), octave - 69, false};
}

/// Returns the angle of (x, y) from the x axis, in [-pi, pi], with the sign of y.
ISO_INLINE constexpr Soft soft_atan2(Soft y, Soft x) {
  if (y.mantissa == 0) return x.negative ? Soft{kPiQ62, -62, y.negative} : Soft{0, 0, y.negative};
  if (x.mantissa == 0) return {kHalfPiQ62, -62, y.negative};
  const Soft v = normalised(y);
  const Soft u = normalised(x);
  const bool steep = v.exponent > u.exponent || (v.exponent == u.exponent && v.mantissa > u.mantissa);
  const Soft lesser = steep ? u : v;
  const Soft large = steep ? v : u;
  Soft angle = atan_of_ratio(lesser.mantissa >> 1, large.mantissa >> 1, large.exponent - lesser.exponent);
  if (steep || x.negative) {
    const std::uint64_t units = magnitude_in_units(angle, 62);
    const std::uint64_t from = steep ? kHalfPiQ62 : kPiQ62;
    angle = {steep && x.negative ? from + units : from - units, -62, false};
  }
  angle.negative = y.negative;
  return angle;
}

/// sqrt(1 - x^2) for |x| < 1, as sqrt((1 - x)(1 + x)): both factors exact for |x| >= 1/2, below within 2^-64.
ISO_INLINE constexpr Soft other_leg(Soft x) {
  const std::uint64_t size = magnitude_in_units(x, 64);
  const std::uint64_t minus = size != 0 ? 0 - size : ~std::uint64_t{0};
  const std::uint64_t plus = (std::uint64_t{1} << 63) + (size >> 1);
  const int zeros = leading_zeros(minus);
  return soft_sqrt({multiply_high(minus << zeros, plus), -63 - zeros, false});
}
ISO_INLINE constexpr bool at_least_one(Soft a) {
  const Soft n = normalised(a);
  return n.mantissa != 0 && n.exponent >= -63;
}
ISO_INLINE constexpr Soft soft_asin(Soft x) {
  if (at_least_one(x)) return {kHalfPiQ62, -62, x.negative};
  return soft_atan2(x, other_leg(x));
}
ISO_INLINE constexpr Soft soft_acos(Soft x) {
  if (at_least_one(x)) return x.negative ? Soft{kPiQ62, -62, false} : Soft{0, 0, false};
  return soft_atan2(other_leg(x), x);
}

template <class S> ISO_INLINE constexpr S atan2_float(S y, S x) {
  if (is_nan(y) || is_nan(x)) return kQuietNan<S>;
  return from_soft<S>(soft_atan2(to_soft(y), to_soft(x)));
}
template <class S> ISO_INLINE constexpr S asin_float(S x) {
  if (is_nan(x)) return kQuietNan<S>;
  return is_tiny(x) ? x : from_soft<S>(soft_asin(to_soft(x)));
}
template <class S> ISO_INLINE constexpr S acos_float(S x) {
  return is_nan(x) ? kQuietNan<S> : from_soft<S>(soft_acos(to_soft(x)));
}

}  // namespace isostep::detail

namespace isostep {

template <class Rep, int F, Overflow P> Fixed<Rep, F, P> sin(Fixed<Rep, F, P> x) {
  const auto turns = detail::quarter_turns_fixed<F>(detail::magnitude(x.raw()));
  return detail::sine_fixed<Fixed<Rep, F, P>>(turns, 0, x.raw() < 0);
}
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> cos(Fixed<Rep, F, P> x) {
  const auto turns = detail::quarter_turns_fixed<F>(detail::magnitude(x.raw()));
  return detail::sine_fixed<Fixed<Rep, F, P>>(turns, 1, false);
}
template <class Out, class Rep, int F, Overflow P> SinCos<Out> sin_cos_to(Fixed<Rep, F, P> x) {
  const auto turns = detail::quarter_turns_fixed<F>(detail::magnitude(x.raw()));
  return {detail::sine_fixed<Out>(turns, 0, x.raw() < 0), detail::sine_fixed<Out>(turns, 1, false)};
}
template <class Out, class Rep, int F, Overflow P> Out atan2_to(Fixed<Rep, F, P> y, Fixed<Rep, F, P> x) {
  return detail::from_soft<Out>(detail::soft_atan2(detail::to_soft(y), detail::to_soft(x)));
}
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> asin(Fixed<Rep, F, P> x) {
  return detail::from_soft<Fixed<Rep, F, P>>(detail::soft_asin(detail::to_soft(x)));
}
template <class Rep, int F, Overflow P> Fixed<Rep, F, P> acos(Fixed<Rep, F, P> x) {
  return detail::from_soft<Fixed<Rep, F, P>>(detail::soft_acos(detail::to_soft(x)));
}

}  // namespace isostep
