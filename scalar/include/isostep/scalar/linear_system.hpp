// LinearSystem<S>: in which numbers a large symmetric positive definite system over S is written down and solved.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

#include "isostep/scalar/exact.hpp"
#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/soft.hpp"

namespace isostep {

/// A system is scaled on both sides by powers of two until no entry of it exceeds one. Its entries are Numbers, and so
/// are those of its Cholesky factor, which are no larger. Right-hand side and solution have an exponent each.
///   Number    an entry: Q2.62 for every fixed-point format, Exact<double> for float and double
///   Value     a quantity of any size, for what must be known before an exponent is chosen
/// Wider than S on purpose: a stiff system of condition 2^17 would leave seven bits of a float, none of a Q16.16.
/// Floating point carries exponents of its own, so every exponent here is 0.
template <class S> struct LinearSystem;

template <std::floating_point S> struct LinearSystem<S> {
  using Number = Exact<double>;
  using Value = Exact<double>;

  static ISO_INLINE Value value(S x) { return Value(x); }
  static ISO_INLINE Value value(std::int32_t x) { return Value(x); }
  static ISO_INLINE Value value(Number x, int) { return x; }
  static ISO_INLINE Value product(Value a, Value b) { return a * b; }
  static ISO_INLINE Value quotient(Value a, Value b) { return a / b; }
  static ISO_INLINE Value sum(Value a, Value b) { return a + b; }
  static ISO_INLINE int exponent(Value) { return 0; }
  static ISO_INLINE Number number(Value x, int) { return x; }
  /// v + x, rounded once.
  static ISO_INLINE S add(S v, Value x) { return static_cast<S>((Value(v) + x).value()); }
};

template <class Rep, int F, Overflow P> struct LinearSystem<Fixed<Rep, F, P>> {
  using Number = Fixed<std::int64_t, 62>;
  using Value = detail::Soft;  // mantissa normalised, relative error below 2^-61

  template <int G> static ISO_INLINE Value value(Fixed<Rep, G, P> x) { return detail::normalised(detail::to_soft(x)); }
  static ISO_INLINE Value value(std::int32_t x) { return detail::normalised(Value{detail::magnitude(x), 0, x < 0}); }
  /// x 2^exponent
  static ISO_INLINE Value value(Number x, int exponent) {
    return detail::normalised(Value{detail::magnitude(x.raw()), exponent - Number::kFracBits, x.raw() < 0});
  }
  static ISO_INLINE Value product(Value a, Value b) {
    const std::uint64_t mantissa = detail::multiply_high(a.mantissa, b.mantissa);
    return detail::normalised(Value{mantissa, a.exponent + b.exponent + 64, a.negative != b.negative});
  }
  /// Divides by b, which is not 0.
  static ISO_INLINE Value quotient(Value a, Value b) {
    const Division division = divide({a.mantissa >> 1, a.mantissa << 63}, b.mantissa);
    return detail::normalised(Value{division.quotient, a.exponent - 63 - b.exponent, a.negative != b.negative});
  }
  /// Adds values >= 0.
  static ISO_INLINE Value sum(Value a, Value b) {
    if (a.mantissa == 0) return b;
    if (b.mantissa == 0) return a;
    if (a.exponent < b.exponent) {
      const Value swap = a;
      a = b;
      b = swap;
    }
    const int distance = a.exponent - b.exponent;
    const std::uint64_t less = distance < 63 ? b.mantissa >> (distance + 1) : 0;
    return detail::normalised(Value{(a.mantissa >> 1) + less, a.exponent + 1, false});
  }
  /// Returns the least e for which |x| < 2^e; for zero a very low one.
  static ISO_INLINE int exponent(Value x) { return x.mantissa == 0 ? kLowest : x.exponent + 64; }
  /// x 2^-exponent to nearest, for |x| < 2^(exponent + 1).
  static ISO_INLINE Number number(Value x, int exponent) {
    const Value scaled = {x.mantissa, x.exponent - exponent, false};
    const auto size = static_cast<std::int64_t>(detail::magnitude_in_units(scaled, Number::kFracBits) & kMagnitude);
    return Number::from_raw(x.negative ? -size : size);
  }
  /// Returns v + x, rounded once; beyond the format, the format's end.
  template <int G> static ISO_INLINE Fixed<Rep, G, P> add(Fixed<Rep, G, P> v, Value x) {
    constexpr Int128 lowest = std::int64_t{Fixed<Rep, G, P>::lowest().raw()};
    constexpr Int128 highest = std::int64_t{Fixed<Rep, G, P>::highest().raw()};
    const std::uint64_t units = detail::magnitude_in_units(x, G);
    const auto size = static_cast<std::int64_t>(units < kMagnitude ? units : kMagnitude);
    const Int128 total = Int128(std::int64_t{v.raw()}) + Int128(x.negative ? -size : size);
    const Int128 kept = total < lowest ? lowest : highest < total ? highest : total;
    return Fixed<Rep, G, P>::from_raw(static_cast<Rep>(static_cast<std::int64_t>(kept)));
  }

 private:
  static constexpr int kLowest = -128;
  static constexpr std::uint64_t kMagnitude = ~std::uint64_t{0} >> 1;
};

}  // namespace isostep
