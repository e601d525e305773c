// MoveTarget: where the next step carries a kinematic body.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

using MoveTargetId = Id<struct MoveTargetTag>;

/// The next step carries the body there, and ends the record. In that step the body has the velocity that leads there,
/// along a line and about one axis by the shorter way, so that it pushes and carries what it touches, and is held by no
/// lock; as the step ends it lies exactly at the pose, and stands still. What is further than a body may move in a
/// step, Limits::speed() and a radian a sub-step, is not reached: the body goes as far, and stops there. A velocity
/// that was set is of no account. While the body is disabled the record waits. One record a body.
template <class S> struct MoveTarget {
  BodyId body = {};
  Pose<S> pose = Pose<S>::identity();  // of the body's origin, world

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("pose", self.pose);
  }
};

}  // namespace isostep
