// Bodies of step_solver.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/solvers.inl"
#include "isostep/world/step_solver.hpp"

namespace isostep {

template <class S>
StepSolver<S>::StepSolver(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
    : state_(state), map_(map), forces_(state, map, proxies) {}

template <class S>
StepContext<S> StepSolver<S>::context(std::span<const ContactGeometry<S>> geometry, std::span<const Carried<S>> carried,
                                      std::span<JointImpulse<S>> joint_impulses, const StepTools<S>& tools,
                                      bool watched) {
  joint_ends_.resize(state_.joints.properties.size());
  for (std::size_t i = 0; i < joint_ends_.size(); ++i) {
    const JointProperties<S>& joint = state_.joints.properties[i];
    // With nothing that moves at either end a joint holds nothing.
    const bool holds = map_.is_enabled(joint);
    const auto end_at = [&](std::uint32_t slot) {
      return JointEnd<S>{holds ? map_.row_of(slot) : 0, map_.centre_pose_at(slot)};
    };
    joint_ends_[i] = {end_at(joint.body_a), end_at(joint.body_b)};
  }
  impulses_.resize(state_.contacts.size());
  cut_.assign(state_.awake.states.size(), 0);
  return {state_.awake.states,
          state_.awake.properties,
          forces_.accelerations(),
          state_.contacts,
          geometry,
          impulses_,
          state_.joints.properties,
          state_.joints.states,
          joint_ends_,
          state_.settings.gravity,
          state_.settings.hz,
          state_.settings.substeps,
          watched,
          tools.runner,
          tools.contact_kernels,
          tools.tree_kernels,
          carried,
          forces_.substeps(),
          cut_,
          state_.settings.projection,
          convert<Velocity<S>>(state_.settings.restitution_threshold),
          joint_impulses};
}

}  // namespace isostep
