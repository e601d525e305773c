// Lanes held so far within their format that two of them can be added, both ends among them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes_bounded.hpp"

namespace isostep {

namespace detail {
/// half_of_range() twice is one more than a format holds.
template <class S> ISO_INLINE constexpr S most_addable() { return half_of_range<S>() - S(1); }
}  // namespace detail

/// x, or the end of what can be added to another such: of a fixed-point format. Floating point does not wrap.
template <class S, int W, class Isa> ISO_INLINE Lanes<S, W, Isa> addable(Lanes<S, W, Isa> x) {
  if constexpr (kIsFixed<S>) {
    const auto most = Lanes<S, W, Isa>::broadcast(detail::most_addable<S>());
    return clamp(x, -most, most);
  } else {
    return x;
  }
}
/// An exact sum as such a number.
template <class Out, class Sum> ISO_INLINE Out round_addable(Sum sum) {
  using S = typename Out::Scalar;
  if constexpr (kIsFixed<S>) return round_within<Out>(sum, detail::most_addable<S>());
  else return round_to<Out>(sum);
}

}  // namespace isostep
