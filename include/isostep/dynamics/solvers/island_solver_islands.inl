// IslandSolver: which constraints are solved together, and how many blocks each takes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/island_solver.hpp"

namespace isostep {

template <class S> bool IslandSolver<S>::rolls(const StepContext<S>& context, std::uint32_t c) {
  return context.geometry[c].material.rolling_resistance > S(0);
}

template <class S>
typename IslandSolver<S>::Island& IslandSolver<S>::island_of(std::uint32_t row_a, std::uint32_t row_b) {
  const std::uint32_t set = sets_.find(bodies_.rows().moves(row_a) ? row_a : row_b);
  if (island_of_[set] == 0) {
    if (island_count_ == islands_.size()) islands_.emplace_back();
    Island& island = islands_[island_count_++];
    island_of_[set] = island_count_;
    for (auto* list : {&island.joints, &island.contacts, &island.bodies, &island.joint_blocks, &island.contact_blocks})
      list->clear();
    island.ends.clear();
    island.exponent = 0;
    island.begun = false;
    island.unsolved = island.pushed = false;
    island.system.choose(method_);
    island.system->begin();
  }
  Island& island = islands_[island_of_[set] - 1];
  for (const std::uint32_t row : {row_a, row_b}) {
    if (!bodies_.rows().moves(row) || local_[row] != 0) continue;
    island.bodies.push_back(row);
    local_[row] = static_cast<std::uint32_t>(island.bodies.size());
  }
  return island;
}

template <class S>
std::uint32_t IslandSolver<S>::add_blocks(Island& island, std::uint32_t row_a, std::uint32_t row_b,
                                          std::uint32_t count) {
  const std::uint32_t first = island.system->block_count();
  const auto& mass = bodies_.rows().mass;
  const Value a = System::value(mass[row_a].mass), b = System::value(mass[row_b].mass);
  Value reduced = bodies_.rows().moves(row_a) ? a : b;
  if (bodies_.rows().moves(row_a) && bodies_.rows().moves(row_b)) {
    reduced = System::quotient(System::product(a, b), System::sum(a, b));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    island.system->add_block(local_[row_a], local_[row_b]);
    island.ends.push_back({row_a, row_b, reduced});
  }
  return first;
}

template <class S> void IslandSolver<S>::add_joint(const JointConstraint<S>& joint, std::uint32_t j) {
  if (!joint.holds || joint.block_count + joint.drive_count == 0) return;
  Island& island = island_of(joint.row_a, joint.row_b);
  island.joints.push_back(j);
  island.joint_blocks.push_back(add_blocks(island, joint.row_a, joint.row_b, joint.block_count + joint.drive_count));
}

/// Adds a contact: a block of tangents and twist, blocks of three points, and one for two rows of rolling resistance.
template <class S> void IslandSolver<S>::add_contact(const StepContext<S>& context, std::uint32_t c) {
  const ContactGeometry<S>& g = context.geometry[c];
  if (!bodies_.rows().moves(g.row_a) && !bodies_.rows().moves(g.row_b)) return;
  const std::uint32_t points = context.contacts[c].count, own = 1 + (points + 2) / 3;
  Island& island = island_of(g.row_a, g.row_b);
  const std::uint32_t first = add_blocks(island, g.row_a, g.row_b, own + (rolls(context, c) ? 1 : 0));
  island.contacts.push_back(c);
  island.contact_blocks.push_back(first);
  IslandPatch<N> patch = {};
  patch.first = 3 * first;
  patch.normal = 3 * first + 3;
  patch.points = points;
  patch.rolling = rolls(context, c) ? 3 * (first + own) : IslandPatch<N>::kNoRolling;
  island.system->patches().push_back(patch);
}

template <class S> void IslandSolver<S>::find_islands(const StepContext<S>& context) {
  const SolverBodies<S>& bodies = bodies_.rows();
  sets_.begin(bodies.mass.size());
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (bodies.moves(a) && bodies.moves(b)) sets_.join(a, b);
  };
  for (const JointConstraint<S>& joint : joints_.all()) {
    if (joint.holds) join(joint.row_a, joint.row_b);
  }
  for (const ContactGeometry<S>& g : context.geometry) join(g.row_a, g.row_b);
  island_of_.assign(bodies.mass.size(), 0);
  local_.assign(bodies.mass.size(), 0);
  island_count_ = 0;
  for (std::uint32_t j = 0; j < joints_.size(); ++j) add_joint(joints_[j], j);
  for (std::uint32_t c = 0; c < context.contacts.size(); ++c) add_contact(context, c);
  for (const std::uint32_t row : context.mechanisms.bodies) {
    if (local_[row] != 0) islands_[island_of_[sets_.find(row)] - 1].pushed = true;
  }
  for (std::uint32_t i = 0; i < island_count_; ++i) {
    Island& island = islands_[i];
    island.shapes.resize(3 * island.system->block_count());
    island.asked.resize(3 * island.system->block_count());
    island.work_left = kMostWork * static_cast<std::uint64_t>(context.substeps);
    island.solves_left = 2 * static_cast<std::uint32_t>(context.substeps);
    island.system.tie(static_cast<std::uint32_t>(island.bodies.size()), island.work_left / island.solves_left);
  }
}

}  // namespace isostep
