// Bodies of body_map.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/world/body_map.hpp"

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
template <class S> const JointProperties<S>* BodyMap<S>::properties_of(JointId joint) const {
  if (!state_.joint_slots.holds(joint)) return nullptr;
  const Location at = joint_locations_[joint.slot];
  const JointSet<S>& set = at.is_asleep() ? state_.sleeping[at.set]->joints : state_.joints;
  return &set.properties[at.index];
}
template <class S> BodyProperties<S>& BodyMap<S>::change_properties(std::uint32_t slot) {
  const Location at = locations_[slot];
  return at.set == Location::kAwake ? state_.awake.properties[at.index]
                                    : state_.static_bodies.change().properties[at.index];
}

template <class S> const Child<S>* BodyMap<S>::height_field_of(std::uint32_t shape_slot, std::uint32_t child) const {
  const std::span<const Child<S>> children = children_of(shape_slot);
  const bool is_field = child < children.size() && children[child].primitive.type == ShapeType::height_field;
  return is_field ? &children[child] : nullptr;
}

/// A body's origin is its centre less the centre's place in the body.
template <class S> Pose<S> BodyMap<S>::origin_pose(const BodyState<S>& state, const BodyProperties<S>& body) {
  if (body.local_centre == Vec3<S>::zero()) return {state.centre, state.orientation};
  return {state.centre - to_matrix(state.orientation) * body.local_centre, state.orientation};
}
template <class S> Pose<S> BodyMap<S>::centre_pose(const Pose<S>& origin, Vec3<S> local_centre) {
  return {origin.position + to_matrix(origin.orientation) * local_centre, origin.orientation};
}
template <class S> Pose<S> BodyMap<S>::origin_pose_at(std::uint32_t slot) const {
  return origin_pose(state_at(locations_[slot]), properties_at(locations_[slot]));
}

template <class S> void BodyMap<S>::relabel(const BodySet<S>& bodies, std::uint32_t set, std::size_t from) {
  for (std::size_t i = from; i < bodies.states.size(); ++i)
    locations_[bodies.states[i].slot] = {set, static_cast<std::uint32_t>(i)};
}
template <class S> void BodyMap<S>::relabel(const JointSet<S>& joints, std::uint32_t set, std::size_t from) {
  for (std::size_t i = from; i < joints.states.size(); ++i)
    joint_locations_[joints.states[i].slot] = {set, static_cast<std::uint32_t>(i)};
}

template <class S> void BodyMap<S>::insert(const BodyState<S>& state, const BodyProperties<S>& body) {
  const bool fixed = is_fixed(body);
  BodySet<S>& set = fixed ? state_.static_bodies.change() : state_.awake;
  const auto at = static_cast<std::ptrdiff_t>(place_of_slot(set.states, state.slot));
  set.states.insert(set.states.begin() + at, state);
  set.properties.insert(set.properties.begin() + at, body);
  make_room();
  relabel(set, fixed ? Location::kStatic : Location::kAwake, static_cast<std::size_t>(at));
}
template <class S> void BodyMap<S>::insert(const JointState<S>& state, const JointProperties<S>& joint) {
  const auto at = static_cast<std::ptrdiff_t>(place_of_slot(state_.joints.states, state.slot));
  state_.joints.states.insert(state_.joints.states.begin() + at, state);
  state_.joints.properties.insert(state_.joints.properties.begin() + at, joint);
  make_room();
  relabel(state_.joints, Location::kAwake, static_cast<std::size_t>(at));
}
template <class S> void BodyMap<S>::erase(std::uint32_t slot) {
  const Location at = locations_[slot];
  BodySet<S>& set = at.set == Location::kStatic ? state_.static_bodies.change() : state_.awake;
  const auto index = static_cast<std::ptrdiff_t>(at.index);
  set.states.erase(set.states.begin() + index);
  set.properties.erase(set.properties.begin() + index);
  locations_[slot] = Location{};
  relabel(set, at.set, at.index);
}
template <class S> void BodyMap<S>::erase_joint(std::uint32_t slot) {
  const std::uint32_t index = joint_locations_[slot].index;
  const auto at = static_cast<std::ptrdiff_t>(index);
  state_.joints.states.erase(state_.joints.states.begin() + at);
  state_.joints.properties.erase(state_.joints.properties.begin() + at);
  joint_locations_[slot] = Location{};
  relabel(state_.joints, Location::kAwake, index);
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

template <class S> void BodyMap<S>::renew_contents() { find_contents<S>(state_.geometry->contents(), contents_); }

template <class S> void BodyMap<S>::renew_tree(std::uint32_t shape_slot) {
  const std::span<const Child<S>> children = children_of(shape_slot);
  const bool many = children.size() >= ChildTree<S>::kLeastChildren;
  if (!many && tree_of(shape_slot) == nullptr) return;
  ChildTrees<S>& trees = state_.trees.change();
  if (trees.size() <= shape_slot) trees.resize(shape_slot + 1);
  trees[shape_slot] = many ? std::make_shared<const ChildTree<S>>(children, contents()) : nullptr;
}
template <class S> void BodyMap<S>::renew_trees() {
  for (std::uint32_t shape = 0; shape < state_.shapes->size(); ++shape) renew_tree(shape);
}

template <class S> void BodyMap<S>::make_room() {
  const std::size_t bodies = state_.body_slots.entries().size(), joints = state_.joint_slots.entries().size();
  if (locations_.size() < bodies) {
    locations_.resize(bodies);
    names_.resize(bodies);
  }
  if (joint_locations_.size() < joints) joint_locations_.resize(joints);
}

}  // namespace isostep
