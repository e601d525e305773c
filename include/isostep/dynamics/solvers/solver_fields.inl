// The fields that each rigid solver leaves from stage to stage, by name: visit_scratch of rigid_solver.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/solvers/contact_fields.inl"
#include "isostep/dynamics/solvers/island_solver.hpp"
#include "isostep/dynamics/solvers/sequential.hpp"

namespace isostep {

template <class S> template <class Visit> void BodyRows<S>::visit_scratch(const Visit& visit, SolverStage stage) {
  if (stage == SolverStage::prepare || stage == SolverStage::store) return;
  visit("solver_velocity", rows_.velocity);
  visit("solver_displacement", rows_.displacement);
  const bool begun = stage == SolverStage::colour;
  if (begun) {
    visit("solver_mass", rows_.mass);
    visit("solver_start", start_);
  }
  for (std::size_t i = 0; i < turns_.size(); ++i) {  // the rest are those of other steps
    if ((kinds_[i] & body_kind::kTurns) == 0) continue;
    visit.one("solver_inertia", i, [&](const auto& of_body) {
      if (begun) of_body("moments", turns_[i].inertia);
      of_body("known", turns_[i].known);
    });
  }
}

template <class S> template <class Visit> void PreparedJoints<S>::visit_scratch(const Visit& visit, bool solved) {
  visit.each("joint_constraints", joints_.size(), [&](const auto& of_joint, std::size_t i) {
    JointConstraint<S>& joint = joints_[i];
    if (!solved) {
      of_joint("row_a", joint.row_a);
      of_joint("row_b", joint.row_b);
      of_joint("share", joint.share);
      of_joint("pose_a", joint.pose_a);
      of_joint("pose_b", joint.pose_b);
      of_joint("radius", joint.radius);
      of_joint("reach", joint.reach);
      of_joint("block_count", joint.block_count);
      of_joint("drive_count", joint.drive_count);
      of_joint("holds", joint.holds);
    }
    of_joint("point_impulse", joint.blocks[0].impulse);
    of_joint("angular_impulse", joint.blocks[1].impulse);
    of_joint.each("drives", joint.drive_count, [&](const auto& of_drive, std::size_t k) {
      JointDrive<S>& drive = joint.drives[k];
      if (!solved) {
        of_drive("radius", drive.radius);
        of_drive("bounded_below", drive.bounded_below);
        of_drive("bounded_above", drive.bounded_above);
        of_drive("sprung", drive.sprung);
        of_drive("driven", drive.driven);
        of_drive("servo", drive.servo);
        of_drive("force", drive.force);
      }
      of_drive("impulse", drive.impulse);
      of_drive("piece", drive.piece);
    });
  });
}

/// Visits the rows of every solver: joints and bodies.
template <class S, class Visit>
void visit_rows(const Visit& visit, SolverStage stage, PreparedJoints<S>& joints, BodyRows<S>& bodies) {
  if (stage == SolverStage::colour || stage == SolverStage::solve)
    joints.visit_scratch(visit, stage == SolverStage::solve);
  bodies.visit_scratch(visit, stage);
}

// ---- soft step and projected Gauss-Seidel

/// Visits the colours in the order of the contacts. The number of lanes of a run and of threads that share it are this
/// machine's own, and not visited.
template <class S>
template <class Visit>
void Sequential<S>::visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>&) {
  visit_rows(visit, stage, joints_, bodies_);
  if (stage == SolverStage::store) return;
  if (stage == SolverStage::colour) {
    visit("colours", bucket_);
    visit("order", order_);
    return;
  }
  const auto prepared = [&](const Run& run, std::uint32_t k) {
    const auto width = static_cast<std::uint32_t>(run.kernels->width);
    const auto points = static_cast<std::int32_t>(run.variant % kMaxContactPoints) + 1;
    const bool rolling = run.variant >= kMaxContactPoints;
    const std::size_t block = (k / width) * width * block_bytes<S, 1>(points, rolling);
    LaneOfBlock<S> lane(memory_.data() + run.offset + block, width, k % width, points, rolling);
    visit.one("prepared", order_[run.first + k],
              [&](const auto& of_contact) { lane.visit(of_contact, stage != SolverStage::prepare); });
    if constexpr (Visit::kEdits) lane.write_back();
  };
  for (const Run& run : runs_) {
    for (std::uint32_t k = 0; k < run.count; ++k) prepared(run, k);
  }
}

// ---- direct

template <class S>
template <class Visit>
void IslandSolver<S>::visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>& context) {
  visit_rows(visit, stage, joints_, bodies_);
  if (stage == SolverStage::store) return;
  if (stage != SolverStage::colour) {
    for (std::uint32_t c = 0; c < context.contacts.size(); ++c) {
      const auto points = static_cast<std::int32_t>(context.contacts[c].count);
      const bool rolling = context.geometry[c].material.rolling_resistance > S(0);
      LaneOfBlock<S> lane(memory_[c].bytes, 1, 0, points, rolling);
      visit.one("prepared", c, [&](const auto& of_contact) { lane.visit(of_contact, stage != SolverStage::prepare); });
      if constexpr (Visit::kEdits) lane.write_back();
    }
  }
  if (stage == SolverStage::prepare) return;
  visit.each("islands", island_count_, [&](const auto& of_island, std::size_t i) {
    Island& island = islands_[i];
    if (stage == SolverStage::colour) {
      of_island("joints", island.joints);
      of_island("contacts", island.contacts);
      of_island("bodies", island.bodies);
      of_island("joint_blocks", island.joint_blocks);
      of_island("contact_blocks", island.contact_blocks);
      return;
    }
    of_island("exponent", island.exponent);
    of_island.each("blocks", island.system->block_count(), [&](const auto& of_block, std::size_t block) {
      of_block("a", island.ends[block].a);
      of_block("b", island.ends[block].b);
      of_block.each("rows", 3, [&](const auto& of_row, std::size_t r) {
        IslandRow<N>& row = island.system->row(static_cast<std::uint32_t>(3 * block + r));
        of_row("bound", row.bound);
        if (row.bound == RowBound::absent) return;
        of_row("state", row.state);
        of_row("exponent", row.exponent);
        of_row("limit", row.limit);
        of_row("answer", row.answer);
      });
    });
  });
}

}  // namespace isostep
