// Constant velocity joint: two points coincide, and nothing twists; a cone may bound the bend.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps the frames' origins together, and b does not twist about z against a: two shafts turn at one speed at any
/// bend. The angle between the z axes never exceeds 149 degrees; kCone limits it to less.
template <class S> struct ConstantVelocityJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::constant_velocity;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected | joint_flag::kCone;
  static constexpr const char* kFlagNames = "of a constant velocity joint kCone, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = joint.drive_count = 2;
    joint.drives[0].place = 1;  // nothing drives it: the twist is an equality
    joint.drives[1].bounded_above = true;
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    const Vec3<Unit<S>> za = to_matrix(f.a).column(2), zb = to_matrix(f.b).column(2);
    detail::empty_block(joint.blocks[1]);
    detail::lock_twist(f, za, zb, h, joint);
    joint.drives[0].row = JointRow<S>::zero();
    detail::linearise_swing(za, zb, detail::most_swing(joint.properties, true), joint.drives[1]);
  }
};

}  // namespace isostep
