// Bodies of joint_tree.hpp that a step calls.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_alone.inl"
#include "isostep/dynamics/joints/joint_tension.hpp"
#include "isostep/dynamics/joints/joint_tree_batches.inl"
#include "isostep/dynamics/joints/joint_tree_drives.inl"

namespace isostep {

// ---- one batch

template <class S>
void JointTrees<S>::warm_start(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  const TreeRun<S> run = run_of(batch, step.bodies);
  batch.kernels->place(run, joints.data(), step);
  if (shapes_[batch.shape].written) write_rows(batch, run, joints, step);
  set_pieces(batch, run, joints, step);
  batch.kernels->warm_start(run, joints.data(), step);
}
template <class S>
void JointTrees<S>::solve(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step,
                          bool relax) {
  if (shapes_[batch.shape].drive_count > 0) return solve_driven(batch, joints, step, relax);
  if (relax) return batch.kernels->relax(run_of(batch, step.bodies), step);
  batch.kernels->solve(run_of(batch, step.bodies), step);
}
/// Returns the piece of a drive that is only a limit.
ISO_INLINE DrivePiece piece_of(const HeldLanes& held, std::uint32_t lane) {
  if ((held.below >> lane & 1u) != 0) return DrivePiece::lower;
  return (held.above >> lane & 1u) != 0 ? DrivePiece::upper : DrivePiece::free;
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
      if (of.stops) drive.piece = piece_of(run.held[d], lane);
      Velocity<S>& impulse = joint.blocks[drive.block].impulse[static_cast<int>(of.place)];
      drive.impulse = impulse;
      impulse = Velocity<S>(0);
    }
  }
}

// ---- joints one after another

/// Lists taut rows. A pulled arm turns back like a pendulum, with stiffness f.r about the axes across it.
template <class S> void JointTrees<S>::find_taut(std::span<const JointConstraint<S>> joints, const JointStep<S>& step) {
  taut_.clear();
  for (const std::uint32_t j : loose_) detail::add_tension(joints[j], *step.bodies, step.h, tension_, taut_);
}

template <class S> void JointTrees<S>::stiffen(const SolverBodies<S>& bodies) {
  for (const std::uint32_t row : taut_) {
    kappa_[row] = detail::stiffened(bodies.mass[row].kappa, tension_[row]);
    tension_[row] = Mat3<S>::diagonal(Vec3<S>::zero());
  }
}

template <class S> void JointTrees<S>::begin_loose(std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  for (const std::uint32_t j : loose_) {
    JointConstraint<S>& joint = joints[j];
    linearise_joint(joint, step);
    curve_joint(joint, step);
    kappa_[joint.row_a] = step.bodies->mass[joint.row_a].kappa;
    kappa_[joint.row_b] = step.bodies->mass[joint.row_b].kappa;
  }
  find_taut(joints, step);
  stiffen(*step.bodies);
  for (const std::uint32_t j : loose_) {
    weigh_joint(joints[j], kappa_[joints[j].row_a], kappa_[joints[j].row_b]);
    factor_joint(joints[j]);
  }
}

// ---- all of them

template <class S>
void JointTrees<S>::warm_start(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  if (batch < batches_.size()) return warm_start(batches_[batch], joints, step);
  begin_loose(joints, step);
  for (const Batch& odd : odd_batches_) warm_start(odd, joints, step);
  for (const std::uint32_t j : loose_) apply_impulses(joints[j], step);
}
template <class S>
void JointTrees<S>::solve(std::uint32_t batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step,
                          bool relax) {
  if (batch < batches_.size()) return solve(batches_[batch], joints, step, relax);
  for (int round = 0; round < (relax ? kLooseRelaxations : 1); ++round) {
    for (int sweep = 0; sweep < kLooseSweeps; ++sweep) {
      for (const std::uint32_t j : loose_) solve_joint(joints[j], step, relax);
    }
    for (const Batch& odd : odd_batches_) solve(odd, joints, step, relax);
  }
}
template <class S> void JointTrees<S>::store(std::uint32_t batch, std::span<JointConstraint<S>> joints) {
  if (batch < batches_.size()) return store(batches_[batch], joints);
  for (const Batch& odd : odd_batches_) store(odd, joints);
}

}  // namespace isostep
