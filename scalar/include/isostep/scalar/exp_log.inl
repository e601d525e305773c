// Bodies of exp, log and power: 128-bit results from tables and short series, rounded once; integers for every scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/math.hpp"
#include "isostep/scalar/math_tables.hpp"
#include "isostep/scalar/soft.hpp"

namespace isostep::detail {

/// The upper half of a 256-bit product, less at most 3 units.
ISO_INLINE constexpr UInt128Parts multiply_high(UInt128Parts a, UInt128Parts b) {
  const UInt128Parts middle = add({0, multiply_high(a.high, b.low)}, {0, multiply_high(a.low, b.high)});
  return add(multiply(a.high, b.high), middle);
}
ISO_INLINE constexpr UInt128Parts multiply_high(UInt128Parts a, std::uint64_t b) {  // a b / 2^64
  return add(multiply(a.high, b), {0, multiply_high(a.low, b)});
}
ISO_INLINE constexpr bool is_zero(UInt128Parts a) { return (a.high | a.low) == 0; }
ISO_INLINE constexpr WideSoft widened(Soft a) { return {{a.mantissa, 0}, a.exponent - 64, a.negative}; }

/// e^a. Relative error below 2^-74.
/// Method: a / ln 2 = n + i/64 + r, 0 <= r < 1/64, in units of 2^-112; e^a = 2^n (T + T (2^r - 1)), T = 2^(i/64);
///         2^r - 1 = r (ln 2 + r series(r)), of which only the series is held to 64 bits.
/// Source: Tang 1989, ACM TOMS 15(2), for table and series; the words are ours.
ISO_INLINE constexpr WideSoft soft_exp(WideSoft x) {
  constexpr UInt128Parts one = {std::uint64_t{1} << 63, 0};
  const WideSoft a = normalised(x);
  if (is_zero(a.mantissa)) return {one, -127, false};
  if (a.exponent > 12 - 128) return {a.negative ? UInt128Parts{0, 0} : one, 1 << 13, false};  // |a| >= 2^12
  const int down = -(a.exponent + 113);                                                       // 4 or more
  const UInt128Parts size = down < 128 ? shift_right(multiply_high(a.mantissa, kLog2E), down) : UInt128Parts{0, 0};
  const UInt128Parts y = a.negative ? subtract({0, 0}, size) : size;
  const int n = static_cast<int>(static_cast<std::int64_t>(y.high) >> 48);
  const UInt128Parts power = kExp2Of64ths[(y.high >> 42) & 63u];
  const UInt128Parts u = shift_left(y, 22);  // 64 r
  std::uint64_t sum = kExpSeries[5];
  for (int i = 4; i >= 0; --i) sum = kExpSeries[i] + multiply_high(sum, u.high);
  const UInt128Parts slope = add(kLn2Q128, shift_right(multiply(sum, u.high), 6));
  const UInt128Parts rise = shift_right(multiply_high(power, multiply_high(slope, u)), 7);
  return {add(shift_right(power, 1), rise), n - 126, false};  // a bit left free: the sum may round up to 2
}

/// ln x for x > 0. Relative error below 2^-66, absolute error below 2^-74 where |ln x| < 1.
/// Method: x = 2^k m, 1 <= m < 2; j = round(64 (m - 1)), R = 16 bits of 1/(1 + j/64); ln x = k ln 2 - ln R + ln(1 + r),
///         r = m R - 1 exact, |r| < 1/128 + 2^-16. ln(1 + r) = r - r^2 series(r) with r normalised, so that near x = 1,
///         where the first two terms are or cancel to 0, the error stays a relative one.
/// Source: Tang 1990, ACM TOMS 16(4), for table and series; the words are ours.
ISO_INLINE constexpr WideSoft soft_log(Soft x) {
  const Soft n = normalised(x);
  const LogCell cell = kLogCells[((n.mantissa >> 56) - 127) >> 1];
  const Int128 whole = Int128(n.exponent + 63) * int128_from(kLn2Q116) + int128_from(cell.log);  // units of 2^-116
  const UInt128Parts product = multiply(n.mantissa, cell.reciprocal);                            // units of 2^-79
  constexpr UInt128Parts one = {std::uint64_t{1} << 15, 0};
  const bool below = product.high < one.high;
  const UInt128Parts d = below ? subtract(one, product) : subtract(product, one);
  WideSoft lesser = {{0, 0}, -116, false};
  if (!is_zero(d)) {
    const int zeros = leading_zeros(d);
    const int octave = zeros - 48;  // |r| = d 2^-79 in [2^-octave, 2^(1 - octave)); at least 7
    const UInt128Parts r = shift_left(d, zeros);
    const std::uint64_t u = shift_right(d, 9).low;  // 64 |r|
    const std::uint64_t alternate = below ? 0 : ~std::uint64_t{0};
    std::uint64_t sum = kLogSeries[7];
    for (int i = 6; i >= 0; --i) sum = kLogSeries[i] + ((multiply_high(sum, u) ^ alternate) - alternate);
    const UInt128Parts bend = shift_right(multiply(multiply_high(r.high, r.high), sum), octave);
    const UInt128Parts line = shift_right(r, 1);
    lesser = {below ? add(line, bend) : subtract(line, bend), -126 - octave, below};
  }
  if (whole == Int128(0)) return lesser;
  const Int128 rest = int128_from(shift_right(lesser.mantissa, -116 - lesser.exponent));
  const Int128 total = lesser.negative ? whole - rest : whole + rest;
  const bool negative = total < Int128(0);
  return {parts(negative ? -total : total), -116, negative};
}

/// base^exponent for base > 0.
ISO_INLINE constexpr WideSoft soft_power(Soft base, Soft exponent) {
  const WideSoft log = normalised(soft_log(base));
  const Soft h = normalised(exponent);
  return soft_exp(
      {multiply_high(log.mantissa, h.mantissa), log.exponent + h.exponent + 64, log.negative != h.negative});
}

template <class S> ISO_INLINE constexpr S exp_float(S x) {
  return is_nan(x) ? kQuietNan<S> : from_wide<S>(soft_exp(widened(to_soft(x))));
}
template <class S> ISO_INLINE constexpr S log_float(S x) {
  const Soft a = to_soft(x);
  if (a.mantissa == 0) return -kInfinity<S>;
  if (is_nan(x) || a.negative) return kQuietNan<S>;
  return is_finite(x) ? from_wide<S>(soft_log(a)) : x;
}
template <class S> ISO_INLINE constexpr S power_float(S base, S exponent) {
  const Soft b = to_soft(base);
  const Soft h = to_soft(exponent);
  if (is_nan(base) || is_nan(exponent) || (b.negative && b.mantissa != 0)) return kQuietNan<S>;
  if (b.mantissa != 0 && is_finite(base)) return from_wide<S>(soft_power(b, h));
  if (h.mantissa == 0) return S(1);
  return (b.mantissa == 0) != h.negative ? S(0) : kInfinity<S>;
}

}  // namespace isostep::detail

namespace isostep {

template <class Out, class Rep, int F, Overflow P> Out exp_to(Fixed<Rep, F, P> x) {
  return detail::from_wide<Out>(detail::soft_exp(detail::widened(detail::to_soft(x))));
}
template <class Out, class Rep, int F, Overflow P> Out log_to(Fixed<Rep, F, P> x) {
  if (x.raw() <= 0) return Out::lowest();
  return detail::from_wide<Out>(detail::soft_log(detail::to_soft(x)));
}
template <class Out, class Rep, int F, int G, Overflow P>
Out power_to(Fixed<Rep, F, P> base, Fixed<Rep, G, P> exponent) {
  if (base.raw() <= 0) {
    if (exponent.raw() > 0) return Out::from_raw(0);
    return exponent.raw() < 0 ? Out::highest() : detail::from_wide<Out>(detail::soft_exp({{0, 0}, 0, false}));
  }
  return detail::from_wide<Out>(detail::soft_power(detail::to_soft(base), detail::to_soft(exponent)));
}

}  // namespace isostep
