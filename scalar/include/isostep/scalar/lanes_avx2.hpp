// Lanes in AVX2 registers: eight floats or 32-bit fixed point, four doubles or 64-bit fixed point.
// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__AVX2__)
#error "isostep: include lanes_avx2.hpp only in files compiled with -mavx2, and call those only where the CPU has it"
#endif

#include <immintrin.h>

#include "isostep/scalar/lanes_registers.hpp"

namespace isostep {

namespace isa {
struct Avx2 {};
}  // namespace isa

namespace detail {
/// Masks of W lanes, each lane all ones or all zeros.
template <int W> struct Avx2Masks {
  using Mask = __m256i;
  static constexpr int kWidth = W;

  static ISO_INLINE Mask mask_from_bits(std::uint32_t bits) {
    const __m256i lane = W == 8 ? _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1) : _mm256_set_epi64x(8, 4, 2, 1);
    const __m256i all_bits = W == 8 ? _mm256_set1_epi32(static_cast<int>(bits)) : _mm256_set1_epi64x(bits);
    const __m256i chosen = _mm256_and_si256(all_bits, lane);
    return W == 8 ? _mm256_cmpeq_epi32(chosen, lane) : _mm256_cmpeq_epi64(chosen, lane);
  }
  static ISO_INLINE std::uint32_t bits_of_mask(Mask a) {
    return static_cast<std::uint32_t>(W == 8 ? _mm256_movemask_ps(_mm256_castsi256_ps(a))
                                             : _mm256_movemask_pd(_mm256_castsi256_pd(a)));
  }
  static ISO_INLINE Mask mask_and(Mask a, Mask b) { return _mm256_and_si256(a, b); }
  static ISO_INLINE Mask mask_or(Mask a, Mask b) { return _mm256_or_si256(a, b); }
  static ISO_INLINE Mask mask_not(Mask a) { return _mm256_xor_si256(a, _mm256_set1_epi32(-1)); }
};

/// Transposes a 4 x 4 block of 32-bit lanes in each 128-bit half.
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
}  // namespace detail

template <> struct Registers<float, isa::Avx2> : detail::Avx2Masks<8> {
  using Type = __m256;

  static ISO_INLINE Type load(const float* p) { return _mm256_load_ps(p); }
  static ISO_INLINE void store(float* p, Type a) { _mm256_store_ps(p, a); }
  static ISO_INLINE Type broadcast(float a) { return _mm256_set1_ps(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm256_add_ps(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm256_sub_ps(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm256_mul_ps(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm256_div_ps(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm256_sqrt_ps(a); }
  static ISO_INLINE Type negate(Type a) { return _mm256_xor_ps(a, _mm256_set1_ps(-0.0f)); }
  // The instruction returns its second operand when neither is smaller: exactly b < a ? b : a and a < b ? b : a.
  static ISO_INLINE Type min(Type a, Type b) { return _mm256_min_ps(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm256_max_ps(b, a); }
  static ISO_INLINE Type abs(Type a) {  // flips the sign of what is below zero: -0.0 and NaN keep theirs
    const __m256 negative = _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_LT_OQ);
    return _mm256_xor_ps(a, _mm256_and_ps(negative, _mm256_set1_ps(-0.0f)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ)); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LE_OQ)); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_EQ_OQ)); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(m)); }

  // Row i shares a register with row i + 4, so that only loads and stores cross the halves.
  template <int N> static ISO_INLINE void load_rows(const float* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) {
        r[i] =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(rows[i] + n)), _mm_loadu_ps(rows[i + 4] + n), 1);
      }
      detail::transpose_halves(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(float* const* rows, const Type* in, std::uint32_t lane_mask) {
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) detail::transpose_halves(in + n, r + n);
    ISO_UNROLL for (int i = 0; i < 8; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) {
        const Type both = r[n + i % 4];
        _mm_storeu_ps(rows[i] + n, i < 4 ? _mm256_castps256_ps128(both) : _mm256_extractf128_ps(both, 1));
      }
    }
  }
};

