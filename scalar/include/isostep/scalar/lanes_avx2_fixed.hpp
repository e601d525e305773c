// Fixed point in AVX2 registers: exact sums of products, one rounding, wrap like the scalar. Part of lanes_avx2.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes_avx2.hpp"

namespace isostep {

/// Eight 32-bit numbers. The trapping policy keeps the plain version.
template <int F> struct Lanes<Fixed<std::int32_t, F>, 8, isa::Avx2> {
  using Scalar = Fixed<std::int32_t, F>;
  using Mask = LaneMask<std::int32_t, 8, isa::Avx2>;
  static constexpr int kWidth = 8;
  __m256i v;

  static ISO_INLINE Lanes load(const Scalar* p) { return {_mm256_load_si256(reinterpret_cast<const __m256i*>(p))}; }
  ISO_INLINE void store(Scalar* p) const { _mm256_store_si256(reinterpret_cast<__m256i*>(p), v); }
  static ISO_INLINE Lanes broadcast(Scalar a) { return {_mm256_set1_epi32(a.raw())}; }
  static ISO_INLINE Lanes zero() { return {_mm256_setzero_si256()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_epi32(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_epi32(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return zero() - a; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return divide_to<Lanes>(a, b); }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return {_mm256_min_epi32(a.v, b.v)}; }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return {_mm256_max_epi32(a.v, b.v)}; }
  friend ISO_INLINE Lanes abs(Lanes a) { return {_mm256_abs_epi32(a.v)}; }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm256_cmpgt_epi32(b.v, a.v)}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) { return ~less(b, a); }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm256_cmpeq_epi32(a.v, b.v)}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) { return {_mm256_blendv_epi8(b.v, a.v, mask.v)}; }

  template <int N> static ISO_INLINE void load_rows(const Scalar* const* rows, Lanes* out) {
    const float* p[8];
    __m256 r[N];
    ISO_UNROLL for (int i = 0; i < 8; ++i) p[i] = reinterpret_cast<const float*>(rows[i]);
    detail::load_rows_32<N>(p, r);
    ISO_UNROLL for (int n = 0; n < N; ++n) out[n].v = _mm256_castps_si256(r[n]);
  }
  template <int N> static ISO_INLINE void store_rows(Scalar* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    float* p[8];
    __m256 r[N];
    ISO_UNROLL for (int i = 0; i < 8; ++i) p[i] = reinterpret_cast<float*>(rows[i]);
    ISO_UNROLL for (int n = 0; n < N; ++n) r[n] = _mm256_castsi256_ps(in[n].v);
    detail::store_rows_32<N>(p, r, lane_mask);
  }
};

