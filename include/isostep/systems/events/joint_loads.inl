// Bodies of joint_loads.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/events/contact_events.inl"
#include "isostep/systems/events/joint_loads.hpp"

namespace isostep {

template <class S> std::span<JointImpulse<S>> JointLoads<S>::impulses() {
  impulses_.clear();
  if (state_.records->joint_loads.all().empty()) return {};
  impulses_.assign(state_.joints.states.size(), JointImpulse<S>::zero());
  return impulses_;
}

/// Writes the load of a joint. Returns true if the load breaks it.
template <class S> bool JointLoads<S>::measure(const JointLoad<S>& load, JointLoadState<S>& state) const {
  const Location at = map_.joints.location(load.joint.slot);
  if (at.is_asleep()) return false;
  const JointImpulse<S>& impulse = impulses_[at.index];
  const JointProperties<S>& joint = state_.joints.properties[at.index];
  const auto mass_of = [&](std::uint32_t slot) { return detail::mass_of_row(state_, map_.row_of(slot)); };
  const S mass = reduced_mass(mass_of(joint.body_a), mass_of(joint.body_b)), hz = S(state_.settings.hz);
  const auto size_of = [&](Vec3<S> v) { return saturate_to<S>(product(mass, saturate_to<S>(product(length(v), hz)))); };
  state.force = size_of(impulse.linear);
  state.torque = size_of(impulse.angular);
  detail::keep_finite(state);
  const auto breaks = [](S limit, S size) { return S(0) < limit && limit < size; };
  return breaks(load.break_force, state.force) || breaks(load.break_torque, state.torque);
}

template <class S> void JointLoads<S>::update(Events<S>& events) {
  if (impulses_.empty()) return;
  broken_.clear();
  const auto& loads = state_.records->joint_loads;
  for (std::uint32_t slot = 0; slot < loads.all().size(); ++slot) {
    if (!loads.is_taken(slot)) continue;
    const JointLoad<S>& load = loads.all()[slot];
    JointLoadState<S>& state = state_.parts.joint_load_states[slot];
    if (!measure(load, state)) continue;
    const JointProperties<S>& joint = *map_.joints.properties_of(load.joint);
    const auto id = [](std::uint32_t body, std::uint32_t generation) {
      return body == kNoBody ? BodyId{} : BodyId{body, generation};
    };
    broken_.push_back({load.joint, id(joint.body_a, joint.generation_a), id(joint.body_b, joint.generation_b),
                       joint.user_data, state.force, state.torque});
  }
  for (const JointBroke<S>& broke : broken_) {
    events.joint_broke.push_back(broke);
    destruction_.destroy_joint(broke.joint.slot);
  }
}

}  // namespace isostep
