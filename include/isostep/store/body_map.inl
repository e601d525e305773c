// Bodies of body_map.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/contact_friction.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/state/members.hpp"
#include "isostep/store/body_map.hpp"

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

template <class S> const Child<S>* BodyMap<S>::height_field_of(std::uint32_t shape_slot, std::uint32_t child) const {
  const std::span<const Child<S>> children = children_of(shape_slot);
  const bool is_field = child < children.size() && children[child].primitive.type == ShapeType::height_field;
  return is_field ? &children[child] : nullptr;
}

template <class S> Leaf BodyMap<S>::leaf_of(std::uint32_t body_slot, std::uint32_t leaf) const {
  const BodyProperties<S>& body = properties_at(locations_[body_slot]);
  if (body.type == BodyType::dynamic) return {leaf, 0};  // it has no surfaces
  return leaf_at<S>(tree_of(body.shape), children_of(body.shape), contents(), leaf);
}

template <class S> ContactEnd BodyMap<S>::named(const ContactKey& key) const {
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  return {id(key.body_a), id(key.body_b), leaf_of(key.body_a, key.child_a).child,
          leaf_of(key.body_b, key.child_b).child};
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

template <class S> void BodyMap<S>::relabel_static(std::size_t page, std::size_t from) {
  const std::vector<BodyState<S>>& states = state_.static_bodies.page(page).states;
  for (std::size_t row = from; row < states.size(); ++row)
    locations_[states[row].slot] = {Location::kStatic, StaticBodies<S>::place_of(page, row)};
}

template <class S> void BodyMap<S>::insert(const BodyState<S>& state, const BodyProperties<S>& body) {
  make_room();
  count_use(body.shape, 1);
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
template <class S> void BodyMap<S>::insert(const JointState<S>& state, const JointProperties<S>& joint) {
  const auto at = static_cast<std::ptrdiff_t>(place_of_slot(state_.joints.states, state.slot));
  state_.joints.states.insert(state_.joints.states.begin() + at, state);
  state_.joints.properties.insert(state_.joints.properties.begin() + at, joint);
  make_room();
  relabel(state_.joints, Location::kAwake, static_cast<std::size_t>(at));
}
template <class S> void BodyMap<S>::erase(std::uint32_t slot) {
  const Location at = locations_[slot];
  count_use(properties_at(at).shape, ~0u);
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

template <class S> void BodyMap<S>::renew_content(std::uint32_t place) {
  contents_.resize(state_.geometry->names().size());
  if (!state_.geometry->is_taken(place)) return;
  contents_[place] = content_of<S>(*state_.geometry->content(place));
}

template <class S>
std::shared_ptr<const StoredShape<S>> BodyMap<S>::stored(std::vector<Child<S>> children, Contents<S> contents) {
  auto shape = std::make_shared<StoredShape<S>>();
  shape->children = std::move(children);
  shape->hash = detail::hash_sections(*shape);
  if (shape->children.size() >= ChildTree<S>::kLeastChildren)
    shape->tree = std::make_shared<const ChildTree<S>>(std::span<const Child<S>>(shape->children), contents);
  shape->thinnest = detail::kThick<S>;
  for (const Child<S>& child : shape->children) {
    if (!child.traits.has(part_flag::kSensor))
      shape->thinnest = min(shape->thinnest, thickness<S>(contents.view(child.primitive)));
    shape->traits.add(child.traits);
    if (child.traits.has(part_flag::kOwnMaterial) && !isostep::mixes_alone(child.traits.material))
      shape->traits.mixes_alone = false;
  }
  return shape;
}

template <class S> void BodyMap<S>::put_shape(std::uint32_t slot, std::vector<Child<S>> children) {
  while (state_.shapes.size() <= slot) state_.shapes.push_back(nullptr);
  const std::shared_ptr<const StoredShape<S>> earlier = state_.shapes[slot];
  const std::shared_ptr<const StoredShape<S>> next = stored(std::move(children), contents());
  if (next->thinnest < thickness_) thickness_ = next->thinnest;
  if (earlier != nullptr && earlier->thinnest <= thickness_) forget_thickness();
  state_.shapes.change(slot) = next;
}

template <class S> S BodyMap<S>::least_thickness() const {
  if (knows_thickness_) return thickness_;
  thickness_ = detail::kThick<S>;
  for (std::uint32_t slot = 0; slot < state_.shapes.size(); ++slot) thickness_ = min(thickness_, thinnest_of(slot));
  knows_thickness_ = true;
  return thickness_;
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
