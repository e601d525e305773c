// Lanes that fill one register, written once over what an instruction set's header says of its registers.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes.hpp"
#include "isostep/scalar/lanes_wide_sums.hpp"

namespace isostep {

/// The registers of Isa that hold lanes of Key (detail::LaneKey): `Type`, `kWidth`, a mask's type `Mask`, and the
/// instructions under one name each, as lanes_avx2.hpp lists them. It exists where an instruction set has something
/// better than the plain version. A set has both 32-bit and 64-bit integers, or neither.
template <class Key, class Isa> struct Registers;

/// The number of scalars S that a register of Isa holds.
template <class S, class Isa> inline constexpr int kRegisterLanes = Registers<detail::LaneKey<S>, Isa>::kWidth;

/// True if W scalars S fill a register of Isa.
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

/// Exact sums as 64-bit integers: those of the even lanes, and those of the odd lanes.
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
  /// Takes 32 bits of every 64-bit sum, from bit `shift` on: of the even lanes moved down, of the odd ones up. A shift
  /// beyond 32 must bring in the sign, so it shifts the upper words alone.
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
  template <class Out, class A, class B>
  static ISO_INLINE Lanes<Out, W, Isa> round_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    return of_product(a, b).template round<Out>();
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    return {R64::add(a.even, b.even), R64::add(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    return {R64::subtract(a.even, b.even), R64::subtract(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

/// Exact sums X of 64-bit products, twice: `distant` modulo 2^128, and `nearby` modulo 2^96, which is all that a
/// rounding by up to 32 bits reads, at half the work. The compiler removes what is not read.
template <int F, int W, class Isa>
requires InRegister<std::int64_t, W, Isa>
struct LaneSum<FixedSum<std::int64_t, F>, W, Isa> {
  using R = Registers<std::int64_t, Isa>;
  using Near = typename R::NearSum;
  detail::FarSum<R> distant;
  Near nearby;

  static ISO_INLINE LaneSum zero() { return {detail::FarSum<R>::zero(), Near::zero()}; }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    return {detail::FarSum<R>::of_product(a.v, b.v), Near::of_product(a.v, b.v)};
  }
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, W, Isa> a) {
    constexpr int shift = F - A::kFracBits;
    static_assert(shift > 0);
    // x 2^shift: the 128-bit value in two words
    typename R::Type high;
    if constexpr (shift < 64) high = R::template shift_right<64 - shift>(a.v, 0);
    if constexpr (shift >= 64) high = R::template shift_left<shift - 64>(a.v);
    const auto low = R::template shift_left<shift>(a.v);  // zero from 64 on
    return {detail::FarSum<R>::of_words(high, low), Near::of_words(high, low)};
  }
  template <class Out> ISO_INLINE Lanes<Out, W, Isa> round() const {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift <= 32) return {nearby.template round<shift>()};
    if constexpr (shift > 32) return {distant.template round<shift>()};
  }
  template <class Out, class A, class B>
  static ISO_INLINE Lanes<Out, W, Isa> round_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift > 0 && shift <= 32) return {Near::template round_product<shift>(a.v, b.v)};
    if constexpr (shift <= 0 || shift > 32) return of_product(a, b).template round<Out>();
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) { return {a.distant + b.distant, a.nearby + b.nearby}; }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) { return {a.distant - b.distant, a.nearby - b.nearby}; }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

}  // namespace isostep
