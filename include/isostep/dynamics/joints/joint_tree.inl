// Bodies of joint_tree.hpp that a step calls.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_tension.hpp"
#include "isostep/dynamics/joints/joint_tree_batches.inl"
#include "isostep/dynamics/joints/joint_tree_drives.inl"

namespace isostep {

// ---- one batch

template <class S>
void JointTrees<S>::linearise(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  const TreeRun<S> run = run_of(batch, step.bodies);
  batch.kernels->place(run, joints.data(), step);
  if (shapes_[batch.shape].written) write_rows(batch, run, joints, step);
  batch.kernels->linearise(run, joints.data(), step);
}
template <class S>
void JointTrees<S>::warm_start(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  linearise(batch, joints, step);
  batch.kernels->warm_start(run_of(batch, step.bodies));
}
template <class S> void JointTrees<S>::solve(const Batch& batch, const JointStep<S>& step, bool relax) {
  if (relax) return batch.kernels->relax(run_of(batch, step.bodies), step);
  batch.kernels->solve(run_of(batch, step.bodies), step);
}
template <class S> void JointTrees<S>::store(const Batch& batch, std::span<JointConstraint<S>> joints) {
  const TreeRun<S> run = run_of(batch, nullptr);
  batch.kernels->store(run, joints.data());
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
    const TreeDrive& of = run.shape.drives[d];
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      if ((run.lanes >> lane & 1u) == 0) continue;
      JointConstraint<S>& joint = joints[run.joints[of.joint * width + lane]];
      JointDrive<S>& drive = joint.drives[of.index];
      drive.piece = detail::piece_of(run.drives[d].now, lane);
      Velocity<S>& impulse = joint.blocks[drive.block].impulse[static_cast<int>(of.place)];
      drive.impulse = impulse;
      impulse = Velocity<S>(0);
    }
  }
}

// ---- loose joints

/// Calls act(lanes of the joint, its ends by number, lane, row) for each moving end of a loose joint. `all`: in lanes
/// without a tree too.
template <class S>
template <class Act>
void JointTrees<S>::each_loose_end(const SolverBodies<S>& bodies, bool all, const Act& act) {
  for (const Batch& batch : loose_batches_) {
    const TreeRun<S> run = run_of(batch, nullptr);
    const auto width = static_cast<std::uint32_t>(batch.kernels->width);
    const LooseJointView<S> lanes(run.memory, run.shape, width);
    const TreeJoint& joint = run.shape.joints[0];
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      if (!all && (run.lanes >> lane & 1u) == 0) continue;
      const std::uint32_t a = run.rows[joint.body_a * width + lane], b = run.rows[joint.body_b * width + lane];
      if (bodies.moves(a)) act(lanes, true, joint.body_a, lane, a);
      if (bodies.moves(b)) act(lanes, false, joint.body_b, lane, b);
    }
  }
}

/// Adds up how hard loose joints pull at each body. A pulled arm turns back like a pendulum, with stiffness f.r about
/// the axes across it. No effect has less than the inverse of the largest moment of kappa, see gather_mass().
template <class S> void JointTrees<S>::share_tension(const SolverBodies<S>& bodies) {
  pull_.assign(bodies.mass.size(), S(0));
  bool any = false;
  const auto is_taut = [&](std::uint32_t row) {
    const Mat3<S>& kappa = bodies.mass[row].kappa;
    const S largest = max(kappa.rows[0].x, max(kappa.rows[1].y, kappa.rows[2].z));
    return product(S(0.5), S(1)) < product(largest, pull_[row]);
  };
  each_loose_end(bodies, false,
                 [&](const LooseJointView<S>& lanes, bool of_a, std::uint32_t, std::uint32_t lane, std::uint32_t row) {
                   pull_[row] = pull_[row] + lanes.pull(of_a, lane);
                   any = any || is_taut(row);
                 });
  if (!any) return;
  tension_.assign(bodies.mass.size(), Mat3<S>::diagonal(Vec3<S>::zero()));
  each_loose_end(bodies, false,
                 [&](const LooseJointView<S>& lanes, bool of_a, std::uint32_t, std::uint32_t lane, std::uint32_t row) {
                   const S pull = lanes.pull(of_a, lane);
                   if (!is_taut(row) || !(pull > S(0))) return;
                   const Vec3<S> arm = lanes.arm(of_a, lane);
                   const Direction<S> axis = direction_of(arm.x, arm.y, arm.z);
                   tension_[row] = tension_[row] + detail::across(Vec3<Unit<S>>{axis.x, axis.y, axis.z}, pull);
                 });
  each_loose_end(bodies, true,
                 [&](const LooseJointView<S>& lanes, bool, std::uint32_t body, std::uint32_t lane, std::uint32_t row) {
                   if (is_taut(row))
                     lanes.set_felt(body, lane, detail::stiffened(bodies.mass[row].kappa, tension_[row]));
                 });
}

// ---- all of them

template <class S>
void JointTrees<S>::warm_start(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  if (batch < batches_.size()) return warm_start(batches_[batch], joints, step);
  for (const Batch& odd : odd_batches_) warm_start(odd, joints, step);
  for (const Batch& loose : loose_batches_) linearise(loose, joints, step);
  share_tension(*step.bodies);
  for (const Batch& loose : loose_batches_) loose.kernels->warm_start(run_of(loose, step.bodies));
}
template <class S> void JointTrees<S>::solve(std::uint32_t batch, const JointStep<S>& step, bool relax) {
  if (batch < batches_.size()) return solve(batches_[batch], step, relax);
  for (int round = 0; round < (relax ? kLooseRelaxations : 1); ++round) {
    for (int sweep = 0; sweep < kLooseSweeps; ++sweep) {
      for (const Batch& loose : loose_batches_) solve(loose, step, relax);
    }
    for (const Batch& odd : odd_batches_) solve(odd, step, relax);
  }
}
template <class S> void JointTrees<S>::store(std::uint32_t batch, std::span<JointConstraint<S>> joints) {
  if (batch < batches_.size()) return store(batches_[batch], joints);
  for (const Batch& odd : odd_batches_) store(odd, joints);
  for (const Batch& loose : loose_batches_) store(loose, joints);
}

}  // namespace isostep
