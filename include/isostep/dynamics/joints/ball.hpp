// Ball joint: two points coincide; a cone bounds the swing and an interval the twist of a shoulder or a hip.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps origins together. kLimit: lower..upper limit the twist about z, and the z axes are at most 149 degrees apart,
/// as the twist has no meaning beyond. kCone limits the angle between the z axes.
template <class S> struct BallJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::ball;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kCone;
  static constexpr const char* kFlagNames = "of a ball joint kLimit, kCone, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;
  static constexpr bool kTwistAndSwing = true;

  static ISO_INLINE bool is_free(const JointProperties<S>&, std::uint32_t block) { return block == 1; }
  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    const bool limit = (joint.properties.flags & joint_flag::kLimit) != 0;
    const bool cone = (joint.properties.flags & joint_flag::kCone) != 0;
    joint.block_count = cone || limit ? 2 : 1;
    joint.drive_count = cone || limit ? 2 : 0;
    joint.drives[0].bounded_below = joint.drives[0].bounded_above = limit;
    joint.drives[1].bounded_above = cone || limit;
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    if (joint.drive_count == 0) return;
    detail::empty_block(joint.blocks[1]);
    const Vec3<Unit<S>> za = to_matrix(f.a).column(2), zb = to_matrix(f.b).column(2);
    const bool limit = (joint.properties.flags & joint_flag::kLimit) != 0;
    detail::set_twist(f, za, zb, limit, joint.properties, joint.drives[0]);
    detail::linearise_swing(za, zb, detail::most_swing(joint.properties, limit), joint.drives[1]);
  }
};

}  // namespace isostep
