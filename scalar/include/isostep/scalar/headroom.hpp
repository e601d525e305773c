// Numbers within half of what their format holds, two of which can be added without wrapping; sums within bounds.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/scalar.hpp"

namespace isostep {

namespace detail {
/// 2^(n - 2) raw units of n bits, less one whole: a whole number, as bounds of lanes are, in every format that has more
/// than two bits before the point. Twice 2^(n - 2) raw units would be one more than the format holds.
template <class S> ISO_INLINE constexpr S half_of_range() {
  return S::from_raw(static_cast<typename S::Raw>((highest<S>().raw() >> 1) + 1)) - S(1);
}
}  // namespace detail

/// Returns x, or the nearer end of that half of a fixed-point format. Floating point does not wrap.
template <class S> ISO_INLINE constexpr S with_headroom(S x) {
  if constexpr (kIsFixed<S>) {
    return clamp(x, -detail::half_of_range<S>(), detail::half_of_range<S>());
  } else {
    return x;
  }
}
/// Converts an exact sum to a number, held between -most and most.
template <class Out, class Sum> ISO_INLINE constexpr Out round_within(Sum sum, Out most) {
  return round_to<Out>(clamp(sum, -widen<Sum>(most), widen<Sum>(most)));
}
/// Converts an exact sum to a number within half of its format.
template <class Out, class Sum> ISO_INLINE constexpr Out round_with_headroom(Sum sum) {
  if constexpr (kIsFixed<Out>) {
    return round_within<Out>(sum, detail::half_of_range<Out>());
  } else {
    return round_to<Out>(sum);
  }
}

}  // namespace isostep
