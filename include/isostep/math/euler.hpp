// Euler angles in the six orders of three different axes, to a quaternion and back.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/quat.hpp"

namespace isostep {

/// The axes of the first, second and third turn, each in the frame that the turn before has made. `yxz` is yaw, pitch
/// and roll. About fixed axes the same rotation has the letters from right to left.
enum class EulerOrder : std::uint8_t { xyz, xzy, yxz, yzx, zxy, zyx };

/// Angles [rad]: first and third in (-pi, pi], second in [-pi/2, pi/2].
template <class S> struct EulerAngles {
  S first, second, third;
  /// Gimbal lock: the second angle is a quarter turn; first and third turn about the same line. The third is 0 then.
  bool is_locked;
};

/// Any angles. The quaternion has either sign.
template <class S> Quat<Unit<S>> rotation_of(EulerOrder order, S first, S second, S third);

/// The angles of q: rotation_of() gives the same rotation, near gimbal lock too, where only their sum or difference is
/// known well. Locked: within some 30 steps of the format of quaternions.
/// Source:  Bernardes, Viollet 2022, Quaternion to Euler angles conversion: A direct, general and computationally
///          efficient method, PLoS ONE 17(11), e0276302, for three different axes.
template <class S> EulerAngles<S> euler_angles_of(EulerOrder order, Quat<Unit<S>> q);

#define ISO_EULER_OF(KEYWORD, S)                                   \
  KEYWORD template Quat<Unit<S>> rotation_of(EulerOrder, S, S, S); \
  KEYWORD template EulerAngles<S> euler_angles_of<S>(EulerOrder, Quat<Unit<S>>);
#define ISO_EXTERN_EULER(S) ISO_EULER_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_EULER)
#undef ISO_EXTERN_EULER

}  // namespace isostep
