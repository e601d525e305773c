// IslandNumber<N>: what solvers of islands require of LinearSystem<S>::Number beyond its operators.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/vec3.hpp"
#include "isostep/scalar/linear_system.hpp"

namespace isostep {

/// Fixed point shares exponents. Floating point has its own: every exponent is 0 there, and so are these constants.
/// kRoom  exponent that leaves a number half of its range
/// kGain  exponent by which answers may exceed right-hand sides: loads of a thousand bodies fit, and 2^-42 is left
template <class N> struct IslandNumber;

template <class T> struct IslandNumber<Exact<T>> {
  using N = Exact<T>;
  using Sum = N;
  static constexpr int kRoom = 0, kGain = 0;

  static ISO_INLINE Sum times(N a, N b) { return a * b; }
  static ISO_INLINE N rounded(Sum a) { return a; }
  static ISO_INLINE N sum(N a, N b) { return a + b; }
  /// Returns the least e for which |x| < 2^e.
  static ISO_INLINE int size(N) { return 0; }
  /// Returns x 2^n.
  static ISO_INLINE N shifted(N x, int) { return x; }
  static ISO_INLINE N root(N x) { return sqrt(x); }
  /// Computes 1 / root x = result 2^exponent.
  static ISO_INLINE N inverse_root(N x, int& exponent) {
    exponent = 0;
    return N(1) / sqrt(x);
  }
  static ISO_INLINE N quotient(N a, N b) { return a / b; }
  /// Returns x 2^n, for a factor that is no exponent.
  static ISO_INLINE N times_power(N x, int n) {
    const N power = N(static_cast<T>(std::uint64_t{1} << (n < 0 ? -n : n)));
    return n < 0 ? x / power : x * power;
  }
  /// The bound of an answer.
  static constexpr N kMost = N(0x1p500);
  static ISO_INLINE N bounded(N x) { return x; }
  /// Returns a / b, b > 0, held within the bound.
  static ISO_INLINE N bounded_quotient(N a, N b) { return a / b; }
};

template <> struct IslandNumber<Fixed<std::int64_t, 62>> {
  using N = Fixed<std::int64_t, 62>;
  using Sum = FixedSum<std::int64_t, 124>;
  static constexpr int kRoom = 1, kGain = 20;
  static constexpr N kMost = N(0x1p-4);  // of an answer: 32 of them may push a body the same way

  static ISO_INLINE Sum times(N a, N b) { return product(a, b); }
  static ISO_INLINE N rounded(Sum a) { return round_to<N>(a); }
  static ISO_INLINE N sum(N a, N b) { return saturating_add(a, b); }
  static ISO_INLINE int size(N x) {
    const std::uint64_t raw = detail::magnitude(x.raw());
    return (raw == 0 ? 0 : 64 - detail::leading_zeros(raw)) - N::kFracBits;
  }
  static ISO_INLINE N shifted(N x, int n) {
    const std::uint64_t raw = detail::magnitude(x.raw());
    constexpr std::uint64_t most = ~std::uint64_t{0} >> 1;
    std::uint64_t moved = n <= 0 ? detail::shift_right_rounded(raw, -n) : raw;
    if (n > 0 && raw != 0) moved = n < detail::leading_zeros(raw) ? raw << n : most;
    const auto size = static_cast<std::int64_t>(moved);
    return N::from_raw(x.raw() < 0 ? -size : size);
  }
  static ISO_INLINE N root(N x) { return sqrt(x); }
  /// Takes x in [1/4, 1).
  static ISO_INLINE N inverse_root(N x, int& exponent) {
    exponent = 1;
    return divide_to<N>(N(0.5), sqrt(x));
  }
  /// Takes |a| < 2 |b|.
  static ISO_INLINE N quotient(N a, N b) { return a / b; }
  static ISO_INLINE N times_power(N x, int n) { return shifted(x, n); }
  static ISO_INLINE N bounded(N x) { return clamp(x, -kMost, kMost); }
  static ISO_INLINE N bounded_quotient(N a, N b) {
    const N most = b * kMost;
    return a < -most ? -kMost : most < a ? kMost : a / b;
  }
};

/// The linear and the angular part of a row of W, or of a body's motion.
template <class N> struct IslandMotion {
  Vec3<N> linear, angular;

  static ISO_INLINE IslandMotion zero() {
    const Vec3<N> none = {N(0), N(0), N(0)};
    return {none, none};
  }
};

template <class N> ISO_INLINE auto product_sum(const IslandMotion<N>& a, const IslandMotion<N>& b) {
  using D = IslandNumber<N>;
  return D::times(a.linear.x, b.linear.x) + D::times(a.linear.y, b.linear.y) + D::times(a.linear.z, b.linear.z) +
         D::times(a.angular.x, b.angular.x) + D::times(a.angular.y, b.angular.y) + D::times(a.angular.z, b.angular.z);
}
/// Computes m += w x, held within the format.
template <class N> ISO_INLINE void add_scaled(IslandMotion<N>& m, const IslandMotion<N>& w, N x) {
  using D = IslandNumber<N>;
  const auto add = [x](N a, N b) ISO_INLINE_LAMBDA { return D::sum(a, b * x); };
  m.linear = {add(m.linear.x, w.linear.x), add(m.linear.y, w.linear.y), add(m.linear.z, w.linear.z)};
  m.angular = {add(m.angular.x, w.angular.x), add(m.angular.y, w.angular.y), add(m.angular.z, w.angular.z)};
}

}  // namespace isostep
