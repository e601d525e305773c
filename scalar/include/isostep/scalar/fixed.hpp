// Fixed<Rep, FracBits>: two's complement fixed point whose results are integers, so the same on every machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>

#include "isostep/scalar/wide_int.hpp"

namespace isostep {

/// The behaviour of an operation whose exact result does not fit: `wrap` is defined, branch-free and the release
/// behaviour; `trap` stops the program and exists to test that a range contract holds.
enum class Overflow { wrap, trap };

template <class Rep, int FracBits, Overflow Policy = Overflow::wrap> class Fixed;

namespace detail {
/// Sums and shifts of wide integers under a policy: modulo their width, or trapping when a bit is lost.
template <Overflow P, class W> ISO_INLINE constexpr W add_wide(W a, W b) {
  const W sum = wrapping_add(a, b);
  if constexpr (P == Overflow::trap) {
    if ((a < W(0)) == (b < W(0)) && (sum < W(0)) != (a < W(0))) ISO_TRAP();
  }
  return sum;
}
template <Overflow P, class W> ISO_INLINE constexpr W subtract_wide(W a, W b) {
  const W difference = wrapping_subtract(a, b);
  if constexpr (P == Overflow::trap) {
    if ((a < W(0)) != (b < W(0)) && (difference < W(0)) != (a < W(0))) ISO_TRAP();
  }
  return difference;
}
template <Overflow P, class W> ISO_INLINE constexpr W shift_left_wide(W value, int n) {
  const W shifted = value << n;
  if constexpr (P == Overflow::trap) {
    if (!((shifted >> n) == value)) ISO_TRAP();
  }
  return shifted;
}
void literal_does_not_fit_this_fixed_point_type();  // not constexpr: reaching it in a constant is the error message
}  // namespace detail

/// An exact sum of products, in the wide integer and with the products' fraction bits. Rounds once, in `round_to`.
/// Range: three products of Q32.32 fit while every factor is below 2^30; the trapping policy tests it.
template <class Rep, int FracBits, Overflow Policy = Overflow::wrap> struct FixedSum {
  Wide<Rep> raw;

  static ISO_INLINE constexpr FixedSum zero() { return {Wide<Rep>(0)}; }
  friend ISO_INLINE constexpr FixedSum operator+(FixedSum a, FixedSum b) {
    return {detail::add_wide<Policy>(a.raw, b.raw)};
  }
  friend ISO_INLINE constexpr FixedSum operator-(FixedSum a, FixedSum b) {
    return {detail::subtract_wide<Policy>(a.raw, b.raw)};
  }
  friend ISO_INLINE constexpr FixedSum operator-(FixedSum a) { return zero() - a; }
  ISO_INLINE constexpr FixedSum& operator+=(FixedSum b) { return *this = *this + b; }
  ISO_INLINE constexpr FixedSum& operator-=(FixedSum b) { return *this = *this - b; }
  friend ISO_INLINE constexpr bool operator==(FixedSum a, FixedSum b) { return a.raw == b.raw; }
  friend ISO_INLINE constexpr bool operator<(FixedSum a, FixedSum b) { return a.raw < b.raw; }
  friend ISO_INLINE constexpr bool operator>(FixedSum a, FixedSum b) { return b < a; }
  friend ISO_INLINE constexpr bool operator<=(FixedSum a, FixedSum b) { return !(b < a); }
  friend ISO_INLINE constexpr bool operator>=(FixedSum a, FixedSum b) { return !(a < b); }
};

template <class Rep, int FracBits, Overflow Policy> class Fixed {
  static_assert(std::same_as<Rep, std::int32_t> || std::same_as<Rep, std::int64_t>, "Rep is int32_t or int64_t");
  static_assert(FracBits > 0 && FracBits < std::numeric_limits<Rep>::digits + 1, "at least the sign bit is left");
  using Unsigned = std::conditional_t<std::same_as<Rep, std::int32_t>, std::uint32_t, std::uint64_t>;

 public:
  using Raw = Rep;
  static constexpr int kFracBits = FracBits;
  static constexpr int kBits = std::numeric_limits<Unsigned>::digits;
  static constexpr Overflow kPolicy = Policy;

  Fixed() = default;
  /// Converts a whole number: exact if it fits, else to the nearest end of the format. Implicit, so that {0, 2, 0} is a
  /// vector of any scalar.
  template <std::integral I> ISO_INLINE constexpr Fixed(I whole) : raw_(from_whole(whole)) {}
  /// A literal, rounded to nearest, ties away from zero. Only the compiler may call this: no run-time floating point
  /// enters the simulation. From a run-time double use `from_double`.
  consteval Fixed(double literal) : raw_(0) {
    double scaled = literal;
    for (int i = 0; i < FracBits; ++i) scaled *= 2;
    const double limit = static_cast<double>(Unsigned{1} << (kBits - 2)) * 2;
    if (!((scaled > -limit - 0.5 || scaled == -limit) && scaled < limit - 0.5)) {
      detail::literal_does_not_fit_this_fixed_point_type();
    }
    const double size = scaled < 0 ? -scaled : scaled;
    auto whole = static_cast<Unsigned>(size);
    if (size - static_cast<double>(whole) >= 0.5) ++whole;  // adding 0.5 to size would itself round
    raw_ = static_cast<Rep>(scaled < 0 ? Unsigned{0} - whole : whole);
  }
  static ISO_INLINE constexpr Fixed from_raw(Rep raw) {
    Fixed result;
    result.raw_ = raw;
    return result;
  }
  ISO_INLINE constexpr Rep raw() const { return raw_; }

  static ISO_INLINE constexpr Fixed highest() { return from_raw(kHighestRaw); }
  static ISO_INLINE constexpr Fixed lowest() { return from_raw(kLowestRaw); }

  friend ISO_INLINE constexpr Fixed operator+(Fixed a, Fixed b) {
    if constexpr (Policy == Overflow::trap) return from_raw(narrow(Wide<Rep>(a.raw_) + Wide<Rep>(b.raw_)));
    return from_raw(static_cast<Rep>(static_cast<Unsigned>(a.raw_) + static_cast<Unsigned>(b.raw_)));
  }
  friend ISO_INLINE constexpr Fixed operator-(Fixed a, Fixed b) {
    if constexpr (Policy == Overflow::trap) return from_raw(narrow(Wide<Rep>(a.raw_) - Wide<Rep>(b.raw_)));
    return from_raw(static_cast<Rep>(static_cast<Unsigned>(a.raw_) - static_cast<Unsigned>(b.raw_)));
  }
  friend ISO_INLINE constexpr Fixed operator-(Fixed a) { return from_raw(0) - a; }
  ISO_INLINE constexpr Fixed& operator+=(Fixed b) { return *this = *this + b; }
  ISO_INLINE constexpr Fixed& operator-=(Fixed b) { return *this = *this - b; }
  template <int G> ISO_INLINE constexpr Fixed& operator*=(Fixed<Rep, G, Policy> b) {
    return *this = round_to<Fixed>(product(*this, b));
  }
  ISO_INLINE constexpr Fixed& operator/=(Fixed b) { return *this = *this / b; }

  friend ISO_INLINE constexpr bool operator==(Fixed a, Fixed b) { return a.raw_ == b.raw_; }
  friend ISO_INLINE constexpr bool operator!=(Fixed a, Fixed b) { return a.raw_ != b.raw_; }
  friend ISO_INLINE constexpr bool operator<(Fixed a, Fixed b) { return a.raw_ < b.raw_; }
  friend ISO_INLINE constexpr bool operator>(Fixed a, Fixed b) { return a.raw_ > b.raw_; }
  friend ISO_INLINE constexpr bool operator<=(Fixed a, Fixed b) { return a.raw_ <= b.raw_; }
  friend ISO_INLINE constexpr bool operator>=(Fixed a, Fixed b) { return a.raw_ >= b.raw_; }

  /// Converts the wide integer to a raw value: wraps or traps by policy.
  static ISO_INLINE constexpr Rep narrow(Wide<Rep> wide) {
    const Rep result = static_cast<Rep>(static_cast<std::int64_t>(wide));
    if constexpr (Policy == Overflow::trap) {
      if (!(Wide<Rep>(result) == wide)) ISO_TRAP();
    }
    return result;
  }

 private:
  template <std::integral I> static ISO_INLINE constexpr Rep from_whole(I whole) {
    constexpr std::int64_t most = (std::int64_t{1} << (kBits - 1 - FracBits)) - 1;
    const bool above = whole > 0 && static_cast<std::uint64_t>(whole) > static_cast<std::uint64_t>(most);
    const bool below = whole < 0 && static_cast<std::int64_t>(whole) < -most - 1;
    if constexpr (Policy == Overflow::trap) {
      if (above || below) ISO_TRAP();
    }
    if (above) return kHighestRaw;
    if (below) return kLowestRaw;
    return static_cast<Rep>(static_cast<Unsigned>(static_cast<std::int64_t>(whole)) << FracBits);
  }

  // Constants, for a call of numeric_limits is a weak symbol at -O0.
  static constexpr Rep kHighestRaw = std::numeric_limits<Rep>::max();
  static constexpr Rep kLowestRaw = std::numeric_limits<Rep>::min();

  Rep raw_;
};

using Q16_16 = Fixed<std::int32_t, 16>;
using Q32_32 = Fixed<std::int64_t, 32>;

/// The exact product of two numbers of one width and any two formats.
template <class Rep, int F, int G, Overflow P>
ISO_INLINE constexpr FixedSum<Rep, F + G, P> product(Fixed<Rep, F, P> a, Fixed<Rep, G, P> b) {
  return {Wide<Rep>(a.raw()) * Wide<Rep>(b.raw())};
}
/// Converts a number to a sum of products with `Sum`'s fraction bits, exact: `widen<Sum<S>>(x) + product(a, b)`.
template <class Sum, class Rep, int F, Overflow P> ISO_INLINE constexpr Sum widen(Fixed<Rep, F, P> a);

namespace detail {
template <class Sum> struct SumFormat;
template <class Rep, int F, Overflow P> struct SumFormat<FixedSum<Rep, F, P>> { static constexpr int kFracBits = F; };
}  // namespace detail

template <class Sum, class Rep, int F, Overflow P> ISO_INLINE constexpr Sum widen(Fixed<Rep, F, P> a) {
  return {detail::shift_left_wide<P>(Wide<Rep>(a.raw()), detail::SumFormat<Sum>::kFracBits - F)};
}

/// Rounds an exact sum to a number of format Out: to nearest, ties towards plus infinity (one add and one shift).
template <class Out, class Rep, int F, Overflow P> ISO_INLINE constexpr Out round_to(FixedSum<Rep, F, P> sum) {
  constexpr int shift = F - Out::kFracBits;
  if constexpr (shift > 0) {
    return Out::from_raw(Out::narrow(detail::add_wide<P>(sum.raw, Wide<Rep>(1) << (shift - 1)) >> shift));
  }
  if constexpr (shift <= 0) return Out::from_raw(Out::narrow(detail::shift_left_wide<P>(sum.raw, -shift)));
}

/// a b in the coarser of the two formats: S * Unit<S> and S * Step<S> are S, Unit<S> * Unit<S> is Unit<S>.
template <class Rep, int F, int G, Overflow P>
ISO_INLINE constexpr Fixed<Rep, (F < G ? F : G), P> operator*(Fixed<Rep, F, P> a, Fixed<Rep, G, P> b) {
  return round_to<Fixed<Rep, (F < G ? F : G), P>>(product(a, b));
}

namespace detail {
/// Nearest |n| 2^shift / |d|, ties away from zero, as an unsigned magnitude; saturates when it does not fit 63 bits.
ISO_INLINE constexpr std::uint64_t divide_magnitude(std::uint64_t n, int shift, std::uint64_t d) {
  constexpr std::uint64_t kSaturated = std::uint64_t{1} << 63;
  const UInt128Parts numerator = shift == 0 ? UInt128Parts{0, n} : UInt128Parts{n >> (64 - shift), n << shift};
  if (numerator.high >= d) return kSaturated;
  const Division division = divide(numerator, d);
  const bool up = division.remainder >= d - division.remainder;
  return division.quotient >= kSaturated ? kSaturated : division.quotient + (up ? 1u : 0u);
}
ISO_INLINE constexpr std::uint64_t magnitude(std::int64_t value) {
  return value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}
}  // namespace detail

/// a / b as a number of format Out, to nearest, ties away from zero. Saturates at the format's ends; x / 0 is the end
/// on x's side, 0 / 0 is 0: division has no undefined result.
template <class Out, class Rep, int F, int G, Overflow P>
ISO_INLINE constexpr Out divide_to(Fixed<Rep, F, P> a, Fixed<Rep, G, P> b) {
  constexpr int shift = Out::kFracBits + G - F;
  static_assert(shift >= 0 && shift < 64);
  const bool negative = (a.raw() < 0) != (b.raw() < 0);
  if (b.raw() == 0) return a.raw() == 0 ? Out::from_raw(0) : a.raw() < 0 ? Out::lowest() : Out::highest();
  constexpr std::uint64_t highest = static_cast<std::uint64_t>(std::numeric_limits<Rep>::max());
  const std::uint64_t n = detail::magnitude(a.raw());
  const std::uint64_t d = detail::magnitude(b.raw());
  std::uint64_t q;
  if constexpr (sizeof(Rep) == 4 && shift <= 32) {
    const std::uint64_t numerator = n << shift;  // n < 2^32
    q = numerator / d;
    const std::uint64_t remainder = numerator - q * d;
    q += remainder >= d - remainder ? 1u : 0u;
  } else {
    q = detail::divide_magnitude(n, shift, d);
  }
  if (q > highest) return negative ? Out::lowest() : Out::highest();
  return Out::from_raw(negative ? static_cast<Rep>(-static_cast<std::int64_t>(q)) : static_cast<Rep>(q));
}
template <class Rep, int F, Overflow P>
ISO_INLINE constexpr Fixed<Rep, F, P> operator/(Fixed<Rep, F, P> a, Fixed<Rep, F, P> b) {
  return divide_to<Fixed<Rep, F, P>>(a, b);
}

}  // namespace isostep