/// Eight exact sums as 64-bit integers, of the even and of the odd lanes.
template <int F> struct LaneSum<FixedSum<std::int32_t, F>, 8, isa::Avx2> {
  __m256i even;
  __m256i odd;

  static ISO_INLINE LaneSum zero() { return {_mm256_setzero_si256(), _mm256_setzero_si256()}; }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, 8, isa::Avx2> a, Lanes<B, 8, isa::Avx2> b) {
    return {_mm256_mul_epi32(a.v, b.v),
            _mm256_mul_epi32(_mm256_shuffle_epi32(a.v, 0xf5), _mm256_shuffle_epi32(b.v, 0xf5))};
  }
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, 8, isa::Avx2> a) {
    constexpr int shift = F - A::kFracBits;
    const __m256i one = _mm256_set1_epi32(1);
    return {_mm256_slli_epi64(_mm256_mul_epi32(a.v, one), shift),
            _mm256_slli_epi64(_mm256_mul_epi32(_mm256_shuffle_epi32(a.v, 0xf5), one), shift)};
  }
  /// Of every 64-bit sum the 32 bits from bit `shift` on, in the even lanes moved down and in the odd ones up. A shift
  /// beyond 32 must bring in the sign: it shifts the upper words alone.
  template <class Out> ISO_INLINE Lanes<Out, 8, isa::Avx2> round() const {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift <= 0) {
      return {_mm256_blend_epi32(_mm256_slli_epi64(even, -shift), _mm256_slli_epi64(odd, 32 - shift), 0xaa)};
    } else {
      const __m256i half = _mm256_set1_epi64x(std::int64_t{1} << (shift - 1));
      const __m256i e = _mm256_add_epi64(even, half);
      const __m256i o = _mm256_add_epi64(odd, half);
      if constexpr (shift <= 32) {
        return {_mm256_blend_epi32(_mm256_srli_epi64(e, shift), _mm256_slli_epi64(o, 32 - shift), 0xaa)};
      } else {
        const __m256i upper = _mm256_blend_epi32(_mm256_srli_epi64(e, 32), o, 0xaa);
        return {_mm256_srai_epi32(upper, shift - 32)};
      }
    }
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    return {_mm256_add_epi64(a.even, b.even), _mm256_add_epi64(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    return {_mm256_sub_epi64(a.even, b.even), _mm256_sub_epi64(a.odd, b.odd)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

/// Four 64-bit numbers. The trapping policy keeps the plain version.
template <int F> struct Lanes<Fixed<std::int64_t, F>, 4, isa::Avx2> {
  using Scalar = Fixed<std::int64_t, F>;
  using Mask = LaneMask<std::int64_t, 4, isa::Avx2>;
  static constexpr int kWidth = 4;
  __m256i v;

  static ISO_INLINE Lanes load(const Scalar* p) { return {_mm256_load_si256(reinterpret_cast<const __m256i*>(p))}; }
  ISO_INLINE void store(Scalar* p) const { _mm256_store_si256(reinterpret_cast<__m256i*>(p), v); }
  static ISO_INLINE Lanes broadcast(Scalar a) { return {_mm256_set1_epi64x(a.raw())}; }
  static ISO_INLINE Lanes zero() { return {_mm256_setzero_si256()}; }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_epi64(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_epi64(a.v, b.v)}; }
  friend ISO_INLINE Lanes operator-(Lanes a) { return zero() - a; }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) { return divide_to<Lanes>(a, b); }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) { return select(less(b, a), b, a); }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) { return select(less(a, b), b, a); }
  friend ISO_INLINE Lanes abs(Lanes a) {
    const __m256i negative = _mm256_cmpgt_epi64(_mm256_setzero_si256(), a.v);
    return {_mm256_sub_epi64(_mm256_xor_si256(a.v, negative), negative)};
  }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) { return {_mm256_cmpgt_epi64(b.v, a.v)}; }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) { return ~less(b, a); }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) { return {_mm256_cmpeq_epi64(a.v, b.v)}; }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) { return {_mm256_blendv_epi8(b.v, a.v, mask.v)}; }

  template <int N> static ISO_INLINE void load_rows(const Scalar* const* rows, Lanes* out) {
    const double* p[4];
    __m256d r[N];
    ISO_UNROLL for (int i = 0; i < 4; ++i) p[i] = reinterpret_cast<const double*>(rows[i]);
    detail::load_rows_64<N>(p, r);
    ISO_UNROLL for (int n = 0; n < N; ++n) out[n].v = _mm256_castpd_si256(r[n]);
  }
  template <int N> static ISO_INLINE void store_rows(Scalar* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    double* p[4];
    __m256d r[N];
    ISO_UNROLL for (int i = 0; i < 4; ++i) p[i] = reinterpret_cast<double*>(rows[i]);
    ISO_UNROLL for (int n = 0; n < N; ++n) r[n] = _mm256_castsi256_pd(in[n].v);
    detail::store_rows_64<N>(p, r, lane_mask);
  }
};

namespace detail {
/// (x + half) >> n with the sign, n in 1..63: AVX2 has no arithmetic shift of 64 bits. Adding 2^63 turns the signed
/// order into the unsigned one, and comes out of the shift as 2^(63 - n).
template <int N> ISO_INLINE __m256i shift_right_64(__m256i x, std::uint64_t half) {
  const auto bias = static_cast<std::int64_t>(half + (std::uint64_t{1} << 63));
  const __m256i shifted = _mm256_srli_epi64(_mm256_add_epi64(x, _mm256_set1_epi64x(bias)), N);
  return _mm256_sub_epi64(shifted, _mm256_set1_epi64x(static_cast<std::int64_t>(std::uint64_t{1} << (63 - N))));
}
}  // namespace detail

