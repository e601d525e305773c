// Lanes in WebAssembly's 128-bit registers: four floats or 32-bit fixed point, two doubles or 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__wasm_simd128__)
#error "isostep: include lanes_wasm.hpp only where WebAssembly's SIMD is enabled (-msimd128)"
#endif

#include <wasm_simd128.h>

#include "isostep/scalar/lanes_registers.hpp"

namespace isostep {

namespace isa {
struct WasmSimd {};
}  // namespace isa

namespace detail {
/// Masks of W lanes, each lane all ones or all zeros.
template <int W> struct WasmMasks {
  using Mask = v128_t;
  static constexpr int kWidth = W;

  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) {
    if constexpr (W == 4) {
      const v128_t lane = wasm_i32x4_make(1, 2, 4, 8);
      return wasm_i32x4_eq(wasm_v128_and(wasm_i32x4_splat(static_cast<std::int32_t>(bits)), lane), lane);
    } else {
      const v128_t lane = wasm_i64x2_make(1, 2);
      return wasm_i64x2_eq(wasm_v128_and(wasm_i64x2_splat(bits), lane), lane);
    }
  }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) {
    if constexpr (W == 4) return static_cast<std::uint32_t>(wasm_i32x4_bitmask(a));
    if constexpr (W == 2) return static_cast<std::uint32_t>(wasm_i64x2_bitmask(a));
  }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return wasm_v128_and(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return wasm_v128_or(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return wasm_v128_not(a); }
  static ISO_INLINE v128_t select(Mask m, v128_t a, v128_t b) { return wasm_v128_bitselect(a, b, m); }
};
}  // namespace detail

