// Angles [rad] as numbers on a circle.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// The angle [rad] of the same direction within [-pi, pi]; an angle there is not changed. float, double: not finite
/// gives NaN.
template <class S> S wrap_angle(S angle);
/// Returns the turn from one angle to another the short way, within [-pi, pi]. to - from must fit S.
template <class S> S angle_difference(S from, S to);
/// Interpolates from `from` (t = 0) the short way to `to` (t = 1), within [-pi, pi].
template <class S> S lerp_angle(S from, S to, Unit<S> t);
/// Moves at most `most` [rad] nearer to `to`, the short way. Returns `to` itself once it is that near.
template <class S> S turn_towards(S from, S to, S most);

template <class S> S to_degrees(S radians);
template <class S> S to_radians(S degrees);

#define ISO_ANGLES_OF(KEYWORD, S)                  \
  KEYWORD template S wrap_angle(S);                \
  KEYWORD template S angle_difference(S, S);       \
  KEYWORD template S lerp_angle<S>(S, S, Unit<S>); \
  KEYWORD template S turn_towards(S, S, S);        \
  KEYWORD template S to_degrees(S);                \
  KEYWORD template S to_radians(S);
#define ISO_EXTERN_ANGLES(S) ISO_ANGLES_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_ANGLES)
#undef ISO_EXTERN_ANGLES

}  // namespace isostep
