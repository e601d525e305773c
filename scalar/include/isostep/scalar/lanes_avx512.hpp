// Lanes in AVX-512 registers: sixteen floats or 32-bit fixed point, eight doubles or 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__AVX512F__) || !defined(__AVX512DQ__) || !defined(__AVX512VL__)
#error "isostep: include lanes_avx512.hpp only in files compiled with -mavx512f -mavx512dq -mavx512vl, for such CPUs"
#endif

#include <immintrin.h>

#include "isostep/scalar/lanes_registers.hpp"

// Many intrinsics of gcc name a register of undefined content under a mask that lets none of it through: gcc PR 105593.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace isostep {

namespace isa {
struct Avx512 {};
}  // namespace isa

namespace detail {
/// Masks in registers of their own kind: lane i is bit i.
template <int W> struct Avx512Masks {
  using Mask = std::conditional_t<W == 16, __mmask16, __mmask8>;
  static constexpr int kWidth = W;

  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) { return static_cast<Mask>(bits); }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) { return a; }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return static_cast<Mask>(a | b); }
  static ISO_INLINE Mask mask_not(Mask a) { return static_cast<Mask>(~a); }
};

/// Transposes a 4 x 4 block of 32-bit lanes in each 128-bit quarter.
ISO_INLINE void transpose_quarters(const __m512* in, __m512* out) {
  const __m512 a = _mm512_unpacklo_ps(in[0], in[1]);
  const __m512 b = _mm512_unpackhi_ps(in[0], in[1]);
  const __m512 c = _mm512_unpacklo_ps(in[2], in[3]);
  const __m512 d = _mm512_unpackhi_ps(in[2], in[3]);
  out[0] = _mm512_shuffle_ps(a, c, 0x44);
  out[1] = _mm512_shuffle_ps(a, c, 0xee);
  out[2] = _mm512_shuffle_ps(b, d, 0x44);
  out[3] = _mm512_shuffle_ps(b, d, 0xee);
}
/// `index` is a constant once loops are unrolled, but the compiler's check of an immediate does not see that.
ISO_INLINE __m128 quarter(__m512 a, int index) {
  if (index == 0) return _mm512_castps512_ps128(a);
  if (index == 1) return _mm512_extractf32x4_ps(a, 1);
  return index == 2 ? _mm512_extractf32x4_ps(a, 2) : _mm512_extractf32x4_ps(a, 3);
}
}  // namespace detail

