// SurfaceVelocity: a body whose surface runs: a conveyor belt, an escalator, a turntable, a treadmill.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using SurfaceVelocityId = Id<struct SurfaceVelocityTag>;

/// The surface of a body moves while the body does not: friction drags what touches it towards the velocity that a
/// rigid body of these two would have at the contact, as far as the coefficient and the load allow. The body itself may
/// be static, kinematic or dynamic; a dynamic one is pushed back. It adds to Material::surface_velocity, which is the
/// same in the world's axes. One record a body.
/// A turning surface turns what lies on it and leads it round a circle: a sub-step aims at the end of its arc, as on a
/// kinematic body that turns (carrying.hpp). A character rides on it.
/// Sleep: a surface that runs keeps awake what touches it, what is held against a wall as well: the wall may go.
/// Limits: all that a body's surface adds at a point is held within Limits::speed(), axis by axis.
template <class S> struct SurfaceVelocity {
  BodyId body = {};
  Vec3<S> linear = {S(0), S(0), S(0)};   // [m/s] body frame
  Vec3<S> angular = {S(0), S(0), S(0)};  // [rad/s] body frame, about the body's origin

  ISO_INLINE bool runs() const { return !(linear == Vec3<S>::zero() && angular == Vec3<S>::zero()); }

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};

}  // namespace isostep
