// 128-bit integers, with and without the compiler's __int128: the exact products behind 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A 128-bit product of unsigned 64-bit integers. multiply_portable() makes it of four 32-bit partial products.
struct UInt128Parts {
  std::uint64_t high;
  std::uint64_t low;
};

ISO_INLINE constexpr UInt128Parts multiply_portable(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t mask = 0xffffffffu;
  const std::uint64_t low_low = (a & mask) * (b & mask);
  const std::uint64_t low_high = (a & mask) * (b >> 32);
  const std::uint64_t high_low = (a >> 32) * (b & mask);
  const std::uint64_t high_high = (a >> 32) * (b >> 32);
  const std::uint64_t middle = (low_low >> 32) + (low_high & mask) + (high_low & mask);
  return {high_high + (low_high >> 32) + (high_low >> 32) + (middle >> 32), (middle << 32) | (low_low & mask)};
}

/// Two's complement 128-bit integer in two 64-bit words; wraps like unsigned arithmetic. Has the values and results of
/// __int128 on every machine, and stands in for it where the compiler has none (32-bit targets, MSVC).
class PortableInt128 {
 public:
  PortableInt128() = default;
  ISO_INLINE constexpr PortableInt128(std::int64_t value)  // implicit, as between built-in integers
      : high_(value < 0 ? ~std::uint64_t{0} : 0), low_(static_cast<std::uint64_t>(value)) {}
  ISO_INLINE constexpr PortableInt128(std::uint64_t high, std::uint64_t low) : high_(high), low_(low) {}

  ISO_INLINE constexpr explicit operator std::int64_t() const { return static_cast<std::int64_t>(low_); }
  ISO_INLINE constexpr explicit operator std::uint64_t() const { return low_; }

  friend ISO_INLINE constexpr PortableInt128 operator+(PortableInt128 a, PortableInt128 b) {
    const std::uint64_t low = a.low_ + b.low_;
    return {a.high_ + b.high_ + (low < a.low_ ? 1u : 0u), low};
  }
  friend ISO_INLINE constexpr PortableInt128 operator-(PortableInt128 a) {
    return PortableInt128{~a.high_ + (a.low_ == 0 ? 1u : 0u), ~a.low_ + 1u};
  }
  friend ISO_INLINE constexpr PortableInt128 operator-(PortableInt128 a, PortableInt128 b) {
    return {a.high_ - b.high_ - (a.low_ < b.low_ ? 1u : 0u), a.low_ - b.low_};
  }
  friend ISO_INLINE constexpr PortableInt128 operator*(PortableInt128 a, PortableInt128 b) {
    const UInt128Parts low = multiply_portable(a.low_, b.low_);
    return {low.high + a.high_ * b.low_ + a.low_ * b.high_, low.low};
  }
  /// Arithmetic shift, 0 <= n < 128.
  friend ISO_INLINE constexpr PortableInt128 operator>>(PortableInt128 a, int n) {
    const std::int64_t high = static_cast<std::int64_t>(a.high_);
    if (n == 0) return a;
    if (n >= 64) return {static_cast<std::uint64_t>(high >> 63), static_cast<std::uint64_t>(high >> (n - 64))};
    return {static_cast<std::uint64_t>(high >> n), (a.low_ >> n) | (a.high_ << (64 - n))};
  }
  friend ISO_INLINE constexpr PortableInt128 operator<<(PortableInt128 a, int n) {
    if (n == 0) return a;
    if (n >= 64) return {a.low_ << (n - 64), 0};
    return {(a.high_ << n) | (a.low_ >> (64 - n)), a.low_ << n};
  }
  friend ISO_INLINE constexpr bool operator==(PortableInt128 a, PortableInt128 b) {
    return a.high_ == b.high_ && a.low_ == b.low_;
  }
  // One by one: the functions of std::strong_ordering are not always inlined, and would be weak symbols.
  friend ISO_INLINE constexpr bool operator<(PortableInt128 a, PortableInt128 b) {
    if (a.high_ != b.high_) return static_cast<std::int64_t>(a.high_) < static_cast<std::int64_t>(b.high_);
    return a.low_ < b.low_;
  }
  friend ISO_INLINE constexpr bool operator>(PortableInt128 a, PortableInt128 b) { return b < a; }
  friend ISO_INLINE constexpr bool operator<=(PortableInt128 a, PortableInt128 b) { return !(b < a); }
  friend ISO_INLINE constexpr bool operator>=(PortableInt128 a, PortableInt128 b) { return !(a < b); }
  ISO_INLINE constexpr std::uint64_t high() const { return high_; }
  ISO_INLINE constexpr std::uint64_t low() const { return low_; }

