// Bodies of joint_map.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/store/joint_map.hpp"

namespace isostep {

template <class S> const JointProperties<S>* JointMap<S>::properties_of(JointId joint) const {
  if (!state_.joint_slots.holds(joint)) return nullptr;
  const Location at = locations_[joint.slot];
  const JointSet<S>& set = at.is_asleep() ? state_.sleeping[at.set]->joints : state_.joints;
  return &set.properties[at.index];
}

template <class S> void JointMap<S>::relabel(const JointSet<S>& joints, std::uint32_t set, std::size_t from) {
  for (std::size_t i = from; i < joints.states.size(); ++i)
    locations_[joints.states[i].slot] = {set, static_cast<std::uint32_t>(i)};
}

template <class S> void JointMap<S>::insert(const JointState<S>& state, const JointProperties<S>& joint) {
  const auto at = static_cast<std::ptrdiff_t>(place_of_slot(state_.joints.states, state.slot));
  state_.joints.states.insert(state_.joints.states.begin() + at, state);
  state_.joints.properties.insert(state_.joints.properties.begin() + at, joint);
  make_room();
  relabel(state_.joints, Location::kAwake, static_cast<std::size_t>(at));
}
template <class S> void JointMap<S>::erase(std::uint32_t slot) {
  const std::uint32_t index = locations_[slot].index;
  const auto at = static_cast<std::ptrdiff_t>(index);
  state_.joints.states.erase(state_.joints.states.begin() + at);
  state_.joints.properties.erase(state_.joints.properties.begin() + at);
  locations_[slot] = Location{};
  relabel(state_.joints, Location::kAwake, index);
}

template <class S> void JointMap<S>::make_room() {
  const std::size_t joints = state_.joint_slots.entries().size();
  if (locations_.size() < joints) locations_.resize(joints);
}

}  // namespace isostep
