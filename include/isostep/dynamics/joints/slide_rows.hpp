// Rows of joints along which b's origin moves in frame a, and what such joints have in common.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// Returns the row of b's origin against a, along an axis that turns with a. Far from a's origin the arm on a counts as
/// joint.reach, so that the entries of K fit: the impulse then turns a too little.
/// Symbols: with n the axis and u = `between`: d(n . u)/dt = n . (v_b + w_b x r_b - v_a) - w_a . ((r_a + u) x n).
template <class S>
ISO_INLINE JointRow<S> slide_row(const JointFrames<S>& f, Vec3<Unit<S>> axis, const JointConstraint<S>& joint) {
  const Vec3<S> zero = Vec3<S>::zero(), arm_a = f.arm_a + held_within(f.between, joint.reach);
  return {convert<S>(axis), cross(arm_a, axis), cross(f.arm_b, axis), zero, zero};
}

/// Computes the rows that keep origins together in all but the direction z of a.
template <class S>
ISO_INLINE void line_block(const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h, JointConstraint<S>& joint) {
  JointBlock<S>& block = joint.blocks[0];
  empty_block(block);
  for (const int i : {0, 1}) {
    block.rows[i] = slide_row(f, a.column(i), joint);
    block.error[i] = bounded_error(dot(f.between, a.column(i)), h);
  }
}

/// Counts the drive of a joint along z of a.
template <class S> ISO_INLINE void count_slide(JointConstraint<S>& joint) {
  count_drive(joint);
  joint.drives[0].block = 0;
  joint.drives[0].push_speed = kJointPushSpeed<S>;
}
/// Sets the drive along an axis of a, as properties or an AxisDrive ask for it.
template <class S, class Asked>
ISO_INLINE void set_way(const JointFrames<S>& f, Vec3<Unit<S>> axis, const Asked& p, const JointConstraint<S>& joint,
                        JointDrive<S>& drive) {
  drive.row = slide_row(f, axis, joint);
  drive.position = dot(f.between, axis);
  drive.lower = p.lower;
  drive.upper = p.upper;
  drive.target = p.spring_target;
  drive.speed = convert<Velocity<S>>(p.motor_speed);
}
template <class S>
ISO_INLINE void linearise_slide(const JointFrames<S>& f, const Mat3<Unit<S>>& a, JointConstraint<S>& joint) {
  if (joint.drive_count > 0) set_way(f, a.column(2), joint.properties, joint, joint.drives[0]);
}

/// [m/s] Returns the pull of the first block's equalities on b, world.
template <class S> ISO_INLINE Vec3<Velocity<S>> pull_of_rows(const JointConstraint<S>& joint) {
  const JointBlock<S>& block = joint.blocks[0];
  return combine(block.rows[0].linear, block.rows[1].linear, block.rows[2].linear, block.impulse);
}

/// The base of joints whose origins move against each other. PointJoint is the base of the others.
template <class S> struct SlidingJoint {
  static constexpr bool kTwoPoints = false;
  static constexpr bool kTwistAndSwing = false;

  static ISO_INLINE FaultReport fault(const JointProperties<S>&) { return {}; }
  static ISO_INLINE bool is_point(const JointProperties<S>&) { return false; }
  static ISO_INLINE bool is_free(const JointProperties<S>&, std::uint32_t) { return false; }
  static ISO_INLINE Vec3<Velocity<S>> pull(const JointConstraint<S>& joint) { return pull_of_rows(joint); }
  /// Returns the distance off a's z axis [m].
  static ISO_INLINE S error(const JointProperties<S>&, const Pose<S>& a, const Pose<S>& b) {
    const Vec3<S> between = transposed_times(to_matrix(a.orientation), b.position - a.position);
    return direction_of(between.x, between.y, S(0)).length;
  }
};

}  // namespace isostep::detail