template <> struct Registers<double, isa::Avx2> : detail::Avx2Masks<4> {
  using Type = __m256d;

  static ISO_INLINE Type load(const double* p) { return _mm256_load_pd(p); }
  static ISO_INLINE void store(double* p, Type a) { _mm256_store_pd(p, a); }
  static ISO_INLINE Type broadcast(double a) { return _mm256_set1_pd(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm256_add_pd(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm256_sub_pd(a, b); }
  static ISO_INLINE Type multiply(Type a, Type b) { return _mm256_mul_pd(a, b); }
  static ISO_INLINE Type divide(Type a, Type b) { return _mm256_div_pd(a, b); }
  static ISO_INLINE Type sqrt(Type a) { return _mm256_sqrt_pd(a); }
  static ISO_INLINE Type negate(Type a) { return _mm256_xor_pd(a, _mm256_set1_pd(-0.0)); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm256_min_pd(b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm256_max_pd(b, a); }
  static ISO_INLINE Type abs(Type a) {
    const __m256d negative = _mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_LT_OQ);
    return _mm256_xor_pd(a, _mm256_and_pd(negative, _mm256_set1_pd(-0.0)));
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LT_OQ)); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LE_OQ)); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm256_blendv_pd(b, a, _mm256_castsi256_pd(m)); }

  template <int N> static ISO_INLINE void load_rows(const double* const* rows, Type* out) {
    ISO_UNROLL for (int n = 0; n < N; n += 4) {
      Type r[4];
      ISO_UNROLL for (int i = 0; i < 4; ++i) r[i] = _mm256_loadu_pd(rows[i] + n);
      detail::transpose_4x4(r, out + n);
    }
  }
  template <int N> static ISO_INLINE void store_rows(double* const* rows, const Type* in, std::uint32_t lane_mask) {
    Type r[N];
    ISO_UNROLL for (int n = 0; n < N; n += 4) detail::transpose_4x4(in + n, r + n);
    ISO_UNROLL for (int i = 0; i < 4; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; n += 4) _mm256_storeu_pd(rows[i] + n, r[n + i]);
    }
  }
};

