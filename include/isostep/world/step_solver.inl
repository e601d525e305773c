// Bodies of step_solver.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/solvers.inl"
#include "isostep/world/step_solver.hpp"

namespace isostep {

template <class S>
StepSolver<S>::StepSolver(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
    : state_(state), map_(map), forces_(state, map, proxies), mechanisms_(state, map, proxies) {}

namespace detail {
/// Sorts drives by joint, then by axis.
struct AxisDriveKey {
  template <class S> ISO_INLINE std::uint64_t operator()(const JointAxisDrive<S>& axis) const {
    return std::uint64_t{axis.joint} * kJointRows + static_cast<std::uint32_t>(axis.drive->axis);
  }
};
}  // namespace detail

template <class S> void StepSolver<S>::list_axis_drives() {
  axis_drives_.clear();
  const auto& records = state_.records->axis_drives;
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (!records.is_taken(slot)) continue;
    const AxisDrive<S>& drive = records.all()[slot];
    const Location at = map_.joints.location(drive.joint.slot);
    if (!at.is_asleep()) axis_drives_.push_back({at.index, &drive});
  }
  sorted_drives_.resize(axis_drives_.size());
  stable_sort(axis_drives_.data(), sorted_drives_.data(), static_cast<std::uint32_t>(axis_drives_.size()),
              detail::AxisDriveKey{});
}

template <class S>
StepContext<S> StepSolver<S>::context(std::span<const ContactGeometry<S>> geometry, std::span<const Carried<S>> carried,
                                      std::span<const ContactResponse<S>> responses,
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
  list_axis_drives();
  impulses_.resize(state_.contacts.size());
  cut_.assign(state_.awake.states.size(), 0);
  return {.states = state_.awake.states,
          .properties = state_.awake.properties,
          .accelerations = forces_.accelerations(),
          .contacts = state_.contacts,
          .geometry = geometry,
          .step_impulses = impulses_,
          .joint_properties = state_.joints.properties,
          .joint_states = state_.joints.states,
          .joint_ends = joint_ends_,
          .gravity = state_.settings.gravity,
          .hz = state_.settings.hz,
          .substeps = state_.settings.substeps,
          .watched = watched,
          .runner = tools.runner,
          .contact_kernels = tools.contact_kernels,
          .tree_kernels = tools.tree_kernels,
          .body_kernels = tools.body_kernels,
          .carried = carried,
          .forces = forces_.substeps(),
          .mechanisms = mechanisms_.rows(),
          .cut = cut_,
          .projection = state_.settings.projection,
          .restitution_threshold = convert<Velocity<S>>(state_.settings.restitution_threshold),
          .axis_drives = axis_drives_,
          .joint_impulses = joint_impulses,
          .responses = responses};
}

}  // namespace isostep
