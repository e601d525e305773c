// Lanes<S, W, Isa>: W scalars side by side, lane by lane the very bits of the scalar operation; here the plain version.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "isostep/scalar/scalar.hpp"

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#endif

// gcc keeps arrays in memory until the loops over them are gone; clang unrolls them unasked.
#if defined(__GNUC__) && !defined(__clang__)
#define ISO_UNROLL _Pragma("GCC unroll 32")
#else
#define ISO_UNROLL
#endif

namespace isostep {

/// Instruction sets. An empty tag in every name keeps code of different sets apart for the linker. A tag is complete
/// only where its own header (lanes_sse2.hpp, lanes_avx2.hpp, lanes_avx512.hpp, lanes_neon.hpp, lanes_wasm.hpp) is
/// included: no file can mix the versions up.
namespace isa {
struct Portable {};
struct Sse2;
struct Avx2;
struct Avx512;
struct Neon;
struct WasmSimd;
}  // namespace isa

namespace detail {
/// The type by which registers and masks know a scalar. Formats of one width share their masks: compare Unit<S>, select
/// S. Wrapping fixed point is known as its Rep, because registers wrap too.
template <class S> struct LaneKeyOf { using Type = S; };
template <class Rep, int F, Overflow P> struct LaneKeyOf<Fixed<Rep, F, P>> {
  using Type = std::conditional_t<P == Overflow::wrap, Rep, Fixed<Rep, 1, P>>;
};
template <class S> using LaneKey = typename LaneKeyOf<S>::Type;

/// One result of a comparison in memory. clang 14 for WebAssembly passes a struct of one bool as one bit, and folds
/// constants so that a true one reads 255.
#if defined(__wasm__)
using LaneAnswer = std::uint8_t;
#else
using LaneAnswer = bool;
#endif

/// The largest power of two that divides the size of W scalars, at most a 64-byte register.
constexpr std::size_t lane_alignment(std::size_t bytes) {
  std::size_t alignment = 64;
  while (bytes % alignment != 0) alignment /= 2;
  return alignment;
}

/// Computes the IEEE root by the processor's instruction: a library call could set errno, and is not ours.
template <class S> ISO_INLINE S sqrt_lane(S a) {
#if defined(__SSE2__) || defined(_M_X64)
  if constexpr (sizeof(S) == 4) return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(a)));
  if constexpr (sizeof(S) == 8) return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(a)));
#else
  if constexpr (sizeof(S) == 4) return __builtin_sqrtf(a);
  if constexpr (sizeof(S) == 8) return __builtin_sqrt(a);
#endif
}
}  // namespace detail

/// [bytes] The alignment that load and store expect of their W scalars.
template <class S, int W> inline constexpr std::size_t kLaneAlignment = detail::lane_alignment(W * sizeof(S));

/// W results of a comparison. Key is detail::LaneKey of the scalar.
template <class Key, int W, class Isa> struct LaneMask {
  static_assert(W >= 1 && W <= 32, "the bits of a mask fit 32");
  detail::LaneAnswer v[std::size_t{W}];

  static ISO_INLINE LaneMask from_bits(std::uint32_t bits) {
    LaneMask r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = ((bits >> i) & 1u) != 0;
    return r;
  }
  /// Lane i is bit i.
  friend ISO_INLINE std::uint32_t to_bits(LaneMask a) {
    std::uint32_t bits = 0;
    ISO_UNROLL for (int i = 0; i < W; ++i) bits |= (a.v[i] ? 1u : 0u) << i;
    return bits;
  }
  friend ISO_INLINE bool any(LaneMask a) { return to_bits(a) != 0; }
  friend ISO_INLINE bool all(LaneMask a) { return to_bits(a) == (0xffffffffu >> (32 - W)); }
  friend ISO_INLINE LaneMask operator&(LaneMask a, LaneMask b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] && b.v[i];
    return a;
  }
  friend ISO_INLINE LaneMask operator|(LaneMask a, LaneMask b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] || b.v[i];
    return a;
  }
  friend ISO_INLINE LaneMask operator~(LaneMask a) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = !a.v[i];
    return a;
  }
};