template <> struct Registers<std::int32_t, isa::Avx2> : detail::Avx2Masks<8> {
  using Type = __m256i;

  static ISO_INLINE Type load(const std::int32_t* p) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(p)); }
  static ISO_INLINE void store(std::int32_t* p, Type a) { _mm256_store_si256(reinterpret_cast<__m256i*>(p), a); }
  static ISO_INLINE Type broadcast(std::int32_t a) { return _mm256_set1_epi32(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm256_add_epi32(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm256_sub_epi32(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return _mm256_min_epi32(a, b); }
  static ISO_INLINE Type max(Type a, Type b) { return _mm256_max_epi32(a, b); }
  static ISO_INLINE Type abs(Type a) { return _mm256_abs_epi32(a); }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm256_cmpgt_epi32(b, a); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return mask_not(less(b, a)); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm256_cmpeq_epi32(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm256_blendv_epi8(b, a, m); }

  /// 64-bit products of the even lanes.
  static ISO_INLINE __m256i multiply_even(Type a, Type b) { return _mm256_mul_epi32(a, b); }
  static ISO_INLINE Type odd_to_even(Type a) { return _mm256_shuffle_epi32(a, 0xf5); }
  static ISO_INLINE Type even_and_odd(Type even, Type odd) { return _mm256_blend_epi32(even, odd, 0xaa); }
  template <int N> static ISO_INLINE Type shift_right(Type a) { return _mm256_srai_epi32(a, N); }
};

template <> struct Registers<std::int64_t, isa::Avx2> : detail::Avx2Masks<4> {
  using Type = __m256i;
  using NearSum = detail::FlippedSum<Registers>;  // no product of 64 bits

  static ISO_INLINE Type load(const std::int64_t* p) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(p)); }
  static ISO_INLINE void store(std::int64_t* p, Type a) { _mm256_store_si256(reinterpret_cast<__m256i*>(p), a); }
  static ISO_INLINE Type broadcast(std::int64_t a) { return _mm256_set1_epi64x(a); }
  static ISO_INLINE Type add(Type a, Type b) { return _mm256_add_epi64(a, b); }
  static ISO_INLINE Type subtract(Type a, Type b) { return _mm256_sub_epi64(a, b); }
  static ISO_INLINE Type min(Type a, Type b) { return select(less(b, a), b, a); }
  static ISO_INLINE Type max(Type a, Type b) { return select(less(a, b), b, a); }
  static ISO_INLINE Type abs(Type a) {
    const __m256i negative = _mm256_cmpgt_epi64(_mm256_setzero_si256(), a);
    return _mm256_sub_epi64(_mm256_xor_si256(a, negative), negative);
  }
  static ISO_INLINE Mask less(Type a, Type b) { return _mm256_cmpgt_epi64(b, a); }
  static ISO_INLINE Mask less_equal(Type a, Type b) { return mask_not(less(b, a)); }
  static ISO_INLINE Mask equal(Type a, Type b) { return _mm256_cmpeq_epi64(a, b); }
  static ISO_INLINE Type select(Mask m, Type a, Type b) { return _mm256_blendv_epi8(b, a, m); }

  static ISO_INLINE Type multiply_low_words(Type a, Type b) { return _mm256_mul_epu32(a, b); }
  static ISO_INLINE Type multiply_low(Type a, Type b) {
    const __m256i cross =
        _mm256_add_epi64(_mm256_mul_epu32(_mm256_srli_epi64(a, 32), b), _mm256_mul_epu32(a, _mm256_srli_epi64(b, 32)));
    return _mm256_add_epi64(_mm256_mul_epu32(a, b), _mm256_slli_epi64(cross, 32));
  }
  /// Returns an integer next to n / a, for a and it in [0, 2^52), by doubles whose mantissa is 2^52 plus the number.
  static ISO_INLINE Type quotient_near(double n, Type a) {
    const __m256d shift = _mm256_set1_pd(0x1p52);
    const __m256d divisor = _mm256_sub_pd(_mm256_castsi256_pd(_mm256_or_si256(a, _mm256_castpd_si256(shift))), shift);
    const __m256d quotient = _mm256_add_pd(_mm256_div_pd(_mm256_set1_pd(n), divisor), shift);
    return _mm256_xor_si256(_mm256_castpd_si256(quotient), _mm256_castpd_si256(shift));
  }
  static ISO_INLINE Type low_word(Type a) { return _mm256_and_si256(a, _mm256_set1_epi64x(0xffffffff)); }
  static ISO_INLINE Type flip(Type a, std::uint64_t bits) {
    return _mm256_xor_si256(a, _mm256_set1_epi64x(static_cast<std::int64_t>(bits)));
  }
  /// Returns b where a is negative, else zero.
  static ISO_INLINE Type where_negative(Type a, Type b) {
    return _mm256_and_si256(_mm256_cmpgt_epi64(_mm256_setzero_si256(), a), b);
  }
  template <int N> static ISO_INLINE Type shift_left(Type a) { return _mm256_slli_epi64(a, N); }
  template <int N> static ISO_INLINE Type shift_in_zeros(Type a) { return _mm256_srli_epi64(a, N); }
  /// (x + half) >> N with the sign, N in 1..63: AVX2 has no such shift of 64 bits. Adding 2^63 turns the signed order
  /// into the unsigned one, and comes out of the shift as 2^(63 - N).
  template <int N> static ISO_INLINE Type shift_right(Type x, std::uint64_t half) {
    const auto bias = static_cast<std::int64_t>(half + (std::uint64_t{1} << 63));
    const __m256i shifted = _mm256_srli_epi64(_mm256_add_epi64(x, _mm256_set1_epi64x(bias)), N);
    return _mm256_sub_epi64(shifted, _mm256_set1_epi64x(static_cast<std::int64_t>(std::uint64_t{1} << (63 - N))));
  }
};

}  // namespace isostep
