// Lanes in SSE2 registers: four floats or two doubles. Fixed point keeps the plain version: SSE2 has no signed product.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__SSE2__) && !defined(_M_X64)
#error "isostep: include lanes_sse2.hpp only where SSE2 is enabled (-msse2)"
#endif

#include <emmintrin.h>

#include "isostep/scalar/lanes.hpp"

namespace isostep {

namespace isa {
struct Sse2 {};
}  // namespace isa

template <> struct LaneMask<float, 4, isa::Sse2> {
  __m128 v;

  static ISO_INLINE LaneMask from_bits(std::uint32_t bits) {
    const __m128i lane = _mm_set_epi32(8, 4, 2, 1);
    const __m128i chosen = _mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane);
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(chosen, lane))};
  }
  friend ISO_INLINE std::uint32_t to_bits(LaneMask a) { return static_cast<std::uint32_t>(_mm_movemask_ps(a.v)); }
  friend ISO_INLINE bool any(LaneMask a) { return to_bits(a) != 0; }
  friend ISO_INLINE bool all(LaneMask a) { return to_bits(a) == 0xfu; }
  friend ISO_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {_mm_and_ps(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {_mm_or_ps(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator~(LaneMask a) { return {_mm_xor_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(-1)))}; }
};

template <> struct Lanes<float, 4, isa::Sse2> {
  using Scalar = float;
  using Mask = LaneMask<float, 4, isa::Sse2>;
  static constexpr int kWidth = 4;
  __m128 v;

  static ISO_INLINE Lanes load(const float* p) { return {_mm_load_ps(p)}; }
  ISO_INLINE void store(float* p) const { _mm_store_ps(p, v); }
  static ISO_INLINE Lanes broadcast(float a) { return {_mm_set1_ps(a)}; }
  static ISO_INLINE Lanes zero() { return {_mm_setzero_ps()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm_add_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return {_mm_xor_ps(a.v, _mm_set1_ps(-0.0f))}; }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) { return {_mm_mul_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return {_mm_div_ps(a.v, b.v)}; }
  // The instruction answers its second operand when neither is smaller: exactly b < a ? b : a and a < b ? b : a.
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {_mm_min_ps(b.v, a.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {_mm_max_ps(b.v, a.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    const __m128 negative = _mm_cmplt_ps(a.v, _mm_setzero_ps());
    return {_mm_xor_ps(a.v, _mm_and_ps(negative, _mm_set1_ps(-0.0f)))};
  }
  friend ISO_INLINE Lanes sqrt(Lanes a) { return {_mm_sqrt_ps(a.v)}; }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm_cmplt_ps(a.v, b.v)}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) { return {_mm_cmple_ps(a.v, b.v)}; }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm_cmpeq_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) {
    return {_mm_or_ps(_mm_and_ps(mask.v, a.v), _mm_andnot_ps(mask.v, b.v))};
  }

  static ISO_INLINE void transpose(const Lanes* in, Lanes* out) {
    const __m128 a = _mm_unpacklo_ps(in[0].v, in[1].v);
    const __m128 b = _mm_unpackhi_ps(in[0].v, in[1].v);
    const __m128 c = _mm_unpacklo_ps(in[2].v, in[3].v);
    const __m128 d = _mm_unpackhi_ps(in[2].v, in[3].v);
    out[0] = {_mm_movelh_ps(a, c)};
    out[1] = {_mm_movehl_ps(c, a)};
    out[2] = {_mm_movelh_ps(b, d)};
    out[3] = {_mm_movehl_ps(d, b)};
  }
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Lanes* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Lanes r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = {_mm_loadu_ps(rows[i] + n)};
      transpose(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Lanes r[4];
      transpose(in + n, r);
      ISO_UNROLL for (int i = 0; i < 4; ++i) {
        if ((lane_mask >> i) & 1u) _mm_storeu_ps(rows[i] + n, r[i].v);
      }
    }
  }
};

template <> struct LaneMask<double, 2, isa::Sse2> {
  __m128d v;

  static ISO_INLINE LaneMask from_bits(std::uint32_t bits) {
    const __m128i lane = _mm_set_epi32(2, 2, 1, 1);
    const __m128i chosen = _mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane);
    return {_mm_castsi128_pd(_mm_cmpeq_epi32(chosen, lane))};
  }
  friend ISO_INLINE std::uint32_t to_bits(LaneMask a) { return static_cast<std::uint32_t>(_mm_movemask_pd(a.v)); }
  friend ISO_INLINE bool any(LaneMask a) { return to_bits(a) != 0; }
  friend ISO_INLINE bool all(LaneMask a) { return to_bits(a) == 0x3u; }
  friend ISO_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {_mm_and_pd(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {_mm_or_pd(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator~(LaneMask a) { return {_mm_xor_pd(a.v, _mm_castsi128_pd(_mm_set1_epi32(-1)))}; }
};

template <> struct Lanes<double, 2, isa::Sse2> {
  using Scalar = double;
  using Mask = LaneMask<double, 2, isa::Sse2>;
  static constexpr int kWidth = 2;
  __m128d v;

  static ISO_INLINE Lanes load(const double* p) { return {_mm_load_pd(p)}; }
  ISO_INLINE void store(double* p) const { _mm_store_pd(p, v); }
  static ISO_INLINE Lanes broadcast(double a) { return {_mm_set1_pd(a)}; }
  static ISO_INLINE Lanes zero() { return {_mm_setzero_pd()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm_add_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return {_mm_xor_pd(a.v, _mm_set1_pd(-0.0))}; }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) { return {_mm_mul_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return {_mm_div_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {_mm_min_pd(b.v, a.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {_mm_max_pd(b.v, a.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) {
    const __m128d negative = _mm_cmplt_pd(a.v, _mm_setzero_pd());
    return {_mm_xor_pd(a.v, _mm_and_pd(negative, _mm_set1_pd(-0.0)))};
  }
  friend ISO_INLINE Lanes sqrt(Lanes a) { return {_mm_sqrt_pd(a.v)}; }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm_cmplt_pd(a.v, b.v)}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) { return {_mm_cmple_pd(a.v, b.v)}; }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm_cmpeq_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) {
    return {_mm_or_pd(_mm_and_pd(mask.v, a.v), _mm_andnot_pd(mask.v, b.v))};
  }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Lanes* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      const __m128d a = _mm_loadu_pd(rows[0] + n);
      const __m128d b = _mm_loadu_pd(rows[1] + n);
      out[n] = {_mm_unpacklo_pd(a, b)};
      out[n + 1] = {_mm_unpackhi_pd(a, b)};
    }
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    ISO_UNROLL for (int n = 0; n < N; n += 2) {
      if (lane_mask & 1u) _mm_storeu_pd(rows[0] + n, _mm_unpacklo_pd(in[n].v, in[n + 1].v));
      if (lane_mask & 2u) _mm_storeu_pd(rows[1] + n, _mm_unpackhi_pd(in[n].v, in[n + 1].v));
    }
  }
};

}  // namespace isostep
