// Angular joint: nothing turns, everything moves.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/slide_rows.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps orientations equal. Origins move freely.
template <class S> struct AngularJoint : detail::SlidingJoint<S> {
  static constexpr JointType kType = JointType::angular;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected;
  static constexpr const char* kFlagNames = "of an angular joint kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE bool is_free(const JointProperties<S>&, std::uint32_t block) { return block == 0; }
  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::empty_block(joint.blocks[0]);
    detail::weld_block(f, to_matrix(f.a), h, joint);
  }
  static ISO_INLINE S error(const JointProperties<S>&, const Pose<S>&, const Pose<S>&) { return S(0); }
};

}  // namespace isostep