/// W scalars. This general version serves any scalar and any W, also under a tag that has nothing better for them;
/// W = 1 is the reference of every other. `min`, `max` and `abs` are the comparisons of scalar.hpp (whose `clamp`
/// serves lanes too), so signed zeros and NaN go the same way.
template <class S, int W, class Isa> struct Lanes {
  static_assert(W >= 1 && W <= 32);
  static_assert(sizeof(Isa) > 0, "include the lanes header of this instruction set");
  using Scalar = S;
  using Mask = LaneMask<detail::LaneKey<S>, W, Isa>;
  static constexpr int kWidth = W;
  S v[std::size_t{W}];

  static ISO_INLINE Lanes load(const S* p) {
    Lanes r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = p[i];
    return r;
  }
  ISO_INLINE void store(S* p) const { ISO_UNROLL for (int i = 0; i < W; ++i) p[i] = v[i]; }
  static ISO_INLINE Lanes broadcast(S a) {
    Lanes r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = a;
    return r;
  }
  static ISO_INLINE Lanes zero() { return broadcast(S(0)); }

  friend ISO_INLINE Lanes operator+(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] + b.v[i];
    return a;
  }
  friend ISO_INLINE Lanes operator-(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] - b.v[i];
    return a;
  }
  friend ISO_INLINE Lanes operator-(Lanes a) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = -a.v[i];
    return a;
  }
  friend ISO_INLINE Lanes operator*(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] * b.v[i];
    return a;
  }
  friend ISO_INLINE Lanes operator/(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] / b.v[i];
    return a;
  }
  friend ISO_INLINE Lanes min(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = isostep::min(a.v[i], b.v[i]);
    return a;
  }
  friend ISO_INLINE Lanes max(Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = isostep::max(a.v[i], b.v[i]);
    return a;
  }
  friend ISO_INLINE Lanes abs(Lanes a) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] < S(0) ? -a.v[i] : a.v[i];
    return a;
  }
  friend ISO_INLINE Lanes sqrt(Lanes a) {
    static_assert(!kIsFixed<S>, "roots of fixed point are taken one by one");
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = detail::sqrt_lane(a.v[i]);
    return a;
  }

  friend ISO_INLINE Mask less(Lanes a, Lanes b) {
    Mask r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = a.v[i] < b.v[i];
    return r;
  }
  friend ISO_INLINE Mask less_equal(Lanes a, Lanes b) {
    Mask r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = a.v[i] <= b.v[i];
    return r;
  }
  friend ISO_INLINE Mask equal(Lanes a, Lanes b) {
    Mask r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = a.v[i] == b.v[i];
    return r;
  }
  friend ISO_INLINE Lanes select(Mask mask, Lanes a, Lanes b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = mask.v[i] ? a.v[i] : b.v[i];
    return a;
  }

  template <int N> static ISO_INLINE void load_rows(const S* const* rows, Lanes* out) {
    ISO_UNROLL for (int n = 0; n < N; ++n) { ISO_UNROLL for (int i = 0; i < W; ++i) out[n].v[i] = rows[i][n]; }
  }
  template <int N> static ISO_INLINE void store_rows(S* const* rows, const Lanes* in, std::uint32_t lane_mask) {
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      if (((lane_mask >> i) & 1u) == 0) continue;
      ISO_UNROLL for (int n = 0; n < N; ++n) rows[i][n] = in[n].v[i];
    }
  }
};

/// W exact sums of products of fixed-point lanes; SumS is the scalar's FixedSum. (Sums of float lanes are lanes.)
template <class SumS, int W, class Isa> struct LaneSum {
  static_assert(sizeof(Isa) > 0, "include the lanes header of this instruction set");
  SumS v[std::size_t{W}];

  static ISO_INLINE LaneSum zero() {
    LaneSum r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = SumS::zero();
    return r;
  }
  template <class A, class B> static ISO_INLINE LaneSum of_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    alignas(kLaneAlignment<A, W>) A x[std::size_t{W}];
    alignas(kLaneAlignment<B, W>) B y[std::size_t{W}];
    a.store(x);
    b.store(y);
    LaneSum r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = product(x[i], y[i]);
    return r;
  }
  template <class A> static ISO_INLINE LaneSum of_lanes(Lanes<A, W, Isa> a) {
    LaneSum r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = widen<SumS>(a.v[i]);
    return r;
  }
  template <class Out> ISO_INLINE Lanes<Out, W, Isa> round() const {
    Lanes<Out, W, Isa> r;
    ISO_UNROLL for (int i = 0; i < W; ++i) r.v[i] = round_to<Out>(v[i]);
    return r;
  }
  template <class Out, class A, class B>
  static ISO_INLINE Lanes<Out, W, Isa> round_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
    return of_product(a, b).template round<Out>();
  }
  friend ISO_INLINE LaneSum operator+(LaneSum a, LaneSum b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] + b.v[i];
    return a;
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a, LaneSum b) {
    ISO_UNROLL for (int i = 0; i < W; ++i) a.v[i] = a.v[i] - b.v[i];
    return a;
  }
  friend ISO_INLINE LaneSum operator-(LaneSum a) { return zero() - a; }
};

/// The exact product, lane by lane, of lanes of any two formats of one width.
template <class A, class B, int W, class Isa> ISO_INLINE auto product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) return LaneSum<SumOf<A, B>, W, Isa>::of_product(a, b);
  if constexpr (!kIsFixed<A>) return a * b;
}
/// Lanes as sums of products, exact: `widen<Sum<L>>(x) + product(a, b)`.
template <class Out, class S, int W, class Isa> ISO_INLINE Out widen(Lanes<S, W, Isa> a) {
  if constexpr (kIsFixed<S>) return Out::of_lanes(a);
  if constexpr (!kIsFixed<S>) return a;
}
/// Rounds once, to nearest, ties towards plus infinity; Out is a Lanes type.
template <class Out, class SumS, int W, class Isa> ISO_INLINE Out round_to(LaneSum<SumS, W, Isa> sum) {
  return sum.template round<typename Out::Scalar>();
}
template <class Out, class S, int W, class Isa> ISO_INLINE Out round_to(Lanes<S, W, Isa> sum) { return sum; }

