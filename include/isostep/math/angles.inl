// Bodies of angles.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/angles.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {

template <class S> S wrap_angle(S angle) {
  return pin_floats([&]() -> S {
    const S half_turn = S(3.14159265358979323846);
    if (-half_turn <= angle && angle <= half_turn) return angle;
    // A remainder of the rounded circumference would be wrong by one rounding a turn: sine and cosine reduce exactly.
    const SinCos<Unit<S>> at = sin_cos_to<Unit<S>>(angle);
    return atan2_to<S>(at.sin, at.cos);
  });
}
template <class S> S angle_difference(S from, S to) {
  return pin_floats([&]() -> S { return wrap_angle(to - from); });
}
template <class S> S lerp_angle(S from, S to, Unit<S> t) {
  return pin_floats([&]() -> S { return wrap_angle(from + angle_difference(from, to) * t); });
}
template <class S> S turn_towards(S from, S to, S most) {
  return pin_floats([&]() -> S {
    const S way = angle_difference(from, to);
    if (abs(way) <= most) return to;
    return wrap_angle(way < S(0) ? from - most : from + most);
  });
}

template <class S> S to_degrees(S radians) {
  return pin_floats([&]() -> S { return radians * S(57.2957795130823208768); });
}
template <class S> S to_radians(S degrees) {
  return pin_floats([&]() -> S { return degrees * Unit<S>(0.01745329251994329577); });
}

}  // namespace isostep
