// Lanes in AVX2 registers: eight floats or 32-bit fixed point, four doubles or 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__AVX2__)
#error "isostep: include lanes_avx2.hpp only in files compiled with -mavx2, and call those only where the CPU has it"
#endif

#include <immintrin.h>

#include "isostep/scalar/lanes.hpp"

namespace isostep {

namespace isa {
struct Avx2 {};
}  // namespace isa

namespace detail {
/// 4 x 4 doubles, or anything of 64 bits.
ISO_INLINE void transpose_4x4(const __m256d* in, __m256d* out) {
  const __m256d a = _mm256_unpacklo_pd(in[0], in[1]);
  const __m256d b = _mm256_unpackhi_pd(in[0], in[1]);
  const __m256d c = _mm256_unpacklo_pd(in[2], in[3]);
  const __m256d d = _mm256_unpackhi_pd(in[2], in[3]);
  out[0] = _mm256_permute2f128_pd(a, c, 0x20);
  out[1] = _mm256_permute2f128_pd(b, d, 0x20);
  out[2] = _mm256_permute2f128_pd(a, c, 0x31);
  out[3] = _mm256_permute2f128_pd(b, d, 0x31);
}
/// In each 128-bit half a transposed 4 x 4 block of 32-bit lanes.
ISO_INLINE void transpose_halves(const __m256* in, __m256* out) {
  const __m256 a = _mm256_unpacklo_ps(in[0], in[1]);
  const __m256 b = _mm256_unpackhi_ps(in[0], in[1]);
  const __m256 c = _mm256_unpacklo_ps(in[2], in[3]);
  const __m256 d = _mm256_unpackhi_ps(in[2], in[3]);
  out[0] = _mm256_shuffle_ps(a, c, 0x44);
  out[1] = _mm256_shuffle_ps(a, c, 0xee);
  out[2] = _mm256_shuffle_ps(b, d, 0x44);
  out[3] = _mm256_shuffle_ps(b, d, 0xee);
}
/// Eight rows of N 32-bit scalars to N registers. Row i shares a register with row i + 4, so that only loads and
/// stores cross the halves.
template <int N> ISO_INLINE void load_rows_32(const float* const* rows, __m256* out) {
  ISO_UNROLL for (int n = 0; n < N; n += 4) {
    __m256 r[4];
    ISO_UNROLL for (int i = 0; i < 4; ++i) {
      r[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(rows[i] + n)), _mm_loadu_ps(rows[i + 4] + n), 1);
    }
    transpose_halves(r, out + n);
  }
}
template <int N> ISO_INLINE void store_rows_32(float* const* rows, const __m256* in, std::uint32_t lane_mask) {
  __m256 r[N];
  ISO_UNROLL for (int n = 0; n < N; n += 4) transpose_halves(in + n, r + n);
  ISO_UNROLL for (int i = 0; i < 8; ++i) {
    if (((lane_mask >> i) & 1u) == 0) continue;
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      const __m256 both = r[n + i % 4];
      _mm_storeu_ps(rows[i] + n, i < 4 ? _mm256_castps256_ps128(both) : _mm256_extractf128_ps(both, 1));
    }
  }
}
template <int N> ISO_INLINE void load_rows_64(const double* const* rows, __m256d* out) {
  ISO_UNROLL for (int n = 0; n < N; n += 4) {
    __m256d r[4];
    ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = _mm256_loadu_pd(rows[i] + n);
    transpose_4x4(r, out + n);
  }
}
template <int N> ISO_INLINE void store_rows_64(double* const* rows, const __m256d* in, std::uint32_t lane_mask) {
  __m256d r[N];
  ISO_UNROLL for (int n = 0; n < N; n += 4) transpose_4x4(in + n, r + n);
  ISO_UNROLL for (int i = 0; i < 4; ++i) {
    if (((lane_mask >> i) & 1u) == 0) continue;
    ISO_UNROLL for (int n = 0; n < N; n += 4) _mm256_storeu_pd(rows[i] + n, r[n + i]);
  }
}
}  // namespace detail