/// round_to<Out>(product(a, b)), which registers of 64-bit integers do in fewer steps.
template <class Out, class A, class B, int W, class Isa>
ISO_INLINE Out round_product(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) return LaneSum<SumOf<A, B>, W, Isa>::template round_product<typename Out::Scalar>(a, b);
  if constexpr (!kIsFixed<A>) return a * b;
}
/// a + b and a - b where b is zero: of floats the sign of a zero may change.
template <class A, class B, int W, class Isa>
ISO_INLINE Lanes<A, W, Isa> add_zero(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) return a;
  if constexpr (!kIsFixed<A>) return a + b;
}
template <class A, class B, int W, class Isa>
ISO_INLINE Lanes<A, W, Isa> subtract_zero(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) return a;
  if constexpr (!kIsFixed<A>) return a - b;
}

/// a b in the coarser of the two formats.
template <class A, class B, int W, class Isa>
requires(kIsFixed<A>&& kIsFixed<B>) ISO_INLINE auto operator*(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  return round_product<Lanes<decltype(A{} * B{}), W, Isa>>(a, b);
}
/// a / b as lanes of Out. Fixed point divides lane by lane: no instruction set here has an integer division.
template <class Out, class A, class B, int W, class Isa>
ISO_INLINE Out divide_to(Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) {
    using Quotient = typename Out::Scalar;
    alignas(kLaneAlignment<A, W>) A x[std::size_t{W}];
    alignas(kLaneAlignment<B, W>) B y[std::size_t{W}];
    alignas(kLaneAlignment<Quotient, W>) Quotient q[std::size_t{W}];
    a.store(x);
    b.store(y);
    ISO_UNROLL for (int i = 0; i < W; ++i) q[i] = divide_to<Quotient>(x[i], y[i]);
    return Out::load(q);
  } else {
    return a / b;
  }
}
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa> divide(Lanes<S, W, Isa> a, Lanes<S, W, Isa> b) {
  return a / b;
}
/// Converts lanes of one format to another of the same width.
template <class Out, class S, int W, class Isa> ISO_INLINE Out convert(Lanes<S, W, Isa> a) {
  if constexpr (std::same_as<Out, Lanes<S, W, Isa>>) {
    return a;
  } else {
    using One = Fixed<typename S::Raw, 1, S::kPolicy>;
    return round_to<Out>(product(a, Lanes<One, W, Isa>::broadcast(One::from_raw(2))));
  }
}

template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa>& operator+=(Lanes<S, W, Isa>& a, Lanes<S, W, Isa> b) {
  return a = a + b;
}
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa>& operator-=(Lanes<S, W, Isa>& a, Lanes<S, W, Isa> b) {
  return a = a - b;
}
template <class A, class B, int W, class Isa>
ISO_INLINE Lanes<A, W, Isa>& operator*=(Lanes<A, W, Isa>& a, Lanes<B, W, Isa> b) {
  return a = round_to<Lanes<A, W, Isa>>(product(a, b));
}
template <class SumS, int W, class Isa>
ISO_INLINE LaneSum<SumS, W, Isa>& operator+=(LaneSum<SumS, W, Isa>& a, LaneSum<SumS, W, Isa> b) {
  return a = a + b;
}
template <class SumS, int W, class Isa>
ISO_INLINE LaneSum<SumS, W, Isa>& operator-=(LaneSum<SumS, W, Isa>& a, LaneSum<SumS, W, Isa> b) {
  return a = a - b;
}

/// Gathers W records of N scalars each (N = 4 or 8): lane i of out[n] is rows[i][n]. Rows need no alignment.
template <int N, class S, int W, class Isa>
ISO_INLINE void load_transposed(const S* const* rows, Lanes<S, W, Isa>* out) {
  static_assert(N == 4 || N == 8);
  Lanes<S, W, Isa>::template load_rows<N>(rows, out);
}
/// Scatters them, rows in ascending order; a row whose bit in `lane_mask` is clear is neither read nor written.
template <int N, class S, int W, class Isa>
ISO_INLINE void store_transposed(S* const* rows, const Lanes<S, W, Isa>* in, std::uint32_t lane_mask) {
  static_assert(N == 4 || N == 8);
  Lanes<S, W, Isa>::template store_rows<N>(rows, in, lane_mask);
}

/// These traits let Unit<L>, Step<L> and Sum<L> name the lanes a kernel needs beside L.
template <class S, int W, class Isa> struct ScalarTraits<Lanes<S, W, Isa>> {
  using Unit = Lanes<typename ScalarTraits<S>::Unit, W, Isa>;
  using Step = Lanes<typename ScalarTraits<S>::Step, W, Isa>;
  static constexpr bool kExact = ScalarTraits<S>::kExact;
};

}  // namespace isostep