 private:
  std::uint64_t high_;
  std::uint64_t low_;
};

/// A quotient and remainder. divide_portable(), for numerator.high < divisor, works bit by bit: slow, obviously right.
struct Division {
  std::uint64_t quotient;
  std::uint64_t remainder;
};

ISO_INLINE constexpr Division divide_portable(UInt128Parts numerator, std::uint64_t divisor) {
  std::uint64_t remainder = numerator.high;
  std::uint64_t quotient = 0;
  for (int bit = 63; bit >= 0; --bit) {
    const bool carry = (remainder >> 63) != 0;
    remainder = (remainder << 1) | ((numerator.low >> bit) & 1u);
    const bool fits = carry || remainder >= divisor;
    if (fits) remainder -= divisor;
    quotient = (quotient << 1) | (fits ? 1u : 0u);
  }
  return {quotient, remainder};
}

#if defined(__SIZEOF_INT128__) && !defined(ISOSTEP_NO_INT128)
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

ISO_INLINE constexpr UInt128Parts multiply(std::uint64_t a, std::uint64_t b) {
  const UInt128 product = static_cast<UInt128>(a) * b;
  return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
}

ISO_INLINE constexpr Division divide(UInt128Parts numerator, std::uint64_t divisor) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (!__builtin_is_constant_evaluated()) {  // the library call behind __int128 costs three times as much
    Division result;
    __asm__("divq %4"
            : "=a"(result.quotient), "=d"(result.remainder)
            : "a"(numerator.low), "d"(numerator.high), "r"(divisor)
            : "cc");
    return result;
  }
#endif
  const UInt128 n = (static_cast<UInt128>(numerator.high) << 64) | numerator.low;
  return {static_cast<std::uint64_t>(n / divisor), static_cast<std::uint64_t>(n % divisor)};
}
ISO_INLINE constexpr UInt128Parts parts(Int128 value) {
  return {static_cast<std::uint64_t>(static_cast<UInt128>(value) >> 64), static_cast<std::uint64_t>(value)};
}
ISO_INLINE constexpr Int128 int128_from(UInt128Parts value) {
  return static_cast<Int128>((static_cast<UInt128>(value.high) << 64) | value.low);
}
#else
using Int128 = PortableInt128;
ISO_INLINE constexpr UInt128Parts multiply(std::uint64_t a, std::uint64_t b) { return multiply_portable(a, b); }
ISO_INLINE constexpr Division divide(UInt128Parts numerator, std::uint64_t divisor) {
  return divide_portable(numerator, divisor);
}
ISO_INLINE constexpr UInt128Parts parts(Int128 value) { return {value.high(), value.low()}; }
ISO_INLINE constexpr Int128 int128_from(UInt128Parts value) { return {value.high, value.low}; }
#endif

/// Sums modulo 2^64 and 2^128: a built-in signed sum that overflows is undefined.
ISO_INLINE constexpr std::int64_t wrapping_add(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
ISO_INLINE constexpr std::int64_t wrapping_subtract(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}
ISO_INLINE constexpr PortableInt128 wrapping_add(PortableInt128 a, PortableInt128 b) { return a + b; }
ISO_INLINE constexpr PortableInt128 wrapping_subtract(PortableInt128 a, PortableInt128 b) { return a - b; }
#if defined(__SIZEOF_INT128__) && !defined(ISOSTEP_NO_INT128)
ISO_INLINE constexpr Int128 wrapping_add(Int128 a, Int128 b) {
  return static_cast<Int128>(static_cast<UInt128>(a) + static_cast<UInt128>(b));
}
ISO_INLINE constexpr Int128 wrapping_subtract(Int128 a, Int128 b) {
  return static_cast<Int128>(static_cast<UInt128>(a) - static_cast<UInt128>(b));
}
#endif

/// The integer that holds any product of two Reps exactly, and sums of a few of them.
template <class Rep> struct WideOf;
template <> struct WideOf<std::int32_t> { using Type = std::int64_t; };
template <> struct WideOf<std::int64_t> { using Type = Int128; };
template <class Rep> using Wide = typename WideOf<Rep>::Type;

}  // namespace isostep
