// Distance joint: rod, rope or spring between two points.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_sway.hpp"
#include "isostep/dynamics/joints/slide_rows.hpp"

namespace isostep {

/// Keeps origins lower..upper apart (lower = upper: rod, lower = 0: rope). kSpring replaces that by a spring; with
/// kLimit both act. Two more drives act across it: joint_sway.hpp.
template <class S> struct DistanceJoint {
  static constexpr JointType kType = JointType::distance;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kSpring;
  static constexpr const char* kFlagNames = "of a distance joint kLimit, kSpring, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::length;
  static constexpr bool kTwoPoints = true;
  static constexpr bool kTwistAndSwing = false;

  static ISO_INLINE FaultReport fault(const JointProperties<S>& p) {
    if (p.lower < S(0)) return {Fault::bad_argument, "", "lower", "a length of 0 or more"};
    return {};
  }

  static ISO_INLINE bool is_point(const JointProperties<S>&) { return false; }
  static ISO_INLINE bool is_free(const JointProperties<S>& p, std::uint32_t) { return !is_rod(p); }
  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    const JointProperties<S>& p = joint.properties;
    joint.block_count = 1;
    joint.drive_count = 0;
    if (!is_rod(p)) {
      JointDrive<S>& drive = joint.drives[joint.drive_count++];
      drive.block = drive.place = 0;
      drive.push_speed = detail::kJointPushSpeed<S>;
      drive.bounded_below = is_bounded(p) && p.lower > S(0);
      drive.bounded_above = is_bounded(p);
      drive.sprung = (p.flags & joint_flag::kSpring) != 0;
    }
    detail::add_sways(joint);
  }
  /// Computes the row. Coincident points have no direction: y is taken, and a rod grows along it.
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    const Direction<S> d = direction_of(f.between.x, f.between.y, f.between.z);
    const Vec3<Unit<S>> unit =
        d.length > S(0) ? Vec3<Unit<S>>{d.x, d.y, d.z} : Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)};
    const JointProperties<S>& p = joint.properties;
    JointBlock<S>& block = joint.blocks[0];
    detail::empty_block(block);
    if (is_rod(p)) {
      block.rows[0] = detail::line_row(f, unit);
      block.error.x = detail::bounded_error(d.length - p.upper, h);
      return detail::set_sways(f, unit, d.length, h, joint.drives);
    }
    JointDrive<S>& drive = joint.drives[0];
    drive.row = detail::line_row(f, unit);
    drive.position = d.length;
    drive.lower = p.lower;
    drive.upper = p.upper;
    drive.target = p.spring_target;
    detail::set_sways(f, unit, d.length, h, joint.drives + 1);
  }

  static ISO_INLINE Vec3<Velocity<S>> pull(const JointConstraint<S>& joint) {
    const Vec3<Velocity<S>> of_rod = detail::pull_of_rows(joint);
    return is_rod(joint.properties) ? of_rod : of_rod + scaled(joint.drives[0].row.linear, joint.drives[0].impulse);
  }
  static ISO_INLINE S error(const JointProperties<S>& p, const Pose<S>& a, const Pose<S>& b) {
    const S apart = distance(a.position, b.position);
    return is_bounded(p) ? max(S(0), max(apart - p.upper, p.lower - apart)) : S(0);
  }

  /// Returns true if the length is limited: without a spring, even without the flag.
  static ISO_INLINE constexpr bool is_bounded(const JointProperties<S>& p) {
    return (p.flags & joint_flag::kLimit) != 0 || (p.flags & joint_flag::kSpring) == 0;
  }

 private:
  static ISO_INLINE constexpr bool is_rod(const JointProperties<S>& p) { return is_bounded(p) && !(p.lower < p.upper); }
};

}  // namespace isostep
