// A joint solved by itself, all of its rows at once.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint.inl"
#include "isostep/dynamics/joints/row_factors.hpp"

namespace isostep {

/// Eliminates angles and drives first. A long arm makes the point's entries large, and their rest is near one again
/// once the body may not turn. In the other order a fixed-point format loses every digit of them.
template <class S> void factor_joint(JointConstraint<S>& joint) {
  couple_blocks(joint);
  JointBlock<S>& point = joint.blocks[0];
  if (joint.block_count > 1) {
    JointBlock<S>& angular = joint.blocks[1];
    const SymmetricFactors<S> factors = factor_block(angular, detail::kBlockCompliance<S>);
    angular.inverse = factors.inverse();
    const Mat3<S> k = scaled_by(detail::block_coupling(angular, true, point, true), joint.share.a) +
                      scaled_by(detail::block_coupling(angular, false, point, false), joint.share.b);
    joint.down = transpose(k);
    joint.up = factors.solve(k);
    subtract(point.coupling, joint.down * joint.up);
  }
  point.inverse = factor_block(point, detail::kBlockCompliance<S>).inverse();
}

template <class S> JointRows<S> substitute_joint(const JointConstraint<S>& joint, JointRows<S> right) {
  if (joint.block_count < 2) return {impulses(joint.blocks[0].inverse, right.point), Vec3<Velocity<S>>::zero()};
  const Vec3<Velocity<S>> angular = impulses(joint.blocks[1].inverse, right.angular);
  const Vec3<Velocity<S>> point = impulses(joint.blocks[0].inverse, less_moved(right.point, joint.down, angular));
  return {point, angular - impulses(joint.up, point)};
}

template <class S> void solve_joint(JointConstraint<S>& joint, const JointStep<S>& step, bool relax) {
  if (!joint.holds) return;
  const Softness<S> soft = relax ? Softness<S>::rigid() : step.softness;
  const JointStart<S> start = start_of(joint, *step.bodies);
  for (int changes = 0;; ++changes) {
    const JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
    JointRows<S> right = {right_side(joint, 0, m, step, relax), Vec3<Velocity<S>>::zero()};
    if (joint.block_count > 1) right.angular = right_side(joint, 1, m, step, relax);
    const JointRows<S> change = substitute_joint(joint, right);
    push_joint(joint, change, soft, *step.bodies);
    if (!judge_drives(joint, step, relax, changes < detail::kMostPieceChanges)) return;
    restart_joint(joint, start, *step.bodies);
    change_pieces(joint, step);
    factor_joint(joint);
  }
}

template <class S> void warm_start_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  for (JointConstraint<S>& joint : joints) {
    if (!joint.holds) continue;
    linearise_joint(joint, step);
    curve_joint(joint, step);
    weigh_joint(joint, step.bodies->mass[joint.row_a].kappa, step.bodies->mass[joint.row_b].kappa);
    factor_joint(joint);
    apply_impulses(joint, step);
  }
}

template <class S> void solve_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step, bool relax) {
  for (JointConstraint<S>& joint : joints) solve_joint(joint, step, relax);
}

}  // namespace isostep
