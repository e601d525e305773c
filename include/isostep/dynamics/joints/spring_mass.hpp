// The mass of a joint's spring where none is named for it: that of the pair of its bodies, as the joint was made.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_couplings.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"

namespace isostep::detail {

/// Returns the frames of a joint whose frames coincide: a at its present pose, b moved to it. A spring between two
/// points draws them into line with the centres of their bodies, where it has no lever.
template <class S> ISO_INLINE JointFrames<S> frames_as_made(const JointConstraint<S>& joint) {
  const JointProperties<S>& p = joint.properties;
  const Vec3<S> zero = Vec3<S>::zero();
  JointFrames<S> f = {zero, zero, zero, joint.pose_a.orientation * p.frame_a.orientation, {}};
  f.b = f.a;
  if (joins_two_points(p.type)) return f;
  f.arm_a = to_matrix(joint.pose_a.orientation) * p.frame_a.position;
  f.arm_b = to_matrix(f.b * conjugate(p.frame_b.orientation)) * p.frame_b.position;
  return f;
}

/// Returns the kappa of b, turned with it to that pose.
template <class S> ISO_INLINE Mat3<S> kappa_as_made(const JointConstraint<S>& joint, const Mat3<S>& kappa_b) {
  const Quat<Unit<S>> made = joint.pose_a.orientation * joint.properties.frame_a.orientation;
  const Quat<Unit<S>> now = joint.pose_b.orientation * joint.properties.frame_b.orientation;
  const Mat3<Unit<S>> turn = to_matrix(made * conjugate(now));
  const Mat3<S> half = {{turn * kappa_b.rows[0], turn * kappa_b.rows[1], turn * kappa_b.rows[2]}};
  const Mat3<S> rows = transpose(half);
  return {{turn * rows.rows[0], turn * rows.rows[1], turn * rows.rows[2]}};
}

/// [1] Returns the inverse effective mass along a drive's row while all equalities of its joint hold, drives are free,
/// and the rest of the world is still. The joint must be factored.
template <class S> ISO_INLINE S felt_inverse(const JointConstraint<S>& joint, const JointRow<S>& row) {
  const auto with = [&](std::uint32_t block) ISO_INLINE_LAMBDA {
    const JointRow<S>(&rows)[3] = joint.blocks[block].rows;
    const auto entry = [&](int r) ISO_INLINE_LAMBDA {
      return saturate_to<Velocity<S>>(product(self_coupling(row, rows[r], joint.share), Velocity<S>(1)));
    };
    return Vec3<Velocity<S>>{entry(0), entry(1), entry(2)};
  };
  JointRows<S> moved = {with(0), Vec3<Velocity<S>>::zero()};
  if (joint.block_count > 1) moved.angular = with(1);
  const JointRows<S> held = substitute_joint(joint, moved);
  const S k = self_coupling(row, row, joint.share);
  const S taken = saturate_to<S>(dot_sum(moved.point, held.point) + dot_sum(moved.angular, held.angular));
  return max(k - taken, k * kLeastCompliance<S>);
}

/// Finds the strength of springs without a named mass, once a step, before the pieces of drives are known. It does not
/// depend on the joint's pose: a spring that followed the mass which it feels would give back more than it took where
/// that has grown.
template <class S>
ISO_INLINE void feel_springs(const SolverMass<S>& a, const SolverMass<S>& b, JointConstraint<S>& joint) {
  const auto feels = [](const JointDrive<S>& drive)
                         ISO_INLINE_LAMBDA { return (drive.sprung || drive.soft) && !(drive.spring_inverse > S(0)); };
  bool some = false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) some = some || feels(joint.drives[i]);
  if (!some) return;
  const JointFrames<S> frames = frames_as_made(joint);
  visit_joint_type(joint.properties.type, [&](auto kind) ISO_INLINE_LAMBDA {
    decltype(kind)::template Of<S>::linearise(frames, Step<S>(0), joint);
  });
  weigh_joint(joint, a.kappa, kappa_as_made(joint, b.kappa));
  factor_joint(joint);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    if (feels(joint.drives[i])) joint.drives[i].spring_inverse = felt_inverse(joint, joint.drives[i].row);
  }
}

}  // namespace isostep::detail
