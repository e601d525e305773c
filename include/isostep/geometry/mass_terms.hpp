// The common terms of closed forms of mass and inertia: products that saturate, quotients that keep their digits.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/limits.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep::detail {

/// The product of f[0] ... f[4], all positive, saturated at Limits<S>::mass(). It starts with the largest factor, then
/// takes the smallest while the product is large and the largest while it is small: no intermediate overflows before
/// the result does, and none is so small that its rounding shows.
template <class S> ISO_INLINE S saturating_product(const S (&factors)[5]) {
  S f[5];
  for (int i = 0; i < 5; ++i) {
    int at = i;
    for (; at > 0 && factors[i] < f[at - 1]; --at) f[at] = f[at - 1];
    f[at] = factors[i];
  }
  const S most = Limits<S>::mass();
  S result = min(f[4], most);
  int low = 0;
  int high = 3;
  while (low <= high) {
    const S next = result > S(16) ? f[low++] : f[high--];
    const Sum<S> exact = product(result, next);
    result = exact > widen<Sum<S>>(most) ? most : round_to<S>(exact);
  }
  return result;
}

/// The quotient n / (d x^2), division by division: every quotient lies between n / d, which is near one, and the
/// result.
template <class S> ISO_INLINE S quotient(Unit<S> n, Unit<S> d, S x) { return divide_to<S>(n, d) / x / x; }

}  // namespace isostep::detail
