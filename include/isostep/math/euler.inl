// Bodies of euler.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/angles.inl"
#include "isostep/math/euler.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

struct EulerAxes {
  int first, second, third;  // 0 x, 1 y, 2 z
  bool even;                 // x y z, y z x or z x y: first times second is third
};
ISO_INLINE EulerAxes axes_of(EulerOrder order) {
  constexpr EulerAxes kAxes[] = {{0, 1, 2, true}, {0, 2, 1, false}, {1, 0, 2, false},
                                 {1, 2, 0, true}, {2, 0, 1, true},  {2, 1, 0, false}};
  return kAxes[static_cast<int>(order)];
}
template <class S> ISO_INLINE Quat<Unit<S>> turn_about(int axis, S angle) {
  Vec3<Unit<S>> direction = Vec3<Unit<S>>::zero();
  direction[axis] = Unit<S>(1);
  return rotation(direction, angle);
}
/// sqrt(x^2 + y^2)
template <class U> ISO_INLINE U length2(U x, U y) { return direction_of(x, y, U(0)).length; }

}  // namespace detail

template <class S> Quat<Unit<S>> rotation_of(EulerOrder order, S first, S second, S third) {
  return pin_floats([&]() -> Quat<Unit<S>> {
    const detail::EulerAxes axes = detail::axes_of(order);
    return detail::turn_about(axes.first, first) * detail::turn_about(axes.second, second) *
           detail::turn_about(axes.third, third);
  });
}

template <class S> EulerAngles<S> euler_angles_of(EulerOrder order, Quat<Unit<S>> q) {
  return pin_floats([&]() -> EulerAngles<S> {
    using U = Unit<S>;
    const detail::EulerAxes axes = detail::axes_of(order);
    const Vec3<U> v = {q.x, q.y, q.z};
    const U i = v[axes.first], j = v[axes.second], k = axes.even ? v[axes.third] : -v[axes.third];
    // w + j and i + k are cosine and sine of half the sum of first and third, times sqrt(2) sin(second / 2 + pi/4);
    // w - j and i - k those of half their difference, times the cosine.
    const U sum_cosine = q.w + j, sum_sine = i + k, difference_cosine = q.w - j, difference_sine = i - k;
    const U with_sum = detail::length2(sum_cosine, sum_sine);
    const U with_difference = detail::length2(difference_cosine, difference_sine);
    const auto angle_of = [](U sine, U cosine) { return detail::stored([&] { return atan2_to<S>(sine, cosine); }); };
    const auto wrapped = [](S angle) { return detail::stored([&] { return wrap_angle(angle); }); };
    S sum = angle_of(sum_sine, sum_cosine), difference = angle_of(difference_sine, difference_cosine);
    U locked = resolution<U>();
    for (int doubled = 0; doubled < 5; ++doubled) locked = locked + locked;
    const bool no_sum = with_sum <= locked, no_difference = with_difference <= locked;
    if (no_sum) sum = difference;
    if (no_difference) difference = sum;
    const S eighth = angle_of(with_sum, with_difference), quarter_turn = S(1.57079632679489661923);
    const S third = sum - difference;
    return {wrapped(sum + difference), eighth + eighth - quarter_turn, wrapped(axes.even ? third : -third),
            no_sum || no_difference};
  });
}

}  // namespace isostep
