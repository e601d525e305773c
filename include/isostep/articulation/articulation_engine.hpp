// The engine behind Articulation: its state, its scratch, and one step.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "isostep/articulation/articulation.hpp"
#include "isostep/articulation/free_motion.hpp"
#include "isostep/core/fault_log.hpp"

namespace isostep {

template <class S> struct Articulation<S>::Snapshot::Kept {
  std::shared_ptr<const detail::ArticulatedTree<S>> tree;
  ArticulationState<S> state;
};

template <class S> struct Articulation<S>::Engine {
  using Tree = detail::ArticulatedTree<S>;

  // State.
  std::shared_ptr<const Tree> tree = std::make_shared<Tree>();
  ArticulationState<S> state;
  // Scratch.
  detail::ArticulatedDynamics<S> links;
  detail::FreeMotion<S> free;
  std::vector<S> middle;           // speeds half a change later
  ArticulationState<S> before;     // the state at the start of a sub-step
  std::vector<LinkLoad<S>> loads;  // of joints, in the last sub-step
  FaultLog faults;

  void use(std::shared_ptr<const Tree> next);
  void refresh();
  FaultReport fault_of_link(std::uint32_t link) const;

  ArticulationReport step();
  void substep(ArticulationReport& report);
  void drift();
  void find_accelerations();
  void tell_loads();
  bool is_finite_now() const;
};

}  // namespace isostep
