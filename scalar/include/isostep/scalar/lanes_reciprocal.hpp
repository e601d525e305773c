// 1 / x of lanes: where registers hold 64-bit fixed point, all at once instead of one division after another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes_registers.hpp"

namespace isostep {

/// Computes S(1) / a, lane by lane.
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa> reciprocal(Lanes<S, W, Isa> a) {
  return Lanes<S, W, Isa>::broadcast(S(1)) / a;
}

/// Method: n / d with n = 2^2F, the raw number's, as a double: for d >= 2^(2F - 50) it is below 2^50 and within 1/4, so
///         that the integer next to it, whatever the rounding mode, is within 5/4. The remainder n - q d, which fits
///         although n and q d do not, then says which of three neighbours is nearest. Powers of two divide n: no tie.
/// Range:  d is exact as a double below 2^52. If any lane is outside, all are divided one by one.
template <class S, int W, class Isa>
requires(InRegister<S, W, Isa>&& std::same_as<detail::LaneKey<S>, std::int64_t> && (S::kFracBits >= 25) &&
         (S::kFracBits <= 40)) ISO_INLINE Lanes<S, W, Isa> reciprocal(Lanes<S, W, Isa> a) {
  using L = Lanes<S, W, Isa>;
  using R = Registers<std::int64_t, Isa>;
  constexpr int n = 2 * S::kFracBits;
  const auto number = [](std::int64_t raw) ISO_INLINE_LAMBDA { return L::broadcast(S::from_raw(raw)); };
  const auto plain = less_equal(number(std::int64_t{1} << (n - 50)), a) & less(a, number(std::int64_t{1} << 52));
  if (!all(plain)) return number(std::int64_t{1} << S::kFracBits) / a;
  const L q = {R::quotient_near(static_cast<double>(std::uint64_t{1} << (n / 2)) * (std::uint64_t{1} << (n / 2)), a.v)};
  const L rest = number(n < 64 ? std::int64_t{1} << (n % 64) : 0) - L{R::multiply_low(q.v, a.v)};
  const L twice = rest + rest, one = number(1);
  return q + select(less_equal(a, twice), one, L::zero()) - select(less(twice, -a), one, L::zero());
}

}  // namespace isostep
