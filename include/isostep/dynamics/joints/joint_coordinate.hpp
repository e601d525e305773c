// The one coordinate that a joint leaves to motors: where it stands, and the row along which it moves.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_couplings.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"

namespace isostep::detail {

/// Returns true if a type of joint has a coordinate: a motor may drive it, or it holds two points a length apart. The
/// length of a rod does not move, but settings may make a rope of the joint.
ISO_INLINE constexpr bool has_coordinate(JointType type) {
  return joins_two_points(type) || visit_joint_type(type, [](auto kind) ISO_INLINE_LAMBDA {
           return (decltype(kind)::template Of<float>::kFlags & joint_flag::kMotor) != 0;
         });
}

/// Returns the coordinate: the twist about z in (-pi, pi] [rad], the way along z [m] or the distance of two points [m].
template <class S> ISO_INLINE S position_of(JointType type, const JointFrames<S>& f) {
  if (measure_of(type) == JointMeasure::angle) return twist_angle<S>(relative_rotation(f));
  return joins_two_points(type) ? length(f.between) : dot(f.between, to_matrix(f.a).column(2));
}

/// Returns a joint with only a motor and its limits at its coordinate: drives[0] is that drive. A length between points
/// has no limits there, so that a rod has a drive too.
template <class S> ISO_INLINE JointProperties<S> with_coordinate(JointProperties<S> p) {
  if (!joins_two_points(p.type)) {
    p.flags = joint_flag::kMotor | (p.flags & joint_flag::kLimit);
    return p;
  }
  p.flags = joint_flag::kLimit;
  p.lower = S(0);
  p.upper = Limits<S>::position();
  return p;
}

}  // namespace isostep::detail
