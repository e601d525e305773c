// Exact sums of 64-bit products over the registers of an instruction set, in columns that carry only when they round.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {
namespace detail {

// R is the Registers of 64-bit integers. al, ah = the low and high 32-bit word of a, unsigned.

/// Sums X modulo 2^128: X = c2 2^64 + c1 2^32 + c0 while fewer than 2^29 products are added. Read as unsigned,
/// a b = ah bh 2^64 + (ah bl + al bh) 2^32 + al bl, less b 2^64 where a is negative and a 2^64 where b is.
template <class R> struct FarSum {
  using Type = typename R::Type;
  Type c0, c1, c2;

  static ISO_INLINE FarSum zero() {
    const Type z = R::broadcast(0);
    return {z, z, z};
  }
  static ISO_INLINE FarSum of_product(Type a, Type b) {
    const Type ah = R::template shift_in_zeros<32>(a);
    const Type bh = R::template shift_in_zeros<32>(b);
    const Type ll = R::multiply_low_words(a, b);
    const Type lh = R::multiply_low_words(a, bh);
    const Type hl = R::multiply_low_words(ah, b);
    const Type signs = R::add(R::where_negative(a, b), R::where_negative(b, a));
    const Type hh = R::subtract(R::multiply_low_words(ah, bh), signs);
    const Type cross = R::add(R::low_word(lh), R::low_word(hl));
    const Type cross_high = R::add(R::template shift_in_zeros<32>(lh), R::template shift_in_zeros<32>(hl));
    return {R::low_word(ll), R::add(R::template shift_in_zeros<32>(ll), cross), R::add(hh, cross_high)};
  }
  static ISO_INLINE FarSum of_words(Type high, Type low) {
    return {R::low_word(low), R::template shift_in_zeros<32>(low), high};
  }
  /// The 64 bits from bit `shift` on of X + 2^(shift - 1). The column that holds the rounding bit is shifted with its
  /// sign, for differences leave negative columns; the columns above are multiples of 2^shift and only move.
  template <int shift> ISO_INLINE Type round() const {
    static_assert(shift > 32);
    const Type carried = R::add(c1, R::template shift_right<32>(c0, 0));
    if constexpr (shift <= 64) {
      constexpr std::uint64_t half = std::uint64_t{1} << (shift - 33);
      return R::add(R::template shift_left<64 - shift>(c2), R::template shift_right<shift - 32>(carried, half));
    } else {
      const Type top = R::add(c2, R::template shift_right<32>(carried, 0));
      return R::template shift_right<shift - 64>(top, std::uint64_t{1} << (shift - 65));
    }
  }
  friend ISO_INLINE FarSum operator+(FarSum a, FarSum b) {
    return {R::add(a.c0, b.c0), R::add(a.c1, b.c1), R::add(a.c2, b.c2)};
  }
  friend ISO_INLINE FarSum operator-(FarSum a, FarSum b) {
    return {R::subtract(a.c0, b.c0), R::subtract(a.c1, b.c1), R::subtract(a.c2, b.c2)};
  }
};

/// The 64 bits from bit `shift` on of middle 2^32 + c0 + 2^(shift - 1), shift <= 32.
template <int shift, class R> ISO_INLINE typename R::Type round_near(typename R::Type middle, typename R::Type c0) {
  const auto high = R::template shift_left<32 - shift>(middle);
  if constexpr (shift <= 0) return R::add(high, R::template shift_left<-shift>(c0));
  if constexpr (shift > 0) {
    return R::add(high, R::template shift_right<shift>(c0, std::uint64_t{1} << (shift - 1)));
  }
}

/// Sums X modulo 2^96 where 64-bit integers have no signed products. With the sign bits flipped, a' = a + 2^63, the
/// words of a' b' are unsigned and a b = a' b' - 2^63 (a + b) modulo 2^96.
///   X = (middle + carry) 2^32 + high 2^64 - both 2^63 + (low - carry 2^32)
template <class R> struct FlippedSum {
  using Type = typename R::Type;
  Type low;     // of al bl, modulo 2^64
  Type carry;   // of the high words of al bl
  Type middle;  // of ah' bl + al bh'
  Type high;    // of ah' bh'
  Type both;    // of a + b

  static ISO_INLINE Type flipped_high(Type a) {
    return R::template shift_in_zeros<32>(R::flip(a, std::uint64_t{1} << 63));
  }
  static ISO_INLINE FlippedSum zero() {
    const Type z = R::broadcast(0);
    return {z, z, z, z, z};
  }
  static ISO_INLINE FlippedSum of_product(Type a, Type b) {
    const Type ah = flipped_high(a);
    const Type bh = flipped_high(b);
    const Type ll = R::multiply_low_words(a, b);
    return {ll, R::template shift_in_zeros<32>(ll), R::add(R::multiply_low_words(a, bh), R::multiply_low_words(ah, b)),
            R::multiply_low_words(ah, bh), R::add(a, b)};
  }
  static ISO_INLINE FlippedSum of_words(Type high, Type low) {
    const Type z = R::broadcast(0);
    return {R::low_word(low), z, R::template shift_in_zeros<32>(low), high, z};
  }
  /// A single product is not negative below bit 64, so it rounds without a carry of its own.
  template <int shift> static ISO_INLINE Type round_product(Type a, Type b) {
    const FlippedSum p = of_product(a, b);
    const Type half = R::broadcast(std::int64_t{1} << (shift - 1));
    const Type low = R::template shift_in_zeros<shift>(R::add(p.low, half));
    return R::add(R::template shift_left<32 - shift>(p.upper()), low);
  }
  template <int shift> ISO_INLINE Type round() const {
    return round_near<shift, R>(R::add(upper(), carry), R::subtract(low, R::template shift_left<32>(carry)));
  }
  ISO_INLINE Type upper() const {
    return R::add(middle, R::template shift_left<31>(R::subtract(R::add(high, high), both)));
  }
  friend ISO_INLINE FlippedSum operator+(FlippedSum a, FlippedSum b) {
    return {R::add(a.low, b.low), R::add(a.carry, b.carry), R::add(a.middle, b.middle), R::add(a.high, b.high),
            R::add(a.both, b.both)};
  }
  friend ISO_INLINE FlippedSum operator-(FlippedSum a, FlippedSum b) {
    return {R::subtract(a.low, b.low), R::subtract(a.carry, b.carry), R::subtract(a.middle, b.middle),
            R::subtract(a.high, b.high), R::subtract(a.both, b.both)};
  }
};

/// Sums X modulo 2^96 where the low 64 bits of a 64-bit product are one instruction: with bs the high word with its
/// sign, a b = (a bs + as bl) 2^32 + al bl.
///   X = (middle + carry) 2^32 + (low - carry 2^32)
template <class R> struct SignedSum {
  using Type = typename R::Type;
  Type low, carry, middle;

  static ISO_INLINE SignedSum zero() {
    const Type z = R::broadcast(0);
    return {z, z, z};
  }
  static ISO_INLINE SignedSum of_product(Type a, Type b) {
    const Type ll = R::multiply_low_words(a, b);
    return {ll, R::template shift_in_zeros<32>(ll),
            R::add(R::multiply(a, R::template shift_right<32>(b, 0)),
                   R::multiply(R::template shift_right<32>(a, 0), R::low_word(b)))};
  }
  static ISO_INLINE SignedSum of_words(Type high, Type low) {
    const Type z = R::broadcast(0);
    return {R::low_word(low), z, R::add(R::template shift_in_zeros<32>(low), R::template shift_left<32>(high))};
  }
  template <int shift> static ISO_INLINE Type round_product(Type a, Type b) {
    const SignedSum p = of_product(a, b);
    const Type half = R::broadcast(std::int64_t{1} << (shift - 1));
    const Type low = R::template shift_in_zeros<shift>(R::add(p.low, half));
    return R::add(R::template shift_left<32 - shift>(p.middle), low);
  }
  template <int shift> ISO_INLINE Type round() const {
    return round_near<shift, R>(R::add(middle, carry), R::subtract(low, R::template shift_left<32>(carry)));
  }
  friend ISO_INLINE SignedSum operator+(SignedSum a, SignedSum b) {
    return {R::add(a.low, b.low), R::add(a.carry, b.carry), R::add(a.middle, b.middle)};
  }
  friend ISO_INLINE SignedSum operator-(SignedSum a, SignedSum b) {
    return {R::subtract(a.low, b.low), R::subtract(a.carry, b.carry), R::subtract(a.middle, b.middle)};
  }
};

}  // namespace detail
}  // namespace isostep
