// Six-axis joint: each of the six ways in which b can move against a is locked, free, or driven by an AxisDrive.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/swing_rows.hpp"

namespace isostep {

/// Locks or drives each of six axes. Lengths: b's origin along the axes of a. Angles: with two of them locked the third
/// is a turn about that axis, like a hinge's; else swings and a twist, see SwingTwist. A swing that is locked, or has
/// limits within 80 degrees beside a swing without, is the tilt of b's z axis out of the plane across, and the other
/// swing is a turn, which goes round: see TiltTurn. A twist beside swings that is locked, limited or sprung has a stop
/// at 149 degrees. Limits of a kCone hold while the z axes are less than 120 degrees apart. kLock...: holds that axis.
/// kCone: of two swings with limits, `upper` are the half axes of an ellipse in which b's z axis stays. Their springs
/// and motors should be alike: beyond half of the ellipse those of x act along the swing, and those of y across it.
template <class S> struct SixAxisJoint : detail::SlidingJoint<S> {
  static constexpr JointType kType = JointType::six_axis;
  static constexpr std::uint32_t kFlags =
      joint_flag::kCollideConnected | joint_flag::kCone | joint_flag::kLockPoint | joint_flag::kLockTurns;
  static constexpr const char* kFlagNames = "of a six-axis joint kLock..., kCone, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE bool is_point(const JointProperties<S>& p) {
    return (p.flags & joint_flag::kLockPoint) == joint_flag::kLockPoint;
  }
  static ISO_INLINE bool is_free(const JointProperties<S>& p, std::uint32_t block) {
    return (p.flags & (block == 0 ? joint_flag::kLockPoint : joint_flag::kLockTurns)) == 0;
  }
  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;  // AxisDrives follow
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    const Mat3<Unit<S>> a = to_matrix(f.a);
    linearise_places(f, a, h, joint);
    detail::linearise_turns(f, a, h, joint);
  }
  /// Returns the distance [m] along the locked axes.
  static ISO_INLINE S error(const JointProperties<S>& p, const Pose<S>& a, const Pose<S>& b) {
    Vec3<S> between = transposed_times(to_matrix(a.orientation), b.position - a.position);
    for (std::uint32_t i = 0; i < 3; ++i) {
      if ((p.flags & joint_flag::kLockX << i) == 0) between[static_cast<int>(i)] = S(0);
    }
    return length(between);
  }

 private:
  static ISO_INLINE void linearise_places(const detail::JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h,
                                          JointConstraint<S>& joint) {
    const std::uint32_t flags = joint.properties.flags;
    JointBlock<S>& block = joint.blocks[0];
    if (is_point(joint.properties)) return detail::point_block(f, h, block);
    detail::empty_block(block);
    for (int i = 0; i < 3; ++i) {
      if ((flags & joint_flag::kLockX << i) == 0) continue;
      block.rows[i] = detail::slide_row(f, a.column(i), joint);
      block.error[i] = detail::bounded_error(dot(f.between, a.column(i)), h);
    }
    for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
      JointDrive<S>& drive = joint.drives[i];
      if (drive.block == 0) detail::set_way(f, a.column(static_cast<int>(drive.place)), *drive.asked, joint, drive);
    }
  }
};

}  // namespace isostep
