// Soft limits of an AxisDrive: which spring acts along a drive in a sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_drive.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE bool is_soft(const AxisDrive<S>& asked) {
  return asked.limited && S(0) < asked.limit_frequency;
}
/// Gives the drive its own spring.
template <class S> ISO_INLINE void set_spring(const AxisDrive<S>& asked, JointDrive<S>& drive) {
  drive.sprung = S(0) < asked.spring_frequency;
  drive.servo = drive.sprung && !drive.driven && !asked.motor && S(0) < asked.max_force;
  drive.frequency = asked.spring_frequency;
  drive.damping = asked.spring_damping;
  drive.spring_root = S(0);  // to be weighed
}

/// Makes a limit a spring toward itself, beside the drive's own, while a sub-step begins beyond it: stiffness and
/// damping add up, w^2 = w1^2 + w2^2, d w = d1 w1 + d2 w2. It replaces a servo, since one spring for both would not
/// know the bound of the servo's force. `linearise` must have placed the drive.
/// Source:  PxJointLimitParameters of PhysX: a limit with stiffness acts where it is violated.
/// Limits:  a body is beyond the limit by up to its speed times the sub-step before it acts. So the spring is implicit,
///          without what `lagging_way` gives back: it loses at least the energy that it did not take on that way, and a
///          bounce gives none.
template <class S> ISO_INLINE void yield_limit(JointDrive<S>& drive) {
  const AxisDrive<S>&asked = *drive.asked, &spring = *drive.spring_asked;
  const bool below = drive.bounded_below && drive.position < drive.lower;
  const bool above = drive.bounded_above && drive.upper < drive.position;
  drive.bounded_below = drive.bounded_above = false;
  drive.yields = below || above;
  set_spring(spring, drive);
  if (!drive.yields) return;
  const S limit = below ? drive.lower : drive.upper;
  const S own = drive.servo ? S(0) : spring.spring_frequency;
  const Direction<S> both = direction_of(asked.limit_frequency, own, S(0));
  const S of_limit = convert<S>(both.x), of_own = convert<S>(both.y);
  drive.sprung = true;
  drive.servo = false;
  drive.frequency = both.length;
  drive.damping = of_limit * asked.limit_damping + of_own * spring.spring_damping;
  drive.target = limit + of_own * of_own * (drive.target - limit);
}

}  // namespace isostep::detail
