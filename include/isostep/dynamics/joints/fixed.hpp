// Fixed joint: two frames coincide, as if welded.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"

namespace isostep {

/// Frames coincide.
template <class S> struct FixedJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::fixed;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected;
  static constexpr const char* kFlagNames = "of a fixed joint kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;
  static constexpr bool kDrivesAlone = false;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;
  }
  /// Symbols: 2 (x, y, z) of the relative rotation is the error angle to first order, in a's axes.
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    const Mat3<Unit<S>> a = to_matrix(f.a);
    const Quat<Unit<S>> q = detail::relative_rotation(f);
    const S twice = S(2) * joint.radius;
    JointBlock<S>& block = joint.blocks[1];
    block.point = false;
    for (int i = 0; i < 3; ++i) block.rows[i] = detail::angular_row<S>(a.column(i), joint.radius);
    block.error = {detail::bounded_error(twice * q.x, h), detail::bounded_error(twice * q.y, h),
                   detail::bounded_error(twice * q.z, h)};
  }
};

}  // namespace isostep
