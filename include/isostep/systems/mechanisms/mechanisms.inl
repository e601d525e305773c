// Bodies of mechanisms.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/mechanisms/mechanisms.hpp"

namespace isostep {

template <class S> void Mechanisms<S>::begin_step() {
  wheels_.begin_step();
  couplings_.begin_step();
  bodies_.clear();
  fastest_.clear();
  if (wheels_.any() || couplings_.any()) list_bodies();
}
template <class S> MechanismRows<S> Mechanisms<S>::rows() {
  if (!wheels_.any() && !couplings_.any()) return {};
  return {{&place, &solve, &close, &relax, &end}, this, couplings_.any(), bodies_};
}
template <class S> void Mechanisms<S>::end_step() {
  wheels_.end_step();
  couplings_.end_step();
}

template <class S> void Mechanisms<S>::list_bodies() {
  listed_.assign(state_.awake.states.size() + 1, 0);
  const auto list = [&](std::uint32_t row) { listed_[row] = 1; };
  wheels_.for_each_row(list);
  couplings_.for_each_row(list);
  for (std::uint32_t row = 1; row < listed_.size(); ++row) {
    if (listed_[row] == 0 || state_.awake.properties[row - 1].type != BodyType::dynamic) continue;
    bodies_.push_back(row);
    fastest_.push_back(convert<Velocity<S>>(detail::most_angular_speed(
                           detail::solid_box(map_, state_.awake.states[row - 1], state_.awake.properties[row - 1]))) *
                       Velocity<S>(2));
  }
}

/// Limits speeds to twice those that a body may have: once from the start of the step, once more from forces.
template <class S> void Mechanisms<S>::keep_in_range(SolverBodies<S>& bodies) const {
  const Velocity<S> most = convert<Velocity<S>>(Limits<S>::speed()) * Velocity<S>(2);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    MotionRow<Velocity<S>>& motion = bodies.velocity[bodies_[i]];
    motion.linear = held_within(motion.linear, most);
    motion.angular = held_within(motion.angular, fastest_[i]);
  }
}

template <class S> void Mechanisms<S>::place(void* mechanisms, SolverBodies<S>& bodies, std::int32_t rate) {
  Mechanisms& all = of(mechanisms);
  if (all.wheels_.any()) all.wheels_.place(bodies, rate);
  if (all.couplings_.any()) all.couplings_.place(bodies, rate);
  all.keep_in_range(bodies);
}
template <class S> void Mechanisms<S>::solve(void* mechanisms, SolverBodies<S>& bodies, int sweeps) {
  Mechanisms& all = of(mechanisms);
  all.wheels_.solve(sweeps);
  all.couplings_.solve(sweeps);
  all.keep_in_range(bodies);
}
template <class S> void Mechanisms<S>::close(void* mechanisms, SolverBodies<S>& bodies) {
  Mechanisms& all = of(mechanisms);
  all.couplings_.solve(kMechanismSweeps);
  all.keep_in_range(bodies);
}
template <class S> void Mechanisms<S>::relax(void* mechanisms, SolverBodies<S>& bodies) {
  Mechanisms& all = of(mechanisms);
  all.wheels_.relax();
  all.couplings_.relax();
  all.keep_in_range(bodies);
}
template <class S> void Mechanisms<S>::end(void* mechanisms) { of(mechanisms).wheels_.end(); }

}  // namespace isostep
