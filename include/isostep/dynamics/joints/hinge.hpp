// Hinge: points and z axes coincide; the angle about z may be limited, driven and sprung.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps origins and z axes together. kLimit, kMotor and kSpring act on the angle about z.
template <class S> struct HingeJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::hinge;
  static constexpr std::uint32_t kFlags =
      joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
  static constexpr const char* kFlagNames = "of a hinge kLimit, kMotor, kSpring, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;
  static constexpr bool kTwistAndSwing = true;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    detail::count_drive(joint);
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    const Mat3<Unit<S>> a = to_matrix(f.a);
    detail::axle_block(f, a, h, joint);
    detail::linearise_turn(f, a, joint);
  }
};

}  // namespace isostep
