// Roots, quotients, lengths and directions of lanes: every lane has the bits of the scalar's own function.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/scalar/lanes.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// The first bit that is set, for bits != 0. std::countr_zero would be a weak symbol at -O0.
ISO_INLINE int first_bit(std::uint64_t bits) {
#if defined(__GNUC__)
  return __builtin_ctzll(bits);
#else
  return std::countr_zero(bits);
#endif
}

/// Computes square roots. Fixed point takes them one by one.
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa> root(Lanes<S, W, Isa> a) {
  if constexpr (kIsFixed<S>) {
    alignas(kLaneAlignment<S, W>) S x[W];
    a.store(x);
    ISO_UNROLL for (int i = 0; i < W; ++i) x[i] = sqrt(x[i]);
    return Lanes<S, W, Isa>::load(x);
  } else {
    return sqrt(a);
  }
}

/// normalise4() of scalar/math.hpp, lane by lane.
template <class U, int W, class Isa>
ISO_INLINE void normalise4(Lanes<U, W, Isa>& x, Lanes<U, W, Isa>& y, Lanes<U, W, Isa>& z, Lanes<U, W, Isa>& w) {
  using L = Lanes<U, W, Isa>;
  if constexpr (kIsFixed<U>) {
    alignas(kLaneAlignment<U, W>) U q[4][W];
    x.store(q[0]);
    y.store(q[1]);
    z.store(q[2]);
    w.store(q[3]);
    for (int i = 0; i < W; ++i) normalise4(q[0][i], q[1][i], q[2][i], q[3][i]);
    x = L::load(q[0]);
    y = L::load(q[1]);
    z = L::load(q[2]);
    w = L::load(q[3]);
  } else {
    const L squared = x * x + y * y + z * z + w * w;
    const auto lost = equal(squared, L::zero());
    const L inverse = L::broadcast(U(1)) / sqrt(squared);
    x = select(lost, x, x * inverse);
    y = select(lost, y, y * inverse);
    z = select(lost, z, z * inverse);
    w = select(lost, L::broadcast(U(1)), w * inverse);
  }
}

/// Returns a / b where the mask says so, zero elsewhere. Fixed point divides only those lanes: its divisions are dear.
template <class Out, class Mask, class A, class B, int W, class Isa>
ISO_INLINE Out quotient_where(Mask mask, Lanes<A, W, Isa> a, Lanes<B, W, Isa> b) {
  if constexpr (kIsFixed<A>) {
    using Quotient = typename Out::Scalar;
    const std::uint32_t bits = to_bits(mask);
    alignas(kLaneAlignment<A, W>) A x[W];
    alignas(kLaneAlignment<B, W>) B y[W];
    alignas(kLaneAlignment<Quotient, W>) Quotient q[W];
    a.store(x);
    b.store(y);
    for (int i = 0; i < W; ++i) q[i] = ((bits >> i) & 1u) != 0 ? divide_to<Quotient>(x[i], y[i]) : Quotient(0);
    return Out::load(q);
  } else {
    return select(mask, a / b, Out::zero());
  }
}

/// The lowest of all lanes.
template <class S, int W, class Isa> ISO_INLINE S lowest_lane(Lanes<S, W, Isa> a) {
  alignas(kLaneAlignment<S, W>) S v[W];
  a.store(v);
  for (int n = W / 2; n > 0; n /= 2) {
    for (int i = 0; i < n; ++i) v[i] = min(v[i], v[i + n]);
  }
  return v[0];
}

/// |(x, y, z)| > length, for length >= 0. Fixed point compares exact sums one by one.
template <class S, int W, class Isa>
ISO_INLINE typename Lanes<S, W, Isa>::Mask is_longer(Lanes<S, W, Isa> x, Lanes<S, W, Isa> y, Lanes<S, W, Isa> z,
                                                     Lanes<S, W, Isa> length) {
  if constexpr (kIsFixed<S>) {
    alignas(kLaneAlignment<S, W>) S in[4][W];
    x.store(in[0]);
    y.store(in[1]);
    z.store(in[2]);
    length.store(in[3]);
    std::uint32_t bits = 0;
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      const auto square = product(in[0][i], in[0][i]) + product(in[1][i], in[1][i]) + product(in[2][i], in[2][i]);
      bits |= (square > product(in[3][i], in[3][i]) ? 1u : 0u) << i;
    }
    return Lanes<S, W, Isa>::Mask::from_bits(bits);
  } else {
    return less(length * length, x * x + y * y + z * z);
  }
}

/// Computes direction_of the vectors that the mask names; the others get any value. Fixed point takes them one by one.
template <class Mask, class S, int W, class Isa>
ISO_INLINE Direction<Lanes<S, W, Isa>> direction_where(Mask mask, Lanes<S, W, Isa> x, Lanes<S, W, Isa> y,
                                                       Lanes<S, W, Isa> z) {
  using L = Lanes<S, W, Isa>;
  if constexpr (kIsFixed<S>) {
    using U = Unit<S>;
    const std::uint32_t bits = to_bits(mask);
    alignas(kLaneAlignment<S, W>) S in[3][W];
    alignas(kLaneAlignment<U, W>) U out[3][W];
    alignas(kLaneAlignment<S, W>) S length[W];
    x.store(in[0]);
    y.store(in[1]);
    z.store(in[2]);
    for (int i = 0; i < W; ++i) {
      const Direction<S> d =
          ((bits >> i) & 1u) != 0 ? direction_of(in[0][i], in[1][i], in[2][i]) : Direction<S>{U(0), U(0), U(0), S(0)};
      out[0][i] = d.x;
      out[1][i] = d.y;
      out[2][i] = d.z;
      length[i] = d.length;
    }
    return {Unit<L>::load(out[0]), Unit<L>::load(out[1]), Unit<L>::load(out[2]), L::load(length)};
  } else {
    using Limits = detail::RescaleLimits<S>;
    const auto number = [](S a) ISO_INLINE_LAMBDA { return L::broadcast(a); };
    const L plain = x * x + y * y + z * z;
    const auto tiny = less(plain, number(Limits::kLow)), huge = less(number(Limits::kHigh), plain);
    const L one = number(S(1));
    const L up = select(tiny, number(Limits::kTiny.up), select(huge, number(Limits::kHuge.up), one));
    const L down = select(tiny, number(Limits::kTiny.down), select(huge, number(Limits::kHuge.down), one));
    const L a = x * up, b = y * up, c = z * up;
    const L length = sqrt(a * a + b * b + c * c);
    const auto none = equal(length, L::zero());
    const L zero = L::zero();
    return {select(none, zero, a / length), select(none, zero, b / length), select(none, zero, c / length),
            select(none, zero, length * down)};
  }
}
/// Computes their lengths alone: the same bits, with less work while no square leaves the range.
template <class Mask, class S, int W, class Isa>
ISO_INLINE Lanes<S, W, Isa> length_where(Mask mask, Lanes<S, W, Isa> x, Lanes<S, W, Isa> y, Lanes<S, W, Isa> z) {
  if constexpr (kIsFixed<S>) {
    return direction_where(mask, x, y, z).length;
  } else {
    using L = Lanes<S, W, Isa>;
    using Limits = detail::RescaleLimits<S>;
    const L plain = x * x + y * y + z * z;
    const auto strange = less(plain, L::broadcast(Limits::kLow)) | less(L::broadcast(Limits::kHigh), plain);
    const L length = sqrt(plain);
    return any(strange) ? select(strange, direction_where(mask, x, y, z).length, length) : length;
  }
}

}  // namespace isostep
