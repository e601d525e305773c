// Planar joint: b stays in the plane x y of a; the angle about z may be limited, driven and sprung.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/slide_rows.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps b's origin in the plane x y of a, and their z axes parallel: a puck on a table. kLimit, kMotor and kSpring act
/// on the angle about z.
template <class S> struct PlanarJoint : detail::SlidingJoint<S> {
  static constexpr JointType kType = JointType::planar;
  static constexpr std::uint32_t kFlags =
      joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
  static constexpr const char* kFlagNames = "of a planar joint kLimit, kMotor, kSpring, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    detail::count_drive(joint);
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    const Mat3<Unit<S>> a = to_matrix(f.a);
    JointBlock<S>& block = joint.blocks[0];
    detail::empty_block(block);
    block.rows[2] = detail::slide_row(f, a.column(2), joint);
    block.error.z = detail::bounded_error(dot(f.between, a.column(2)), h);
    detail::axle_block(f, a, h, joint);
    detail::linearise_turn(f, a, joint);
  }
  /// Returns the distance off the plane [m].
  static ISO_INLINE S error(const JointProperties<S>&, const Pose<S>& a, const Pose<S>& b) {
    return abs(dot(b.position - a.position, to_matrix(a.orientation).column(2)));
  }
};

}  // namespace isostep
