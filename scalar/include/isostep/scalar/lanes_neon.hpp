// Lanes in the NEON registers of 64-bit Arm: four floats or 32-bit fixed point, two doubles or 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__AARCH64EL__) || !defined(__ARM_NEON)
#error "isostep: include lanes_neon.hpp only for little-endian 64-bit Arm with NEON, which all of them have"
#endif

#include <arm_neon.h>

#include "isostep/scalar/lanes_registers.hpp"

namespace isostep {

namespace isa {
struct Neon {};
}  // namespace isa

namespace detail {
/// Masks of W lanes, each lane all ones or all zeros.
template <int W> struct NeonMasks;
template <> struct NeonMasks<4> {
  using Mask = uint32x4_t;
  static constexpr int kWidth = 4;

  static ISO_INLINE Mask lane_bits() {
    return vcombine_u32(vcreate_u32(0x0000000200000001u), vcreate_u32(0x0000000800000004u));
  }
  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) { return vtstq_u32(vdupq_n_u32(bits), lane_bits()); }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) { return vaddvq_u32(vandq_u32(a, lane_bits())); }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return vandq_u32(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return vorrq_u32(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return vmvnq_u32(a); }
};
template <> struct NeonMasks<2> {
  using Mask = uint64x2_t;
  static constexpr int kWidth = 2;

  static ISO_INLINE Mask lane_bits() { return vcombine_u64(vcreate_u64(1), vcreate_u64(2)); }
  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) { return vtstq_u64(vdupq_n_u64(bits), lane_bits()); }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) {
    return static_cast<std::uint32_t>(vaddvq_u64(vandq_u64(a, lane_bits())));
  }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return vandq_u64(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return vorrq_u64(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return vreinterpretq_u64_u32(vmvnq_u32(vreinterpretq_u32_u64(a))); }
};
}  // namespace detail

