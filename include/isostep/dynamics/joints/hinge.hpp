// Hinge: points and z axes coincide; the angle about z may be limited, driven and sprung.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"

namespace isostep {

/// Origins and z axes coincide. kLimit, kMotor and kSpring: of the angle about z.
template <class S> struct HingeJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::hinge;
  static constexpr std::uint32_t kFlags =
      joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
  static constexpr const char* kFlagNames = "of a hinge kLimit, kMotor, kSpring, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;
  static constexpr bool kDrivesAlone = false;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    const std::uint32_t flags = joint.properties.flags;
    JointDrive<S>& drive = joint.drives[0];
    joint.block_count = 2;
    joint.drive_count = (flags & (joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring)) != 0 ? 1 : 0;
    drive.bounded_below = drive.bounded_above = (flags & joint_flag::kLimit) != 0;
    drive.driven = (flags & joint_flag::kMotor) != 0;
    drive.sprung = (flags & joint_flag::kSpring) != 0;
  }
  /// Symbols: z_a x z_b is the rotation, to first order, by which b's axis has left a's; it has no part along z_a.
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    const Mat3<Unit<S>> a = to_matrix(f.a);
    const Vec3<Unit<S>> tilt = transposed_times(a, to_matrix(f.b).column(2));  // b's axis in a's frame
    JointBlock<S>& block = joint.blocks[1];
    block.point = false;
    block.rows[0] = detail::angular_row<S>(a.column(0), joint.radius);
    block.rows[1] = detail::angular_row<S>(a.column(1), joint.radius);
    block.rows[2] = JointRow<S>::zero();
    block.error = {detail::bounded_error(-(joint.radius * tilt.y), h), detail::bounded_error(joint.radius * tilt.x, h),
                   Velocity<S>(0)};
    if (joint.drive_count == 0) return;
    joint.drives[0].row = detail::angular_row<S>(a.column(2), joint.drives[0].radius);
    detail::set_angle(joint.drives[0], joint.properties, detail::twist_angle<S>(detail::relative_rotation(f)));
  }
};

}  // namespace isostep
