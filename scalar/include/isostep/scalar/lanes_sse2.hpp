// Lanes in SSE2 registers: four floats or two doubles. Fixed point keeps the plain version: SSE2 has no signed product.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__SSE2__) && !defined(_M_X64)
#error "isostep: include lanes_sse2.hpp only where SSE2 is enabled (-msse2)"
#endif

#include <emmintrin.h>

#include "isostep/scalar/lanes_registers.hpp"

namespace isostep {

namespace isa {
struct Sse2 {};
}  // namespace isa

/// Masks are all ones or all zeros in each lane, as everywhere before AVX-512.
template <> struct Registers<float, isa::Sse2> {
  using Type = __m128;
  using Mask = __m128;
  static constexpr int kWidth = 4;

  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) {
    const __m128i lane = _mm_set_epi32(8, 4, 2, 1);
    return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane), lane));
  }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) { return static_cast<std::uint32_t>(_mm_movemask_ps(a)); }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return _mm_and_ps(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return _mm_or_ps(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1))); }

  static ISO_INLINE Type load(const float* p) { return _mm_load_ps(p); }
  static ISO_INLINE void store(float* p, Type a) { _mm_store_ps(p, a); }
  static ISO_INLINE Type broadcast(float a) { return _mm_set1_ps(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm_add_ps(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm_sub_ps(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm_mul_ps(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm_div_ps(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm_sqrt_ps(a); }
  static ISO_INLINE Type negate(Type a) { return _mm_xor_ps(a, _mm_set1_ps(-0.0f)); }
  // The instruction returns its second operand when neither is smaller: exactly b < a ? b : a and a < b ? b : a.
  static ISO_INLINE Type min(Type a, Type b) { return _mm_min_ps(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm_max_ps(b, a); }
  static ISO_INLINE Type abs(Type a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    return _mm_xor_ps(a, _mm_and_ps(_mm_cmplt_ps(a, _mm_setzero_ps()), _mm_set1_ps(-0.0f)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm_cmplt_ps(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm_cmple_ps(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm_cmpeq_ps(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)); }

  static ISO_INLINE void transpose(const Type* in, Type* out) {
    const __m128 a = _mm_unpacklo_ps(in[0], in[1]);
    const __m128 b = _mm_unpackhi_ps(in[0], in[1]);
    const __m128 c = _mm_unpacklo_ps(in[2], in[3]);
    const __m128 d = _mm_unpackhi_ps(in[2], in[3]);
    out[0] = _mm_movelh_ps(a, c);
    out[1] = _mm_movehl_ps(c, a);
    out[2] = _mm_movelh_ps(b, d);
    out[3] = _mm_movehl_ps(d, b);
  }
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = _mm_loadu_ps(rows[i] + n);
      transpose(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Type* in, std::uint32_t lane_mask) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      transpose(in + n, r);
      ISO_UNROLL for (int i = 0; i < 4; ++i) {
        if ((lane_mask >> i) & 1u) _mm_storeu_ps(rows[i] + n, r[i]);
      }
    }
  }
};

template <> struct Registers<double, isa::Sse2> {
  using Type = __m128d;
  using Mask = __m128d;
  static constexpr int kWidth = 2;

  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) {
    const __m128i lane = _mm_set_epi32(2, 2, 1, 1);
    return _mm_castsi128_pd(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane), lane));
  }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) { return static_cast<std::uint32_t>(_mm_movemask_pd(a)); }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return _mm_and_pd(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return _mm_or_pd(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return _mm_xor_pd(a, _mm_castsi128_pd(_mm_set1_epi32(-1))); }

  static ISO_INLINE Type load(const double* p) { return _mm_load_pd(p); }
  static ISO_INLINE void store(double* p, Type a) { _mm_store_pd(p, a); }
  static ISO_INLINE Type broadcast(double a) { return _mm_set1_pd(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm_add_pd(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm_sub_pd(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm_mul_pd(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm_div_pd(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm_sqrt_pd(a); }
  static ISO_INLINE Type negate(Type a) { return _mm_xor_pd(a, _mm_set1_pd(-0.0)); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm_min_pd(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm_max_pd(b, a); }
  static ISO_INLINE Type abs(Type a) {
    return _mm_xor_pd(a, _mm_and_pd(_mm_cmplt_pd(a, _mm_setzero_pd()), _mm_set1_pd(-0.0)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm_cmplt_pd(a, b); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm_cmple_pd(a, b); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm_cmpeq_pd(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b)); }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      const __m128d a = _mm_loadu_pd(rows[0] + n);
      const __m128d b = _mm_loadu_pd(rows[1] + n);
      out[n] = _mm_unpacklo_pd(a, b);
      out[n + 1] = _mm_unpackhi_pd(a, b);
    }
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Type* in, std::uint32_t lane_mask) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      if (lane_mask & 1u) _mm_storeu_pd(rows[0] + n, _mm_unpacklo_pd(in[n], in[n + 1]));
      if (lane_mask & 2u) _mm_storeu_pd(rows[1] + n, _mm_unpackhi_pd(in[n], in[n + 1]));
    }
  }
};

}  // namespace isostep
