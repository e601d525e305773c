// The members that joints share which hold the origins of their frames together: their first block is the point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// The base of such joints. Each has the other members of `JointOf` (joint_kinds.hpp).
template <class S> struct PointJoint {
  static constexpr bool kTwoPoints = false;
  static constexpr bool kTwistAndSwing = false;

  /// Accepts any setting that is valid for all joints.
  static ISO_INLINE FaultReport fault(const JointProperties<S>&) { return {}; }
  static ISO_INLINE bool is_point(const JointProperties<S>&) { return true; }
  static ISO_INLINE bool is_free(const JointProperties<S>&, std::uint32_t) { return false; }

  static ISO_INLINE Vec3<Velocity<S>> pull(const JointConstraint<S>& joint) { return joint.blocks[0].impulse; }
  static ISO_INLINE S error(const JointProperties<S>&, const Pose<S>& a, const Pose<S>& b) {
    return distance(a.position, b.position);
  }
};

}  // namespace isostep::detail
