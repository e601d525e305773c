// A joint's two frames at the present poses, and the rows that most kinds share.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault.hpp"
#include "isostep/dynamics/joints/joint.hpp"

namespace isostep::detail {

template <class S> struct JointFrames {
  Vec3<S> arm_a, arm_b;  // [m] from each centre to the frame's origin, world
  Vec3<S> between;       // [m] from a's origin to b's, world
  Quat<Unit<S>> a, b;    // frames to world
};

/// Computes the frames; orientations only if the kind needs them.
template <class S> ISO_INLINE JointFrames<S> joint_frames(const JointConstraint<S>& joint, const BodyState<S>* states) {
  const auto pose = [&](std::uint32_t row, const Pose<S>& fixed) ISO_INLINE_LAMBDA {
    return row == 0 ? fixed : Pose<S>{states[row - 1].centre, states[row - 1].orientation};
  };
  const Pose<S> a = pose(joint.row_a, joint.pose_a), b = pose(joint.row_b, joint.pose_b);
  const Pose<S>& in_a = joint.properties.frame_a;
  const Pose<S>& in_b = joint.properties.frame_b;
  JointFrames<S> f;
  f.a = f.b = Quat<Unit<S>>::identity();
  f.arm_a = to_matrix(a.orientation) * in_a.position;
  f.arm_b = to_matrix(b.orientation) * in_b.position;
  f.between = (b.position - a.position) + (f.arm_b - f.arm_a);  // large minus large first: exact in fixed point
  if (joint.block_count < 2 && joint.drive_count == 0) return f;
  f.a = a.orientation * in_a.orientation;
  f.b = b.orientation * in_b.orientation;
  return f;
}

/// [m] Returns the error that a row keeps, at most 32 m/s times h, so that its product with a bias rate fits.
template <class S> ISO_INLINE Velocity<S> bounded_error(S error, Step<S> h) {
  const S most = S(32) * h;
  return convert<Velocity<S>>(clamp(error, -most, most));
}

/// Returns an angular row about `axis`, whose speed is that at the joint's radius.
template <class S> ISO_INLINE JointRow<S> angular_row(Vec3<Unit<S>> axis, S radius) {
  const Vec3<S> angular = convert<S>(axis) * radius;
  return {Vec3<S>::zero(), angular, angular, Vec3<S>::zero(), Vec3<S>::zero()};
}

/// Fills rows with zeros, for equalities and drives to overwrite.
template <class S> ISO_INLINE void empty_block(JointBlock<S>& block) {
  block.point = false;
  for (JointRow<S>& row : block.rows) row = JointRow<S>::zero();
  block.error = Vec3<Velocity<S>>::zero();
}

/// Computes the rows that keep origins together.
template <class S> ISO_INLINE void point_block(const JointFrames<S>& f, Step<S> h, JointBlock<S>& block) {
  const Vec3<S> ra = f.arm_a, rb = f.arm_b, zero = Vec3<S>::zero();
  const S o = S(0), one = S(1);
  block.point = true;
  block.rows[0] = {{one, o, o}, {o, ra.z, -ra.y}, {o, rb.z, -rb.y}, zero, zero};
  block.rows[1] = {{o, one, o}, {-ra.z, o, ra.x}, {-rb.z, o, rb.x}, zero, zero};
  block.rows[2] = {{o, o, one}, {ra.y, -ra.x, o}, {rb.y, -rb.x, o}, zero, zero};
  block.error = {bounded_error(f.between.x, h), bounded_error(f.between.y, h), bounded_error(f.between.z, h)};
}

/// Returns b's frame relative to a's, on the half of the double cover with w >= 0.
template <class S> ISO_INLINE Quat<Unit<S>> relative_rotation(const JointFrames<S>& f) {
  const Quat<Unit<S>> q = conjugate(f.a) * f.b;
  if (q.w < Unit<S>(0)) return {-q.x, -q.y, -q.z, -q.w};
  return q;
}
/// [rad] Returns the angle about z of a rotation with w >= 0, at any swing.
template <class S> ISO_INLINE S twist_angle(Quat<Unit<S>> q) { return S(2) * atan2_to<S>(q.z, q.w); }

/// Counts the main drive, for kinds that allow it limits, a motor and a spring.
template <class S> ISO_INLINE void count_drive(JointConstraint<S>& joint) {
  const std::uint32_t flags = joint.properties.flags;
  JointDrive<S>& drive = joint.drives[0];
  joint.drive_count = (flags & (joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring)) != 0 ? 1 : 0;
  drive.bounded_below = drive.bounded_above = (flags & joint_flag::kLimit) != 0;
  drive.driven = (flags & joint_flag::kMotor) != 0;
  drive.sprung = (flags & joint_flag::kSpring) != 0;
}

/// Sets position, limits, target and speed of a drive from properties or an AxisDrive and an angle in (-pi, pi]. A
/// limited angle counts from the middle of its range, so that beyond a limit it is nearer to that one than to the
/// other. A spring's without limits counts from its target, to which it turns the shorter way: a jump of the stretch by
/// a turn would give energy on every round. A swing does not go round (`goes_round`): it comes back at half a turn.
template <class S, class Asked>
ISO_INLINE void set_angle(JointDrive<S>& drive, const Asked& p, S angle, bool goes_round = true) {
  const S radius = drive.radius, turn = S(6.283185307179586);
  if (drive.bounded_below || (drive.sprung && goes_round)) {
    const S from_middle = angle - (drive.bounded_below ? (p.lower + p.upper) * S(0.5) : p.spring_target);
    if (turn * S(0.5) < from_middle) angle -= turn;
    if (from_middle < turn * S(-0.5)) angle += turn;
  }
  drive.position = angle * radius;
  drive.lower = p.lower * radius;
  drive.upper = p.upper * radius;
  drive.target = p.spring_target * radius;
  drive.speed = round_to<Velocity<S>>(product(p.motor_speed, radius));
}

}  // namespace isostep::detail