/// Four exact sums X modulo 2^128, in columns that carry only once, when they are rounded:
///   X = c2 2^64 + c1 2^32 + c0   modulo 2^128, while fewer than 2^29 products are added
///   X = middle 2^32 + c0         modulo 2^96
/// A rounding by up to 32 bits reads the second line, by more the first; what is not read the compiler removes.
/// With a = ah 2^32 + al read as unsigned, a b = ah bh 2^64 + (ah bl + al bh) 2^32 + al bl, less b 2^64 where a is
/// negative and a 2^64 where b is.
template <int F> struct LaneSum<FixedSum<std::int64_t, F>, 4, isa::Avx2> {
  __m256i c0;
  __m256i c1;
  __m256i c2;
  __m256i middle;

  static ISO_INLINE LaneSum zero() {
    const __m256i z = _mm256_setzero_si256();
    return {z, z, z, z};
  }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, 4, isa::Avx2> a, Lanes<B, 4, isa::Avx2> b) {
    const __m256i word = _mm256_set1_epi64x(0xffffffff);
    const __m256i none = _mm256_setzero_si256();
    const __m256i ah = _mm256_srli_epi64(a.v, 32);
    const __m256i bh = _mm256_srli_epi64(b.v, 32);
    const __m256i ll = _mm256_mul_epu32(a.v, b.v);
    const __m256i lh = _mm256_mul_epu32(a.v, bh);
    const __m256i hl = _mm256_mul_epu32(ah, b.v);
    const __m256i carry = _mm256_srli_epi64(ll, 32);
    const __m256i signs = _mm256_add_epi64(_mm256_and_si256(_mm256_cmpgt_epi64(none, a.v), b.v),
                                           _mm256_and_si256(_mm256_cmpgt_epi64(none, b.v), a.v));
    const __m256i hh = _mm256_sub_epi64(_mm256_mul_epu32(ah, bh), signs);
    const __m256i cross = _mm256_add_epi64(_mm256_and_si256(lh, word), _mm256_and_si256(hl, word));
    const __m256i cross_high = _mm256_add_epi64(_mm256_srli_epi64(lh, 32), _mm256_srli_epi64(hl, 32));
    return {_mm256_and_si256(ll, word), _mm256_add_epi64(carry, cross), _mm256_add_epi64(hh, cross_high),
            _mm256_add_epi64(_mm256_add_epi64(carry, lh), _mm256_add_epi64(hl, _mm256_slli_epi64(hh, 32)))};
  }
  /// x 2^shift: the 128-bit value in two words first, then in columns.
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, 4, isa::Avx2> a) {
    constexpr int shift = F - A::kFracBits;
    static_assert(shift > 0);
    __m256i high;
    if constexpr (shift < 64) high = detail::shift_right_64<64 - shift>(a.v, 0);
    if constexpr (shift >= 64) high = _mm256_slli_epi64(a.v, shift - 64);
    const __m256i low = _mm256_slli_epi64(a.v, shift);  // zero from 64 on
    const __m256i c1 = _mm256_srli_epi64(low, 32);
    return {_mm256_and_si256(low, _mm256_set1_epi64x(0xffffffff)), c1, high,
            _mm256_add_epi64(c1, _mm256_slli_epi64(high, 32))};
  }
  /// The 64 bits from bit `shift` on of X + 2^(shift - 1). The column that holds the rounding bit is shifted with its
  /// sign, for differences leave negative columns; the columns above are multiples of 2^shift and only move.
  template <class Out> ISO_INLINE Lanes<Out, 4, isa::Avx2> round() const {
    constexpr int shift = F - Out::kFracBits;
    if constexpr (shift <= 0) {
      return {_mm256_add_epi64(_mm256_slli_epi64(middle, 32 - shift), _mm256_slli_epi64(c0, -shift))};
    } else {
      constexpr std::uint64_t half = std::uint64_t{1} << ((shift - 1) % 32);
      if constexpr (shift <= 32) {
        return {_mm256_add_epi64(_mm256_slli_epi64(middle, 32 - shift), detail::shift_right_64<shift>(c0, half))};
      } else {
        const __m256i carried = _mm256_add_epi64(c1, detail::shift_right_64<32>(c0, 0));
        if constexpr (shift <= 64) {
          return {
              _mm256_add_epi64(_mm256_slli_epi64(c2, 64 - shift), detail::shift_right_64<shift - 32>(carried, half))};
        } else {
          const __m256i top = _mm256_add_epi64(c2, detail::shift_right_64<32>(carried, 0));
          return {detail::shift_right_64<shift - 64>(top, std::uint64_t{1} << (shift - 65))};
        }
      }
    }
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    return {_mm256_add_epi64(a.c0, b.c0), _mm256_add_epi64(a.c1, b.c1), _mm256_add_epi64(a.c2, b.c2),
            _mm256_add_epi64(a.middle, b.middle)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    return {_mm256_sub_epi64(a.c0, b.c0), _mm256_sub_epi64(a.c1, b.c1), _mm256_sub_epi64(a.c2, b.c2),
            _mm256_sub_epi64(a.middle, b.middle)};
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

}  // namespace isostep
