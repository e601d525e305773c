// A number as integer mantissa and exponent: the form in which the elementary functions meet every scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "isostep/scalar/rsqrt.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep::detail {

/// mantissa 2^exponent, negated if negative. The mantissa need not be normalised; zero keeps its sign.
struct Soft {
  std::uint64_t mantissa;
  int exponent;
  bool negative;
};

/// Moves the mantissa's top bit to bit 63. Zero stays as it is.
ISO_INLINE constexpr Soft normalised(Soft a) {
  if (a.mantissa == 0) return a;
  const int zeros = leading_zeros(a.mantissa);
  return {a.mantissa << zeros, a.exponent - zeros, a.negative};
}

/// Returns |a| as an integer count of 2^-bits, to nearest; what does not fit becomes the largest.
ISO_INLINE constexpr std::uint64_t magnitude_in_units(Soft a, int bits) {
  const int left = a.exponent + bits;
  if (left <= 0) return shift_right_rounded(a.mantissa, -left);
  if (a.mantissa == 0) return 0;
  return left <= leading_zeros(a.mantissa) ? a.mantissa << left : ~std::uint64_t{0};
}

template <class F> struct FloatFormat;
template <> struct FloatFormat<float> { static constexpr int kMantissa = 23, kBias = 127, kTop = 255; };
template <> struct FloatFormat<double> { static constexpr int kMantissa = 52, kBias = 1023, kTop = 2047; };

/// Converts a. Infinity becomes a number so large that its ratio to any finite one is as good as infinite.
template <class S> ISO_INLINE constexpr Soft to_soft(S a) {
  if constexpr (kIsFixed<S>) {
    return {magnitude(a.raw()), -S::kFracBits, a.raw() < 0};
  } else {
    using Format = FloatFormat<S>;
    constexpr std::uint64_t implicit = std::uint64_t{1} << Format::kMantissa;
    const std::uint64_t bits = to_bits(a);
    const int field = static_cast<int>(bits >> Format::kMantissa) & Format::kTop;
    const bool negative = (bits >> (sizeof(S) * 8 - 1)) != 0;
    if (field == Format::kTop) return {implicit, 1 << 13, negative};
    const int least = 1 - Format::kBias - Format::kMantissa;  // exponent of the smallest subnormal
    if (field == 0) return {bits & (implicit - 1), least, negative};
    return {(bits & (implicit - 1)) | implicit, least - 1 + field, negative};
  }
}

template <class S> constexpr S kQuietNan = std::numeric_limits<S>::quiet_NaN();
template <class S> constexpr S kInfinity = std::numeric_limits<S>::infinity();
template <class S> ISO_INLINE constexpr bool is_nan(S a) {
  return !is_finite(a) && (to_bits(a) << (sizeof(S) * 8 - FloatFormat<S>::kMantissa)) != 0;
}

/// Returns the nearest S, ties to even for float and double; outside the range infinity, or a fixed-point format's end.
template <class S> ISO_INLINE constexpr S from_soft(Soft a) {
  if constexpr (kIsFixed<S>) {
    constexpr auto highest = static_cast<std::uint64_t>(std::numeric_limits<typename S::Raw>::max());
    const std::uint64_t units = magnitude_in_units(a, S::kFracBits);
    const auto raw = static_cast<typename S::Raw>(units < highest ? units : highest);
    return S::from_raw(a.negative ? static_cast<typename S::Raw>(-raw) : raw);
  } else {
    using Format = FloatFormat<S>;
    constexpr std::uint64_t one = 1;
    const Soft n = normalised(a);
    const std::uint64_t sign = a.negative ? one << (sizeof(S) * 8 - 1) : 0;
    const int field = n.exponent + 63 + Format::kBias;
    std::uint64_t bits = static_cast<std::uint64_t>(Format::kTop) << Format::kMantissa;
    const int drop = 63 - Format::kMantissa + (field > 0 ? 0 : 1 - field);
    if (n.mantissa == 0 || drop > 64) {
      bits = 0;
    } else if (drop == 64) {  // below the smallest subnormal: half of it exactly rounds to even, zero
      bits = n.mantissa > (one << 63) ? 1 : 0;
    } else if (field < Format::kTop) {
      const std::uint64_t rest = n.mantissa << (64 - drop);
      bits = n.mantissa >> drop;
      bits += rest > (one << 63) || (rest == (one << 63) && (bits & 1) != 0) ? 1u : 0u;
      if (field > 0) bits += static_cast<std::uint64_t>(field - 1) << Format::kMantissa;  // a carry raises the exponent
    }
    return from_bits<S>(static_cast<RawBits<S>>(bits | sign));
  }
}

/// A Soft whose mantissa has 128 bits, for results that are rounded only once, at the last bit of a format.
struct WideSoft {
  UInt128Parts mantissa;
  int exponent;
  bool negative;
};
ISO_INLINE constexpr WideSoft normalised(WideSoft a) {
  if ((a.mantissa.high | a.mantissa.low) == 0) return a;
  const int zeros = leading_zeros(a.mantissa);
  return {shift_left(a.mantissa, zeros), a.exponent - zeros, a.negative};
}
/// Rounds as from_soft does. Fixed point rounds on one bit, which is within the upper 64 even for a format's largest
/// magnitude. Float and double must also know if any bit below is set.
template <class S> ISO_INLINE constexpr S from_wide(WideSoft a) {
  const WideSoft n = normalised(a);
  const std::uint64_t rest = !kIsFixed<S> && n.mantissa.low != 0 ? 1 : 0;
  return from_soft<S>({n.mantissa.high | rest, n.exponent + 64, n.negative});
}

/// Square root, relative error below 2^-60.
ISO_INLINE constexpr Soft soft_sqrt(Soft a) {
  if (a.mantissa == 0) return a;
  const Soft n = normalised(a);
  const int odd = n.exponent & 1;
  const std::uint64_t m = n.mantissa >> odd;
  return {multiply_high(m, rsqrt_q64(m)), (n.exponent + odd + 62) / 2 - 62, false};
}

}  // namespace isostep::detail
