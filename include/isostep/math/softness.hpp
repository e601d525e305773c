// Soft constraints: how a spring and damper of given frequency become the coefficients of an impulse.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// Source:  Catto 2011, Soft Constraints (GDC), with the coefficients of Soft Step: an implicit spring whose answer is
///          delta = -e (mass_scale (speed + bias_rate position)) - impulse_scale impulse.
/// Symbols: e = effective mass.
template <class S> struct Softness {
  S bias_rate;      // [1/s] speed asked for per metre of error
  S mass_scale;     // [1]
  S impulse_scale;  // [1]

  /// No spring: velocity alone, what the relax pass solves.
  static ISO_INLINE constexpr Softness rigid() { return {S(0), S(1), S(0)}; }
  ISO_FIELDS(bias_rate, mass_scale, impulse_scale)
};

/// `angle` = 2 pi frequency h [rad] a sub-step, `damping` ratio [1], `rate` = 1/h [1/s].
template <class S> ISO_INLINE constexpr Softness<S> soften(S angle, S damping, S rate) {
  const S a1 = S(2) * damping + angle;
  const S a2 = angle * a1;
  const S a3 = S(1) / (S(1) + a2);
  return {rate * (angle / a1), a2 * a3, a3};
}

}  // namespace isostep
