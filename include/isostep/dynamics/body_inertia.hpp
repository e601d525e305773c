// The inertia of a body in the world: its axes, its inverse inertia, and what locks leave of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/dynamics/body.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/math/quat.hpp"

namespace isostep::detail {

/// Returns the rotation from a body's principal axes to the world. For most shapes they are the body's own axes.
template <class S> ISO_INLINE Mat3<Unit<S>> world_axes(Quat<Unit<S>> orientation, const BodyProperties<S>& body) {
  const bool own = body.principal == Quat<Unit<S>>::identity();
  return to_matrix(own ? orientation : orientation * body.principal);
}

/// Returns true if free rotation changes the body's angular velocity. Locks hold a body that may not turn about each
/// axis: the change of a free body's angular velocity, cut down to the free axes, would drive it like a motor.
template <class S> ISO_INLINE bool turns_freely(const BodyProperties<S>& body) {
  return (body.flags & (body_flag::kSpins | body_flag::kAngularLocks)) == body_flag::kSpins;
}

/// Returns mass times inverse inertia in world axes [1/m^2]. A locked axis bears whatever torque keeps its angular
/// velocity zero, so the result is the inverse of the inertia about the free axes alone.
template <class S> ISO_INLINE Mat3<S> world_kappa(const BodyProperties<S>& body, const Mat3<Unit<S>>& axes) {
  Mat3<S> kappa =
      (body.flags & body_flag::kSpins) != 0 ? rotate_diagonal(axes, body.kappa) : Mat3<S>::diagonal(body.kappa);
  if ((body.flags & body_flag::kAngularLocks) == 0) return kappa;
  for (int axis = 0; axis < 3; ++axis) {
    if ((body.flags & (body_flag::kLockAngularX << axis)) == 0) continue;
    const Vec3<S> held = kappa.rows[axis];
    for (int i = 0; i < 3; ++i) {
      const S share = S(0) < held[axis] && i != axis ? divide_to<S>(held[i], held[axis]) : S(0);
      for (int k = 0; k < 3; ++k) {
        const bool gone = i == axis || k == axis;
        kappa.rows[i][k] = gone ? S(0) : kappa.rows[i][k] - saturate_to<S>(product(share, held[k]));
      }
    }
  }
  return kappa;
}

}  // namespace isostep::detail
