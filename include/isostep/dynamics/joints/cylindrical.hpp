// Cylindrical joint: z axes coincide; the way along z may be limited, driven and sprung, the turn about it is free.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/slide_rows.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Lets b move along z of a and turn about it, as a bolt in its sleeve. kLimit, kMotor and kSpring act along z.
template <class S> struct CylindricalJoint : detail::SlidingJoint<S> {
  static constexpr JointType kType = JointType::cylindrical;
  static constexpr std::uint32_t kFlags =
      joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
  static constexpr const char* kFlagNames = "of a cylindrical joint kLimit, kMotor, kSpring, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::length;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    detail::count_slide(joint);
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    const Mat3<Unit<S>> a = to_matrix(f.a);
    detail::line_block(f, a, h, joint);
    detail::axle_block(f, a, h, joint);
    detail::linearise_slide(f, a, joint);
  }
};

}  // namespace isostep
