// Lanes that fill one register, written once over what an instruction set's header says of its registers.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes.hpp"

namespace isostep {

/// The registers of Isa that hold lanes of Key (detail::LaneKey): `Type`, `kWidth`, a mask's type `Mask`, and the
/// instructions under one name each, as lanes_avx2.hpp lists them. Exists where an instruction set has something better
/// than the plain version. Of 32-bit and 64-bit integers a set has both or neither.
template <class Key, class Isa> struct Registers;

/// W scalars S fill a register of Isa.
template <class S, int W, class Isa>
concept InRegister = Registers<detail::LaneKey<S>, Isa>::kWidth == W;

template <class Key, int W, class Isa>
requires InRegister<Key, W, Isa>
struct LaneMask<Key, W, Isa> {
  using R = Registers<Key, Isa>;
  typename R::Mask v;

  static ISO_INLINE LaneMask from_bits(std::uint32_t bits) { return {R::mask_from_bits(bits)}; }
  friend ISO_INLINE std::uint32_t to_bits(LaneMask a) { return R::bits_of_mask(a.v); }
  friend ISO_INLINE bool any(LaneMask a) { return to_bits(a) != 0; }
  friend ISO_INLINE bool all(LaneMask a) { return to_bits(a) == (1u << W) - 1; }
  friend ISO_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {R::mask_and(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {R::mask_or(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator~(LaneMask a) { return {R::mask_not(a.v)}; }
};

template <class S, int W, class Isa>
requires InRegister<S, W, Isa>
struct Lanes<S, W, Isa> {
  using Key = detail::LaneKey<S>;
  using R = Registers<Key, Isa>;
  using RowKey = std::conditional_t<sizeof(S) == 4, float, double>;  // rows are moved, whatever they hold
  using Rows = Registers<RowKey, Isa>;
  using Scalar = S;
  using Mask = LaneMask<Key, W, Isa>;
  static constexpr int kWidth = W;
  typename R::Type v;

  static ISO_INLINE Lanes load(const S* p) { return {R::load(reinterpret_cast<const Key*>(p))}; }
  ISO_INLINE void store(S* p) const { R::store(reinterpret_cast<Key*>(p), v); }
  static ISO_INLINE Lanes broadcast(S a) {
    if constexpr (kIsFixed<S>) return {R::broadcast(a.raw())};
    if constexpr (!kIsFixed<S>) return {R::broadcast(a)};
  }
  static ISO_INLINE Lanes zero() { return {R::broadcast(Key(0))}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {R::add(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {R::subtract(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) {
    if constexpr (kIsFixed<S>) return zero() - a;
    if constexpr (!kIsFixed<S>) return {R::negate(a.v)};
  }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) requires(!kIsFixed<S>) { return {R::multiply(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) {
    if constexpr (kIsFixed<S>) return divide_to<Lanes>(a, b);
    if constexpr (!kIsFixed<S>) return {R::divide(a.v, b.v)};
  }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {R::min(a.v, b.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {R::max(a.v, b.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) { return {R::abs(a.v)}; }
  friend ISO_INLINE Lanes sqrt(Lanes a) {
    static_assert(!kIsFixed<S>, "roots of fixed point are taken one by one");
    return {R::sqrt(a.v)};
  }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {R::less(a.v, b.v)}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) { return {R::less_equal(a.v, b.v)}; }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {R::equal(a.v, b.v)}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) { return {R::select(mask.v, a.v, b.v)}; }

  template <int N> static ISO_INLINE void load_rows(const S* const* rows, Lanes* out) {
    const RowKey* p[W];
    typename Rows::Type r[N];
    ISO_UNROLL for (int i = 0; i < W; ++i) p[i] = reinterpret_cast<const RowKey*>(rows[i]);
    Rows::template load_rows<N>(p, r);
    ISO_UNROLL for (int n = 0; n < N; ++n) out[n].v = __builtin_bit_cast(typename R::Type, r[n]);
  }
  template <int N> static ISO_INLINE void store_rows(S* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    RowKey* p[W];
    typename Rows::Type r[N];
    ISO_UNROLL for (int i = 0; i < W; ++i) p[i] = reinterpret_cast<RowKey*>(rows[i]);
    ISO_UNROLL for (int n = 0; n < N; ++n) r[n] = __builtin_bit_cast(typename Rows::Type, in[n].v);
    Rows::template store_rows<N>(p, r, lane_mask);
  }
};

/// Exact sums as 64-bit integers, of the even and of the odd lanes.
template <int F, int W, class Isa>
requires InRegister<std::int32_t, W, Isa>
struct LaneSum<FixedSum<std::int32_t, F>, W, Isa> {
  using R = Registers<std::int32_t, Isa>;
  using R64 = Registers<std::int64_t, Isa>;
  typename R64::Type even;
  typename R64::Type odd;

  static ISO_INLINE LaneSum zero() { return {R64::broadcast(0), R64::broadcast(0)}; }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    return {R::multiply_even(a.v, b.v), R::multiply_even(R::odd_to_even(a.v), R::odd_to_even(b.v))};
  }
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, W, Isa> a) {
    constexpr int shift = F - A::kFracBits;
    const auto one = R::broadcast(1);
    return {R64::template shift_left<shift>(R::multiply_even(a.v, one)),
            R64::template shift_left<shift>(R::multiply_even(R::odd_to_even(a.v), one))};
  }
  /// Of every 64-bit sum the 32 bits from bit `shift` on, in the even lanes moved down and in the odd ones up. A shift
  /// beyond 32 must bring in the sign: it shifts the upper words alone.
  template <class Out> ISO_INLINE Lanes<Out, W, Isa> round() const {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift <= 0) {
      return {R::even_and_odd(R64::template shift_left<-shift>(even), R64::template shift_left<32 - shift>(odd))};
    } else {
      const auto half = R64::broadcast(std::int64_t{1} << (shift - 1));
      const auto e = R64::add(even, half);
      const auto o = R64::add(odd, half);
      if constexpr (shift <= 32) {
        return {R::even_and_odd(R64::template shift_in_zeros<shift>(e), R64::template shift_left<32 - shift>(o))};
      } else {
        return {R::template shift_right<shift - 32>(R::even_and_odd(R64::template shift_in_zeros<32>(e), o))};
      }
    }
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    return {R64::add(a.even, b.even), R64::add(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    return {R64::subtract(a.even, b.even), R64::subtract(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

/// Exact sums X modulo 2^128, in columns that carry only once, when they are rounded:
///   X = c2 2^64 + c1 2^32 + c0   modulo 2^128, while fewer than 2^29 products are added
///   X = middle 2^32 + c0         modulo 2^96
/// A rounding by up to 32 bits reads the second line, by more the first; what is not read the compiler removes.
/// With a = ah 2^32 + al read as unsigned, a b = ah bh 2^64 + (ah bl + al bh) 2^32 + al bl, less b 2^64 where a is
/// negative and a 2^64 where b is.
template <int F, int W, class Isa>
requires InRegister<std::int64_t, W, Isa>
struct LaneSum<FixedSum<std::int64_t, F>, W, Isa> {
  using R = Registers<std::int64_t, Isa>;
  using Type = typename R::Type;
  Type c0;
  Type c1;
  Type c2;
  Type middle;

  static ISO_INLINE LaneSum zero() {
    const Type z = R::broadcast(0);
    return {z, z, z, z};
  }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    const Type ah = R::template shift_in_zeros<32>(a.v);
    const Type bh = R::template shift_in_zeros<32>(b.v);
    const Type ll = R::multiply_low_words(a.v, b.v);
    const Type lh = R::multiply_low_words(a.v, bh);
    const Type hl = R::multiply_low_words(ah, b.v);
    const Type carry = R::template shift_in_zeros<32>(ll);
    const Type hh =
        R::subtract(R::multiply_low_words(ah, bh), R::add(R::where_negative(a.v, b.v), R::where_negative(b.v, a.v)));
    const Type cross = R::add(R::low_word(lh), R::low_word(hl));
    const Type cross_high = R::add(R::template shift_in_zeros<32>(lh), R::template shift_in_zeros<32>(hl));
    Type middle;
    if constexpr (R::kMultiplies) {
      middle = R::add(R::multiply(a.v, R::template shift_right<32>(b.v, 0)),
                      R::multiply(R::template shift_right<32>(a.v, 0), R::low_word(b.v)));
    } else {
      middle = R::add(R::add(lh, hl), R::template shift_left<32>(hh));
    }
    return {R::low_word(ll), R::add(carry, cross), R::add(hh, cross_high), R::add(carry, middle)};
  }
  /// x 2^shift: the 128-bit value in two words first, then in columns.
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, W, Isa> a) {
    constexpr int shift = F - A::kFracBits;
    static_assert(shift > 0);
    Type high;
    if constexpr (shift < 64) high = R::template shift_right<64 - shift>(a.v, 0);
    if constexpr (shift >= 64) high = R::template shift_left<shift - 64>(a.v);
    const Type low = R::template shift_left<shift>(a.v);  // zero from 64 on
    const Type c1 = R::template shift_in_zeros<32>(low);
    return {R::low_word(low), c1, high, R::add(c1, R::template shift_left<32>(high))};
  }
  /// The 64 bits from bit `shift` on of X + 2^(shift - 1). The column that holds the rounding bit is shifted with its
  /// sign, for differences leave negative columns; the columns above are multiples of 2^shift and only move.
  template <class Out> ISO_INLINE Lanes<Out, W, Isa> round() const {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift <= 0) {
      return {R::add(R::template shift_left<32 - shift>(middle), R::template shift_left<-shift>(c0))};
    } else {
      constexpr std::uint64_t half = std::uint64_t{1} << ((shift - 1) % 32);
      if constexpr (shift <= 32) {
        return {R::add(R::template shift_left<32 - shift>(middle), R::template shift_right<shift>(c0, half))};
      } else {
        const Type carried = R::add(c1, R::template shift_right<32>(c0, 0));
        if constexpr (shift <= 64) {
          return {R::add(R::template shift_left<64 - shift>(c2), R::template shift_right<shift - 32>(carried, half))};
        } else {
          const Type top = R::add(c2, R::template shift_right<32>(carried, 0));
          return {R::template shift_right<shift - 64>(top, std::uint64_t{1} << (shift - 65))};
        }
      }
    }
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    return {R::add(a.c0, b.c0), R::add(a.c1, b.c1), R::add(a.c2, b.c2), R::add(a.middle, b.middle)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    return {R::subtract(a.c0, b.c0), R::subtract(a.c1, b.c1), R::subtract(a.c2, b.c2), R::subtract(a.middle, b.middle)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

}  // namespace isostep
