// Bodies of joint_tree.hpp that write, once a sub-step, what kernels read of joints that are more than points.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_drive_rows.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/joints/tree_lanes.hpp"

namespace isostep {

/// Writes rows, errors and laws of joints that are more than a point and have no stops. The lanes hold the impulses and
/// pieces already.
template <class S>
void JointTrees<S>::write_rows(const Batch& batch, const TreeRun<S>& run, std::span<JointConstraint<S>> joints,
                               const JointStep<S>& step) {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeNodeView<S> nodes(run.memory, run.shape, width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  for (std::uint32_t j = 0; j < run.shape.joints.size(); ++j) {
    const TreeJoint& of = run.shape.joints[j];
    if (of.stops != TreeJoint::kNoStops || (!of.turns && run.shape.nodes[of.node].is_point())) continue;
    const std::uint32_t which = run.stale[j];
    if (which == 0) continue;
    const TreeNode& first = run.shape.nodes[of.turns ? of.node - 1 : of.node];
    const TreeNode& last = run.shape.nodes[of.node];
    const std::uint32_t begin = first.first_drive, end = last.first_drive + last.drive_count;
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      if (((run.lanes & which) >> lane & 1u) == 0) continue;
      JointConstraint<S>& joint = joints[run.joints[j * width + lane]];
      for (std::uint32_t d = begin; d < end; ++d) {
        JointDrive<S>& drive = joint.drives[run.shape.drives[d].index];
        drive.impulse = view.impulse(d, lane);
        drive.piece = detail::piece_of(run.drives[d].now, lane);
      }
      if (joint.drive_count > 0 && joint.drives[0].sways) joint.blocks[0].impulse.x = nodes.impulse(of.node, 0, lane);
      linearise_joint(joint, step);
    }
    for (std::uint32_t d = begin; d < end; ++d) write_drive(batch, run, d, which, joints, step);
  }
}

/// Writes the present piece and law of a drive in some lanes, in those without a tree too.
template <class S>
void JointTrees<S>::write_drive(const Batch& batch, const TreeRun<S>& run, std::uint32_t d, std::uint32_t which,
                                std::span<const JointConstraint<S>> joints, const JointStep<S>& step) {
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> view(run.memory, run.shape, width);
  const TreeDrive& of = run.shape.drives[d];
  DriveLanes& lanes = run.drives[d];
  lanes.servos &= ~which;
  for (std::uint32_t lane = 0; lane < width; ++lane) {
    if ((which >> lane & 1u) == 0) continue;
    const JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
    detail::set_piece(lanes.now, lane, drive.piece);
    lanes.servos |= (drive.servo ? 1u : 0u) << lane;
    view.above_lower(d, lane) = drive.bounded_below ? drive.position - drive.lower : highest<S>();
    view.below_upper(d, lane) = drive.bounded_above ? drive.upper - drive.position : highest<S>();
    view.set_law(of.law, lane, drive, detail::most_impulse(drive, step.h));
  }
}

}  // namespace isostep
