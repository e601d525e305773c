// A joint for the tests alone: a slider, as a file in joints/ would declare it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/fixed.hpp"

namespace isostep {

/// b slides along z of frame a and turns with it.
template <class S> struct ProbeJoint {
  static constexpr JointType kType = JointType::probe;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected;
  static constexpr const char* kFlagNames = "of a probe kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::length;
  static constexpr bool kTwoPoints = false;
  static constexpr bool kTwistAndSwing = false;

  static ISO_INLINE FaultReport fault(const JointProperties<S>&) { return {}; }
  static ISO_INLINE bool is_point(const JointProperties<S>&) { return false; }
  static ISO_INLINE bool is_free(const JointProperties<S>&, std::uint32_t) { return false; }

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    joint.block_count = 2;
    joint.drive_count = 0;
  }
  /// Symbols: x and y of frame a stand across the way; b's origin is at arm_a + between from a's centre.
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    FixedJoint<S>::linearise(f, h, joint);  // for its angular block
    const Mat3<Unit<S>> a = to_matrix(f.a);
    const Vec3<S> zero = Vec3<S>::zero(), along = transposed_times(a, f.between);
    JointBlock<S>& block = joint.blocks[0];
    detail::empty_block(block);
    for (int i = 0; i < 2; ++i) {
      const Vec3<Unit<S>> n = a.column(i);
      block.rows[i] = {convert<S>(n), cross(f.arm_a + f.between, n), cross(f.arm_b, n), zero, zero};
      block.error[i] = detail::bounded_error(along[i], h);
    }
  }

  static ISO_INLINE Vec3<Velocity<S>> pull(const JointConstraint<S>& joint) {
    const JointBlock<S>& block = joint.blocks[0];
    return scaled(block.rows[0].linear, block.impulse.x) + scaled(block.rows[1].linear, block.impulse.y);
  }
  static ISO_INLINE S error(const JointProperties<S>&, const Pose<S>& a, const Pose<S>& b) {
    const Vec3<S> along = transposed_times(to_matrix(a.orientation), b.position - a.position);
    return direction_of(along.x, along.y, S(0)).length;
  }
};

}  // namespace isostep
