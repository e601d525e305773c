// Fixed joint: two frames coincide, as if welded.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {

/// Keeps both frames equal.
template <class S> struct FixedJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::fixed;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected;
  static constexpr const char* kFlagNames = "of a fixed joint kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    detail::weld_block(f, to_matrix(f.a), h, joint);
  }
};

}  // namespace isostep