/// All ones or all zeros in each lane of 32 or 64 bits.
template <class Key, int W>
requires(sizeof(Key) * W == 32) struct LaneMask<Key, W, isa::Avx2> {
  __m256i v;

  static ISO_INLINE LaneMask from_bits(std::uint32_t bits) {
    const __m256i lane = W == 8 ? _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1) : _mm256_set_epi64x(8, 4, 2, 1);
    const __m256i all_bits = W == 8 ? _mm256_set1_epi32(static_cast<int>(bits)) : _mm256_set1_epi64x(bits);
    const __m256i chosen = _mm256_and_si256(all_bits, lane);
    return {W == 8 ? _mm256_cmpeq_epi32(chosen, lane) : _mm256_cmpeq_epi64(chosen, lane)};
  }
  friend ISO_INLINE std::uint32_t to_bits(LaneMask a) {
    return static_cast<std::uint32_t>(W == 8 ? _mm256_movemask_ps(_mm256_castsi256_ps(a.v))
                                             : _mm256_movemask_pd(_mm256_castsi256_pd(a.v)));
  }
  friend ISO_INLINE bool any(LaneMask a) { return to_bits(a) != 0; }
  friend ISO_INLINE bool all(LaneMask a) { return to_bits(a) == (1u << W) - 1; }
  friend ISO_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {_mm256_and_si256(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {_mm256_or_si256(a.v, b.v)}; }
  friend ISO_INLINE LaneMask operator~(LaneMask a) { return {_mm256_xor_si256(a.v, _mm256_set1_epi32(-1))}; }
};

template <> struct Lanes<float, 8, isa::Avx2> {
  using Scalar = float;
  using Mask = LaneMask<float, 8, isa::Avx2>;
  static constexpr int kWidth = 8;
  __m256 v;

  static ISO_INLINE Lanes load(const float* p) { return {_mm256_load_ps(p)}; }
  ISO_INLINE void store(float* p) const { _mm256_store_ps(p, v); }
  static ISO_INLINE Lanes broadcast(float a) { return {_mm256_set1_ps(a)}; }
  static ISO_INLINE Lanes zero() { return {_mm256_setzero_ps()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return {_mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f))}; }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_ps(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return {_mm256_div_ps(a.v, b.v)}; }
  // The instruction answers its second operand when neither is smaller: exactly b < a ? b : a and a < b ? b : a.
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {_mm256_min_ps(b.v, a.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {_mm256_max_ps(b.v, a.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    const __m256 negative = _mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_LT_OQ);
    return {_mm256_xor_ps(a.v, _mm256_and_ps(negative, _mm256_set1_ps(-0.0f)))};
  }
  friend ISO_INLINE Lanes sqrt(Lanes a) { return {_mm256_sqrt_ps(a.v)}; }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ))}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) {
    return {_mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ))};
  }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm256_castps_si256(_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ))}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) {
    return {_mm256_blendv_ps(b.v, a.v, _mm256_castsi256_ps(mask.v))};
  }

  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Lanes* out) {
    __m256 r[N];
    detail::load_rows_32<N>(rows, r);
    ISO_UNROLL for (int n = 0; n < N; ++n) out[n].v = r[n];
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    __m256 r[N];
    ISO_UNROLL for (int n = 0; n < N; ++n) r[n] = in[n].v;
    detail::store_rows_32<N>(rows, r, lane_mask);
  }
};

template <> struct Lanes<double, 4, isa::Avx2> {
  using Scalar = double;
  using Mask = LaneMask<double, 4, isa::Avx2>;
  static constexpr int kWidth = 4;
  __m256d v;

  static ISO_INLINE Lanes load(const double* p) { return {_mm256_load_pd(p)}; }
  ISO_INLINE void store(double* p) const { _mm256_store_pd(p, v); }
  static ISO_INLINE Lanes broadcast(double a) { return {_mm256_set1_pd(a)}; }
  static ISO_INLINE Lanes zero() { return {_mm256_setzero_pd()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return {_mm256_xor_pd(a.v, _mm256_set1_pd(-0.0))}; }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return {_mm256_div_pd(a.v, b.v)}; }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {_mm256_min_pd(b.v, a.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {_mm256_max_pd(b.v, a.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) {
    const __m256d negative = _mm256_cmp_pd(a.v, _mm256_setzero_pd(), _CMP_LT_OQ);
    return {_mm256_xor_pd(a.v, _mm256_and_pd(negative, _mm256_set1_pd(-0.0)))};
  }
  friend ISO_INLINE Lanes sqrt(Lanes a) { return {_mm256_sqrt_pd(a.v)}; }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm256_castpd_si256(_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ))}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) {
    return {_mm256_castpd_si256(_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ))};
  }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm256_castpd_si256(_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ))}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) {
    return {_mm256_blendv_pd(b.v, a.v, _mm256_castsi256_pd(mask.v))};
  }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Lanes* out) {
    __m256d r[N];
    detail::load_rows_64<N>(rows, r);
    ISO_UNROLL for (int n = 0; n < N; ++n) out[n].v = r[n];
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    __m256d r[N];
    ISO_UNROLL for (int n = 0; n < N; ++n) r[n] = in[n].v;
    detail::store_rows_64<N>(rows, r, lane_mask);
  }
};

}  // namespace isostep

#include "isostep/scalar/lanes_avx2_fixed.hpp"