template <> struct Registers<float, isa::WasmSimd> : detail::WasmMasks<4> {
  using Type = v128_t;

  static ISO_INLINE Type load(const float* p) { return wasm_v128_load(p); }
  static ISO_INLINE void store(float* p, Type a) { wasm_v128_store(p, a); }
  static ISO_INLINE Type broadcast(float a) { return wasm_f32x4_splat(a); }
  static ISO_INLINE Type add(Type a, Type b) { return wasm_f32x4_add(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return wasm_f32x4_sub(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return wasm_f32x4_mul(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return wasm_f32x4_div(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return wasm_f32x4_sqrt(a); }
  static ISO_INLINE Type negate(Type a) { return wasm_f32x4_neg(a); }
  // These are by definition b < a ? b : a and a < b ? b : a.
  static ISO_INLINE Type min(Type a, Type b) { return wasm_f32x4_pmin(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return wasm_f32x4_pmax(a, b); }
  static ISO_INLINE Type abs(Type a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    return wasm_v128_xor(a, wasm_v128_and(wasm_f32x4_lt(a, broadcast(0.0f)), broadcast(-0.0f)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return wasm_f32x4_lt(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return wasm_f32x4_le(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return wasm_f32x4_eq(a, b); }

  static ISO_INLINE void transpose(const Type* in, Type* out) {
    const Type a = wasm_i32x4_shuffle(in[0], in[1], 0, 4, 1, 5);
    const Type b = wasm_i32x4_shuffle(in[0], in[1], 2, 6, 3, 7);
    const Type c = wasm_i32x4_shuffle(in[2], in[3], 0, 4, 1, 5);
    const Type d = wasm_i32x4_shuffle(in[2], in[3], 2, 6, 3, 7);
    out[0] = wasm_i64x2_shuffle(a, c, 0, 2);
    out[1] = wasm_i64x2_shuffle(a, c, 1, 3);
    out[2] = wasm_i64x2_shuffle(b, d, 0, 2);
    out[3] = wasm_i64x2_shuffle(b, d, 1, 3);
  }
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = wasm_v128_load(rows[i] + n);
      transpose(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Type* in, std::uint32_t lane_mask) {
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) transpose(in + n, r + n);
    ISO_UNROLL for (int i = 0; i < 4; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) wasm_v128_store(rows[i] + n, r[n + i]);
    }
  }
};

template <> struct Registers<double, isa::WasmSimd> : detail::WasmMasks<2> {
  using Type = v128_t;

  static ISO_INLINE Type load(const double* p) { return wasm_v128_load(p); }
  static ISO_INLINE void store(double* p, Type a) { wasm_v128_store(p, a); }
  static ISO_INLINE Type broadcast(double a) { return wasm_f64x2_splat(a); }
  static ISO_INLINE Type add(Type a, Type b) { return wasm_f64x2_add(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return wasm_f64x2_sub(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return wasm_f64x2_mul(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return wasm_f64x2_div(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return wasm_f64x2_sqrt(a); }
  static ISO_INLINE Type negate(Type a) { return wasm_f64x2_neg(a); }
  static ISO_INLINE Type min(Type a, Type b) { return wasm_f64x2_pmin(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return wasm_f64x2_pmax(a, b); }
  static ISO_INLINE Type abs(Type a) {
    return wasm_v128_xor(a, wasm_v128_and(wasm_f64x2_lt(a, broadcast(0.0)), broadcast(-0.0)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return wasm_f64x2_lt(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return wasm_f64x2_le(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return wasm_f64x2_eq(a, b); }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      const Type a = wasm_v128_load(rows[0] + n);
      const Type b = wasm_v128_load(rows[1] + n);
      out[n] = wasm_i64x2_shuffle(a, b, 0, 2);
      out[n + 1] = wasm_i64x2_shuffle(a, b, 1, 3);
    }
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Type* in, std::uint32_t lane_mask) {
    if (lane_mask & 1u) {
      ISO_UNROLL for (int n = 0; n < N; n += 2) {
        wasm_v128_store(rows[0] + n, wasm_i64x2_shuffle(in[n], in[n + 1], 0, 2));
      }
    }
    if (lane_mask & 2u) {
      ISO_UNROLL for (int n = 0; n < N; n += 2) {
        wasm_v128_store(rows[1] + n, wasm_i64x2_shuffle(in[n], in[n + 1], 1, 3));
      }
    }
  }
};

template <> struct Registers<std::int32_t, isa::WasmSimd> : detail::WasmMasks<4> {
  using Type = v128_t;

  static ISO_INLINE Type load(const std::int32_t* p) { return wasm_v128_load(p); }
  static ISO_INLINE void store(std::int32_t* p, Type a) { wasm_v128_store(p, a); }
  static ISO_INLINE Type broadcast(std::int32_t a) { return wasm_i32x4_splat(a); }
  static ISO_INLINE Type add(Type a, Type b) { return wasm_i32x4_add(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return wasm_i32x4_sub(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return wasm_i32x4_min(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return wasm_i32x4_max(a, b); }
  static ISO_INLINE Type abs(Type a) { return wasm_i32x4_abs(a); }  // the lowest wraps to itself
  static ISO_INLINE Mask less(Type a, Type b) { return wasm_i32x4_lt(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return wasm_i32x4_le(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return wasm_i32x4_eq(a, b); }

  // The lower half of a register plays the even lanes and its upper half the odd ones: products of halves are one
  // instruction each. Sums only need that even_and_odd brings the lanes back to where they came from.
  static ISO_INLINE v128_t multiply_even(Type a, Type b) { return wasm_i64x2_extmul_low_i32x4(a, b); }
  static ISO_INLINE Type odd_to_even(Type a) { return wasm_i64x2_shuffle(a, a, 1, 1); }
  static ISO_INLINE Type even_and_odd(v128_t even, v128_t odd) { return wasm_i32x4_shuffle(even, odd, 0, 2, 5, 7); }
  template <int N> static ISO_INLINE Type shift_right(Type a) { return wasm_i32x4_shr(a, N); }
};

template <> struct Registers<std::int64_t, isa::WasmSimd> : detail::WasmMasks<2> {
  using Type = v128_t;
  using NearSum = detail::FlippedSum<Registers>;  // processors have no product of 64 bits behind the instruction

  static ISO_INLINE Type load(const std::int64_t* p) { return wasm_v128_load(p); }
  static ISO_INLINE void store(std::int64_t* p, Type a) { wasm_v128_store(p, a); }
  static ISO_INLINE Type broadcast(std::int64_t a) { return wasm_i64x2_splat(a); }
  static ISO_INLINE Type add(Type a, Type b) { return wasm_i64x2_add(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return wasm_i64x2_sub(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return select(less(b, a), b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return select(less(a, b), b, a); }
  static ISO_INLINE Type abs(Type a) { return wasm_i64x2_abs(a); }
  static ISO_INLINE Mask less(Type a, Type b) { return wasm_i64x2_lt(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return wasm_i64x2_le(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return wasm_i64x2_eq(a, b); }

  static ISO_INLINE Type multiply_low_words(Type a, Type b) {
    return wasm_u64x2_extmul_low_u32x4(wasm_i32x4_shuffle(a, a, 0, 2, 0, 2), wasm_i32x4_shuffle(b, b, 0, 2, 0, 2));
  }
  static ISO_INLINE Type multiply_low(Type a, Type b) { return wasm_i64x2_mul(a, b); }
  /// Returns an integer next to n / a, for a and it in [0, 2^52), by doubles whose mantissa is 2^52 plus the number.
  static ISO_INLINE Type quotient_near(double n, Type a) {
    const v128_t shift = wasm_f64x2_splat(0x1p52);
    const v128_t divisor = wasm_f64x2_sub(wasm_v128_or(a, shift), shift);
    return wasm_v128_xor(wasm_f64x2_add(wasm_f64x2_div(wasm_f64x2_splat(n), divisor), shift), shift);
  }
  static ISO_INLINE Type low_word(Type a) { return wasm_v128_and(a, wasm_i64x2_splat(0xffffffff)); }
  static ISO_INLINE Type flip(Type a, std::uint64_t mask) {
    return wasm_v128_xor(a, wasm_i64x2_splat(static_cast<std::int64_t>(mask)));
  }
  /// Returns b where a is negative, else zero.
  static ISO_INLINE Type where_negative(Type a, Type b) { return wasm_v128_and(wasm_i64x2_shr(a, 63), b); }
  // Instructions take the shift modulo 64.
  template <int N> static ISO_INLINE Type shift_left(Type a) {
    if constexpr (N < 64) return wasm_i64x2_shl(a, N);
    if constexpr (N >= 64) return wasm_i64x2_splat(0);
  }
  template <int N> static ISO_INLINE Type shift_in_zeros(Type a) { return wasm_u64x2_shr(a, N); }
  /// (x + half) >> N with the sign, N in 1..63.
  template <int N> static ISO_INLINE Type shift_right(Type x, std::uint64_t half) {
    return wasm_i64x2_shr(wasm_i64x2_add(x, wasm_i64x2_splat(static_cast<std::int64_t>(half))), N);
  }
};

}  // namespace isostep
