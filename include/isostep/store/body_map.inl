// Bodies of body_map.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/joint_map.inl"
#include "isostep/store/shape_map.inl"

namespace isostep {

template <class S> Location BodyMap<S>::locate(BodyId body) const {
  return state_.body_slots.holds(body) ? locations_[body.slot] : Location{};
}

template <class S> const BodyState<S>* BodyMap<S>::state_of(BodyId body) const {
  const Location at = locate(body);
  return at.set == Location::kNone ? nullptr : &state_at(at);
}
template <class S> const BodyProperties<S>* BodyMap<S>::properties_of(BodyId body) const {
  const Location at = locate(body);
  return at.set == Location::kNone ? nullptr : &properties_at(at);
}
template <class S> BodyState<S>& BodyMap<S>::change_state(std::uint32_t slot) {
  const Location at = locations_[slot];
  if (at.set == Location::kAwake) return state_.awake.states[at.index];
  return state_.static_bodies.change_page_of(at.index).states[at.index % StaticBodies<S>::kPageSlots];
}
template <class S> BodyProperties<S>& BodyMap<S>::change_properties(std::uint32_t slot) {
  const Location at = locations_[slot];
  if (at.set == Location::kAwake) return state_.awake.properties[at.index];
  return state_.static_bodies.change_page_of(at.index).properties[at.index % StaticBodies<S>::kPageSlots];
}

template <class S> Pose<S> BodyMap<S>::origin_pose_at(std::uint32_t slot) const {
  return origin_pose(state_at(locations_[slot]), properties_at(locations_[slot]));
}

template <class S> void BodyMap<S>::relabel(const BodySet<S>& bodies, std::uint32_t set, std::size_t from) {
  for (std::size_t i = from; i < bodies.states.size(); ++i)
    locations_[bodies.states[i].slot] = {set, static_cast<std::uint32_t>(i)};
}
template <class S> void BodyMap<S>::relabel_static(std::size_t page, std::size_t from) {
  const std::vector<BodyState<S>>& states = state_.static_bodies.page(page).states;
  for (std::size_t row = from; row < states.size(); ++row)
    locations_[states[row].slot] = {Location::kStatic, StaticBodies<S>::place_of(page, row)};
}

template <class S> void BodyMap<S>::insert(const BodyState<S>& state, const BodyProperties<S>& body) {
  make_room();
  shapes.count_use(body.shape, 1);
  if (is_fixed(body)) {
    const std::uint32_t place = state_.static_bodies.insert(state, body);
    relabel_static(place / StaticBodies<S>::kPageSlots, place % StaticBodies<S>::kPageSlots);
    return;
  }
  BodySet<S>& set = state_.awake;
  const auto at = static_cast<std::ptrdiff_t>(place_of_slot(set.states, state.slot));
  set.states.insert(set.states.begin() + at, state);
  set.properties.insert(set.properties.begin() + at, body);
  relabel(set, Location::kAwake, static_cast<std::size_t>(at));
}
template <class S> void BodyMap<S>::erase(std::uint32_t slot) {
  const Location at = locations_[slot];
  shapes.count_use(properties_at(at).shape, ~0u);
  locations_[slot] = Location{};
  if (at.set == Location::kStatic) {
    state_.static_bodies.erase(at.index);
    relabel_static(at.index / StaticBodies<S>::kPageSlots, at.index % StaticBodies<S>::kPageSlots);
    return;
  }
  BodySet<S>& set = state_.awake;
  const auto index = static_cast<std::ptrdiff_t>(at.index);
  set.states.erase(set.states.begin() + index);
  set.properties.erase(set.properties.begin() + index);
  relabel(set, at.set, at.index);
}
template <class S> void BodyMap<S>::count_names(const SleepingIsland<S>& island, std::uint32_t by) {
  for (const Contact<S>& contact : island.contacts) {
    names_[contact.key.body_a] += by;
    names_[contact.key.body_b] += by;
  }
  for (const JointProperties<S>& joint : island.joints.properties) {
    if (joint.body_a != kNoBody) names_[joint.body_a] += by;
    if (joint.body_b != kNoBody) names_[joint.body_b] += by;
  }
}

template <class S> void BodyMap<S>::make_room() {
  const std::size_t bodies = state_.body_slots.entries().size();
  if (locations_.size() < bodies) {
    locations_.resize(bodies);
    names_.resize(bodies);
  }
}

}  // namespace isostep