template <> struct Registers<float, isa::Avx512> : detail::Avx512Masks<16> {
  using Type = __m512;

  static ISO_INLINE Type load(const float* p) { return _mm512_load_ps(p); }
  static ISO_INLINE void store(float* p, Type a) { _mm512_store_ps(p, a); }
  static ISO_INLINE Type broadcast(float a) { return _mm512_set1_ps(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm512_add_ps(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm512_sub_ps(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm512_mul_ps(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm512_div_ps(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm512_sqrt_ps(a); }
  static ISO_INLINE Type negate(Type a) { return _mm512_xor_ps(a, _mm512_set1_ps(-0.0f)); }
  // The instruction returns its second operand when neither is smaller: exactly b < a ? b : a and a < b ? b : a.
  static ISO_INLINE Type min(Type a, Type b) { return _mm512_min_ps(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm512_max_ps(b, a); }
  static ISO_INLINE Type abs(Type a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    return _mm512_mask_xor_ps(a, less(a, _mm512_setzero_ps()), a, _mm512_set1_ps(-0.0f));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm512_mask_blend_ps(m, b, a); }

  // Rows i, i + 4, i + 8 and i + 12 share a register, so that only loads and stores cross the quarters.
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) {
        r[i] = _mm512_castps128_ps512(_mm_loadu_ps(rows[i] + n));
        r[i] = _mm512_insertf32x4(r[i], _mm_loadu_ps(rows[i + 4] + n), 1);
        r[i] = _mm512_insertf32x4(r[i], _mm_loadu_ps(rows[i + 8] + n), 2);
        r[i] = _mm512_insertf32x4(r[i], _mm_loadu_ps(rows[i + 12] + n), 3);
      }
      detail::transpose_quarters(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Type* in, std::uint32_t lane_mask) {
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) detail::transpose_quarters(in + n, r + n);
    ISO_UNROLL for (int i = 0; i < 16; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) _mm_storeu_ps(rows[i] + n, detail::quarter(r[n + i % 4], i / 4));
    }
  }
};

template <> struct Registers<double, isa::Avx512> : detail::Avx512Masks<8> {
  using Type = __m512d;

  static ISO_INLINE Type load(const double* p) { return _mm512_load_pd(p); }
  static ISO_INLINE void store(double* p, Type a) { _mm512_store_pd(p, a); }
  static ISO_INLINE Type broadcast(double a) { return _mm512_set1_pd(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm512_add_pd(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm512_sub_pd(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm512_mul_pd(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm512_div_pd(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm512_sqrt_pd(a); }
  static ISO_INLINE Type negate(Type a) { return _mm512_xor_pd(a, _mm512_set1_pd(-0.0)); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm512_min_pd(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm512_max_pd(b, a); }
  static ISO_INLINE Type abs(Type a) {
    return _mm512_mask_xor_pd(a, less(a, _mm512_setzero_pd()), a, _mm512_set1_pd(-0.0));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm512_mask_blend_pd(m, b, a); }

  // Rows 0 1 4 5 share registers with rows 2 3 6 7: so paired, the quarters come out in order.
  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) {
        const int row = i % 2 + i / 2 * 4;
        r[i] = _mm512_castpd256_pd512(_mm256_loadu_pd(rows[row] + n));
        r[i] = _mm512_insertf64x4(r[i], _mm256_loadu_pd(rows[row + 2] + n), 1);
      }
      const Type a = _mm512_unpacklo_pd(r[0], r[1]);
      const Type b = _mm512_unpackhi_pd(r[0], r[1]);
      const Type c = _mm512_unpacklo_pd(r[2], r[3]);
      const Type d = _mm512_unpackhi_pd(r[2], r[3]);
      out[n] = _mm512_shuffle_f64x2(a, c, 0x88);
      out[n + 1] = _mm512_shuffle_f64x2(b, d, 0x88);
      out[n + 2] = _mm512_shuffle_f64x2(a, c, 0xdd);
      out[n + 3] = _mm512_shuffle_f64x2(b, d, 0xdd);
    }
  }
  // Whole halves are stored, as they are loaded: what is stored in pieces a wider load would have to wait for.
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Type* in, std::uint32_t lane_mask) {
    const __m512i first = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
    const __m512i last = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      const Type a = _mm512_unpacklo_pd(in[n], in[n + 1]);
      const Type b = _mm512_unpackhi_pd(in[n], in[n + 1]);
      const Type c = _mm512_unpacklo_pd(in[n + 2], in[n + 3]);
      const Type d = _mm512_unpackhi_pd(in[n + 2], in[n + 3]);
      r[n] = _mm512_permutex2var_pd(a, first, c);
      r[n + 1] = _mm512_permutex2var_pd(b, first, d);
      r[n + 2] = _mm512_permutex2var_pd(a, last, c);
      r[n + 3] = _mm512_permutex2var_pd(b, last, d);
    }
    ISO_UNROLL for (int i = 0; i < 8; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) {
        const Type both = r[n + i % 2 + i / 4 * 2];
        _mm256_storeu_pd(rows[i] + n, i % 4 < 2 ? _mm512_castpd512_pd256(both) : _mm512_extractf64x4_pd(both, 1));
      }
    }
  }
};

template <> struct Registers<std::int32_t, isa::Avx512> : detail::Avx512Masks<16> {
  using Type = __m512i;

  static ISO_INLINE Type load(const std::int32_t* p) { return _mm512_load_si512(p); }
  static ISO_INLINE void store(std::int32_t* p, Type a) { _mm512_store_si512(p, a); }
  static ISO_INLINE Type broadcast(std::int32_t a) { return _mm512_set1_epi32(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm512_add_epi32(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm512_sub_epi32(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm512_min_epi32(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm512_max_epi32(a, b); }
  static ISO_INLINE Type abs(Type a) { return _mm512_abs_epi32(a); }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm512_cmplt_epi32_mask(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm512_cmple_epi32_mask(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm512_cmpeq_epi32_mask(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm512_mask_blend_epi32(m, b, a); }

  static ISO_INLINE __m512i multiply_even(Type a, Type b) { return _mm512_mul_epi32(a, b); }
  static ISO_INLINE Type odd_to_even(Type a) { return _mm512_srli_epi64(a, 32); }
  static ISO_INLINE Type even_and_odd(Type even, Type odd) { return _mm512_mask_blend_epi32(0xaaaa, even, odd); }
  template <int N> static ISO_INLINE Type shift_right(Type a) { return _mm512_srai_epi32(a, N); }
};

template <> struct Registers<std::int64_t, isa::Avx512> : detail::Avx512Masks<8> {
  using Type = __m512i;
  using NearSum = detail::SignedSum<Registers>;

  static ISO_INLINE Type load(const std::int64_t* p) { return _mm512_load_si512(p); }
  static ISO_INLINE void store(std::int64_t* p, Type a) { _mm512_store_si512(p, a); }
  static ISO_INLINE Type broadcast(std::int64_t a) { return _mm512_set1_epi64(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm512_add_epi64(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm512_sub_epi64(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm512_mullo_epi64(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm512_min_epi64(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm512_max_epi64(a, b); }
  static ISO_INLINE Type abs(Type a) { return _mm512_abs_epi64(a); }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm512_cmplt_epi64_mask(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm512_cmple_epi64_mask(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm512_cmpeq_epi64_mask(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm512_mask_blend_epi64(m, b, a); }

  static ISO_INLINE Type multiply_low_words(Type a, Type b) { return _mm512_mul_epu32(a, b); }
  static ISO_INLINE Type multiply_low(Type a, Type b) { return multiply(a, b); }
  /// Returns an integer next to n / a, for a and it in [0, 2^52).
  static ISO_INLINE Type quotient_near(double n, Type a) {
    return _mm512_cvtpd_epi64(_mm512_div_pd(_mm512_set1_pd(n), _mm512_cvtepi64_pd(a)));
  }
  static ISO_INLINE Type low_word(Type a) { return _mm512_and_si512(a, _mm512_set1_epi64(0xffffffff)); }
  static ISO_INLINE Type where_negative(Type a, Type b) { return _mm512_maskz_mov_epi64(_mm512_movepi64_mask(a), b); }
  template <int N> static ISO_INLINE Type shift_left(Type a) { return _mm512_slli_epi64(a, N); }
  template <int N> static ISO_INLINE Type shift_in_zeros(Type a) { return _mm512_srli_epi64(a, N); }
  template <int N> static ISO_INLINE Type shift_right(Type x, std::uint64_t half) {
    return _mm512_srai_epi64(_mm512_add_epi64(x, _mm512_set1_epi64(static_cast<std::int64_t>(half))), N);
  }
};

}  // namespace isostep

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
