// Bodies of joint_tree.hpp that follow the laws of drives: what kernels leave to them between passes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_drive_rows.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/joints/tree_lanes.hpp"

namespace isostep {

/// Calls act(drive of the shape, its number, lane, whether the lane has a tree), except for joints with stops.
template <class S>
template <class Act>
void JointTrees<S>::each_drive(const Batch& batch, const TreeRun<S>& run, const Act& act) const {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
    const TreeDrive& drive = run.shape.drives[d];
    if (drive.stops) continue;
    for (std::uint32_t lane = 0; lane < width; ++lane) act(drive, d, lane, (run.lanes >> lane & 1u) != 0);
  }
}

/// Writes rows, errors and springs of joints that are more than a point and have no stops. The lanes hold a rod's pull
/// already.
template <class S>
void JointTrees<S>::write_rows(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                               const JointStep<S>& step) {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeNodeView<S> nodes(run.memory, run.shape, width);
  for (std::uint32_t j = 0; j < run.shape.joints.size(); ++j) {
    const TreeJoint& of = run.shape.joints[j];
    if (of.stops != TreeJoint::kNoStops || (!of.turns && run.shape.nodes[of.node].is_point())) continue;
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      if ((run.lanes >> lane & 1u) == 0) continue;
      JointConstraint<S>& joint = joints[run.joints[j * width + lane]];
      if (joint.drive_count > 0 && joint.drives[0].sways) joint.blocks[0].impulse.x = nodes.impulse(of.node, 0, lane);
      linearise_joint(joint, step);
    }
  }
}

/// Sets impulses, scales and yielding of the drives' present pieces, and which nodes idle.
template <class S>
void JointTrees<S>::set_pieces(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                               const JointStep<S>& step) {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  std::uint32_t* const idle = run.idle;
  for (std::size_t n = 0; n < run.shape.nodes.size(); ++n) idle[n] = run.shape.nodes[n].may_idle ? 0xffffffffu : 0u;
  each_drive(batch, run, [&](const TreeDrive& of, std::size_t d, std::uint32_t lane, bool) {
    JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
    const bool fixed = detail::fixes_speed(drive.piece), yields = detail::springs(drive, drive.piece);
    const S share = convert<S>(drive.spring_row.x);
    view.scale(d, lane) = fixed ? Unit<S>(1) : yields ? drive.spring_row.y : Unit<S>(0);
    view.give(d, lane) = yields ? share * share : S(0);
    if (fixed || yields) idle[of.node] &= ~(1u << lane);
    else drive.impulse = detail::motor_impulse(drive.piece, detail::most_impulse(drive, step.h));
    view.impulse(d, lane) = drive.impulse;
  });
}

/// Sets the speeds between which limits leave drives in a pass, for any pieces.
template <class S>
void JointTrees<S>::bound_drives(const Batch& batch, const TreeRun<S>& run, std::span<const JointConstraint<S>> joints,
                                 const JointStep<S>& step, bool relax) const {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  each_drive(batch, run, [&](const TreeDrive& of, std::size_t d, std::uint32_t lane, bool) {
    const JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
    const DriveBounds<S> bounds = detail::bounds_of(drive, step, relax);
    view.low(d, lane) = bounds.low;
    view.high(d, lane) = bounds.high;
  });
}

template <class S>
void JointTrees<S>::ask_drives(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                               const JointStep<S>& step) const {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  each_drive(batch, run, [&](const TreeDrive& of, std::size_t d, std::uint32_t lane, bool) {
    JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
    drive.impulse = view.impulse(d, lane);
    const Velocity<S> speed = round_to<Velocity<S>>(product(view.scale(d, lane), view.speed(d, lane)));
    const DriveBounds<S> bounds = {view.low(d, lane), view.high(d, lane)};
    view.right(d, lane) = detail::drive_right_side(drive, speed, bounds, detail::most_impulse(drive, step.h));
  });
}

/// Returns true if a drive is off its piece of the law; sets `next` to the piece to try. Without `may_hold` only drives
/// count that hold a speed and should not: they let go, and the pass ends.
template <class S>
bool JointTrees<S>::judge_drives(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                                 const JointStep<S>& step, bool may_hold) const {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  const TreeNodeView<S> nodes(run.memory, run.shape, width);
  bool off = false;
  each_drive(batch, run, [&](const TreeDrive& of, std::size_t d, std::uint32_t lane, bool has_tree) {
    if (!has_tree) return;
    JointConstraint<S>& joint = joints[run.joints[of.joint * width + lane]];
    JointDrive<S>& drive = joint.drives[of.index];
    drive.impulse = view.impulse(d, lane);
    if (drive.sways) {
      if (of.index == 0) joint.blocks[0].impulse.x = nodes.impulse(of.node, 0, lane);
      off = detail::judge_sway(joint, drive, may_hold) || off;
      return;
    }
    const DriveBounds<S> bounds = {view.low(d, lane), view.high(d, lane)};
    off = detail::judge_drive(drive, view.speed(d, lane), bounds, step.h, may_hold) || off;
  });
  return off;
}

/// Solves with drives on their present pieces, and again as long as one is off its piece. Trees on their pieces repeat
/// the same computation.
template <class S>
void JointTrees<S>::solve_driven(const Batch& batch, std::span<JointConstraint<S>> joints, const JointStep<S>& step,
                                 bool relax) {
  const TreeKernels<S>& kernels = *batch.kernels;
  const TreeRun<S> run = run_of(batch, step.bodies);
  const auto width = static_cast<std::uint32_t>(kernels.width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  kernels.begin(run);
  bound_drives(batch, run, joints, step, relax);
  for (int changes = 0;; ++changes) {
    if (relax) kernels.find_relaxed_right_sides(run, step);
    else kernels.find_right_sides(run, step);
    ask_drives(batch, run, joints, step);
    kernels.substitute(run);
    const bool may_hold = changes < detail::kMostPieceChanges;
    const bool of_stops = (relax ? kernels.judge_relaxed : kernels.judge)(run, step, may_hold);
    if (!judge_drives(batch, run, joints, step, may_hold) && !of_stops) break;
    kernels.restore(run);
    each_drive(batch, run, [&](const TreeDrive& of, std::size_t d, std::uint32_t lane, bool) {
      JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
      drive.piece = drive.next;
      drive.impulse = view.impulse(d, lane);
    });
    set_pieces(batch, run, joints, step);
    kernels.resume(run);
  }
  kernels.end(run);
}

}  // namespace isostep
