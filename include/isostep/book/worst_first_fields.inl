// The scratch of worst_first from stage to stage, by name: visit_scratch of rigid_solver.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "isostep/book/worst_first.hpp"
#include "isostep/dynamics/solvers/solver_fields.inl"

namespace isostep {

template <class S, class Queue>
template <class Visit>
void WorstFirstResolver<S, Queue>::visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>&) {
  visit_rows(visit, stage, joints_, bodies_);
  if (stage == SolverStage::colour) {
    visit("points", points_);
    visit("rolling", rolling_);
    visit("held_joints", held_);
    visit("ends", ends_);
    visit("neighbours", std::span(neighbours_.data(), first_[bodies_.rows().mass.size()]));
  }
  if (stage != SolverStage::solve) return;
  visit("islands_left", islands_left_);
  visit.each("points", points_.size(), [&](const auto& of_point, std::size_t i) {
    Point& point = points_[i];
    of_point("contact", point.contact);
    of_point("impulse", point.impulse);
    of_point("total_impulse", point.total_impulse);
    of_point("least_speed", point.least_speed);
    of_point("friction_impulse", point.friction.impulse);
  });
}

}  // namespace isostep
