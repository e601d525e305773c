// Universal joint: two points coincide, and x of one frame stays square to y of the other.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Hooke's joint: keeps origins together. x of a and y of b are the arms of its cross. Two shafts along z, bent by an
/// angle b, turn at speeds whose ratio goes from cos b to 1 / cos b twice a turn.
template <class S> struct UniversalJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::universal;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected;
  static constexpr const char* kFlagNames = "of a universal joint kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;
  }
  /// Symbols: d(x_a . y_b)/dt = (w_b - w_a) . (y_b x x_a).
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    const Vec3<Unit<S>> x = to_matrix(f.a).column(0), y = to_matrix(f.b).column(1);
    JointBlock<S>& block = joint.blocks[1];
    detail::empty_block(block);
    block.rows[2] = detail::angular_row<S>(cross(y, x), joint.radius);
    block.error.z = detail::bounded_error(joint.radius * dot(x, y), h);
  }
};

}  // namespace isostep