// Products and sums stay two instructions: nothing here may become one that rounds once (vmla, vfma).
template <> struct Registers<float, isa::Neon> : detail::NeonMasks<4> {
  using Type = float32x4_t;

  static ISO_INLINE Type load(const float* p) { return vld1q_f32(p); }
  static ISO_INLINE void store(float* p, Type a) { vst1q_f32(p, a); }
  static ISO_INLINE Type broadcast(float a) { return vdupq_n_f32(a); }
  static ISO_INLINE Type add(Type a, Type b) { return vaddq_f32(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return vsubq_f32(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return vmulq_f32(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return vdivq_f32(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return vsqrtq_f32(a); }
  static ISO_INLINE Type negate(Type a) { return vnegq_f32(a); }
  // b < a ? b : a and a < b ? b : a. The instructions for them return NaN for any NaN, and order the zeros.
  static ISO_INLINE Type min(Type a, Type b) { return vbslq_f32(vcltq_f32(b, a), b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return vbslq_f32(vcltq_f32(a, b), b, a); }
  static ISO_INLINE Type abs(Type a) { return vbslq_f32(vcltzq_f32(a), vnegq_f32(a), a); }  // -0.0 and NaN keep theirs
  static ISO_INLINE Mask less(Type a, Type b) { return vcltq_f32(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return vcleq_f32(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return vceqq_f32(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return vbslq_f32(m, a, b); }

  static ISO_INLINE Type low_halves(Type a, Type b) {
    return vreinterpretq_f32_f64(vzip1q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)));
  }
  static ISO_INLINE Type high_halves(Type a, Type b) {
    return vreinterpretq_f32_f64(vzip2q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)));
  }
  static ISO_INLINE void transpose(const Type* in, Type* out) {
    const Type a = vzip1q_f32(in[0], in[1]);
    const Type b = vzip2q_f32(in[0], in[1]);
    const Type c = vzip1q_f32(in[2], in[3]);
    const Type d = vzip2q_f32(in[2], in[3]);
    out[0] = low_halves(a, c);
    out[1] = high_halves(a, c);
    out[2] = low_halves(b, d);
    out[3] = high_halves(b, d);
  }
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = vld1q_f32(rows[i] + n);
      transpose(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Type* in, std::uint32_t lane_mask) {
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) transpose(in + n, r + n);
    ISO_UNROLL for (int i = 0; i < 4; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) vst1q_f32(rows[i] + n, r[n + i]);
    }
  }
};

template <> struct Registers<double, isa::Neon> : detail::NeonMasks<2> {
  using Type = float64x2_t;

  static ISO_INLINE Type load(const double* p) { return vld1q_f64(p); }
  static ISO_INLINE void store(double* p, Type a) { vst1q_f64(p, a); }
  static ISO_INLINE Type broadcast(double a) { return vdupq_n_f64(a); }
  static ISO_INLINE Type add(Type a, Type b) { return vaddq_f64(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return vsubq_f64(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return vmulq_f64(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return vdivq_f64(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return vsqrtq_f64(a); }
  static ISO_INLINE Type negate(Type a) { return vnegq_f64(a); }
  static ISO_INLINE Type min(Type a, Type b) { return vbslq_f64(vcltq_f64(b, a), b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return vbslq_f64(vcltq_f64(a, b), b, a); }
  static ISO_INLINE Type abs(Type a) { return vbslq_f64(vcltzq_f64(a), vnegq_f64(a), a); }
  static ISO_INLINE Mask less(Type a, Type b) { return vcltq_f64(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return vcleq_f64(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return vceqq_f64(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return vbslq_f64(m, a, b); }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      const Type a = vld1q_f64(rows[0] + n);
      const Type b = vld1q_f64(rows[1] + n);
      out[n] = vzip1q_f64(a, b);
      out[n + 1] = vzip2q_f64(a, b);
    }
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Type* in, std::uint32_t lane_mask) {
    if (lane_mask & 1u) {
      ISO_UNROLL for (int n = 0; n < N; n += 2) vst1q_f64(rows[0] + n, vzip1q_f64(in[n], in[n + 1]));
    }
    if (lane_mask & 2u) {
      ISO_UNROLL for (int n = 0; n < N; n += 2) vst1q_f64(rows[1] + n, vzip2q_f64(in[n], in[n + 1]));
    }
  }
};

template <> struct Registers<std::int32_t, isa::Neon> : detail::NeonMasks<4> {
  using Type = int32x4_t;

  static ISO_INLINE Type load(const std::int32_t* p) { return vld1q_s32(p); }
  static ISO_INLINE void store(std::int32_t* p, Type a) { vst1q_s32(p, a); }
  static ISO_INLINE Type broadcast(std::int32_t a) { return vdupq_n_s32(a); }
  static ISO_INLINE Type add(Type a, Type b) { return vaddq_s32(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return vsubq_s32(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return vminq_s32(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return vmaxq_s32(a, b); }
  static ISO_INLINE Type abs(Type a) { return vabsq_s32(a); }  // the lowest wraps to itself
  static ISO_INLINE Mask less(Type a, Type b) { return vcltq_s32(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return vcleq_s32(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return vceqq_s32(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return vbslq_s32(m, a, b); }

  // The lower half of a register plays the even lanes and its upper half the odd ones: products of halves are one
  // instruction each. Sums only need that even_and_odd brings the lanes back to where they came from.
  static ISO_INLINE int64x2_t multiply_even(Type a, Type b) { return vmull_s32(vget_low_s32(a), vget_low_s32(b)); }
  static ISO_INLINE Type odd_to_even(Type a) { return vcombine_s32(vget_high_s32(a), vget_high_s32(a)); }
  static ISO_INLINE Type even_and_odd(int64x2_t even, int64x2_t odd) {
    return vcombine_s32(vmovn_s64(even), vshrn_n_s64(odd, 32));
  }
  template <int N> static ISO_INLINE Type shift_right(Type a) { return vshlq_s32(a, vdupq_n_s32(-N)); }
};

template <> struct Registers<std::int64_t, isa::Neon> : detail::NeonMasks<2> {
  using Type = int64x2_t;
  using NearSum = detail::FlippedSum<Registers>;  // no product of 64 bits

  static ISO_INLINE uint64x2_t bits(Type a) { return vreinterpretq_u64_s64(a); }
  static ISO_INLINE Type number(uint64x2_t a) { return vreinterpretq_s64_u64(a); }

  static ISO_INLINE Type load(const std::int64_t* p) { return vld1q_s64(p); }
  static ISO_INLINE void store(std::int64_t* p, Type a) { vst1q_s64(p, a); }
  static ISO_INLINE Type broadcast(std::int64_t a) { return vdupq_n_s64(a); }
  static ISO_INLINE Type add(Type a, Type b) { return vaddq_s64(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return vsubq_s64(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return select(less(b, a), b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return select(less(a, b), b, a); }
  static ISO_INLINE Type abs(Type a) { return vabsq_s64(a); }
  static ISO_INLINE Mask less(Type a, Type b) { return vcltq_s64(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return vcleq_s64(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return vceqq_s64(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return vbslq_s64(m, a, b); }

  static ISO_INLINE Type multiply_low_words(Type a, Type b) {
    return number(vmull_u32(vmovn_u64(bits(a)), vmovn_u64(bits(b))));
  }
  static ISO_INLINE Type multiply_low(Type a, Type b) {
    const Type cross = add(multiply_low_words(shift_in_zeros<32>(a), b), multiply_low_words(a, shift_in_zeros<32>(b)));
    return add(multiply_low_words(a, b), shift_left<32>(cross));
  }
  /// Returns an integer next to n / a, for a in [0, 2^52) and it in [0, 2^63).
  static ISO_INLINE Type quotient_near(double n, Type a) {
    return vcvtq_s64_f64(vdivq_f64(vdupq_n_f64(n), vcvtq_f64_s64(a)));
  }
  static ISO_INLINE Type low_word(Type a) { return vandq_s64(a, vdupq_n_s64(0xffffffff)); }
  static ISO_INLINE Type flip(Type a, std::uint64_t mask) { return number(veorq_u64(bits(a), vdupq_n_u64(mask))); }
  /// Returns b where a is negative, else zero.
  static ISO_INLINE Type where_negative(Type a, Type b) { return vandq_s64(vshrq_n_s64(a, 63), b); }
  template <int N> static ISO_INLINE Type shift_left(Type a) {
    if constexpr (N < 64) return vshlq_n_s64(a, N);
    if constexpr (N >= 64) return vdupq_n_s64(0);
  }
  template <int N> static ISO_INLINE Type shift_in_zeros(Type a) { return number(vshrq_n_u64(bits(a), N)); }
  /// (x + half) >> N with the sign, N in 1..63.
  template <int N> static ISO_INLINE Type shift_right(Type x, std::uint64_t half) {
    return vshrq_n_s64(vaddq_s64(x, vdupq_n_s64(static_cast<std::int64_t>(half))), N);
  }
};

}  // namespace isostep
