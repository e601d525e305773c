// WorldEngine: where bodies lie, and moving them in and out of their sets.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
/// [m] added around a body's bounds: a body is looked up anew only when it leaves the margin.
template <class S> inline constexpr S kFatMargin = S(0.1);
/// [m] contacts are found this far ahead of touching, so that the solver sees them before they overlap.
template <class S> inline constexpr S kSpeculativeDistance = S(0.02);

/// The first of 0..count-1 that is not before.
template <class Before> std::size_t lower_bound(std::size_t count, const Before& before) {
  std::size_t low = 0, high = count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (before(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}
template <class Set> std::size_t lower_bound_slot(const Set& set, std::uint32_t slot) {
  return lower_bound(set.states.size(), [&](std::size_t i) { return set.states[i].slot < slot; });
}
}  // namespace detail

template <class S> Location WorldEngine<S>::locate(BodyId body) const {
  return state_.body_slots.holds(body) ? locations_[body.slot] : Location{};
}
template <class S> const BodyState<S>& WorldEngine<S>::state_at(Location at) const {
  if (at.set == Location::kAwake) return state_.awake.states[at.index];
  if (at.set == Location::kFixed) return state_.fixed->states[at.index];
  return state_.frozen[at.set]->bodies.states[at.index];
}
template <class S> const BodyProperties<S>& WorldEngine<S>::properties_at(Location at) const {
  if (at.set == Location::kAwake) return state_.awake.properties[at.index];
  if (at.set == Location::kFixed) return state_.fixed->properties[at.index];
  return state_.frozen[at.set]->bodies.properties[at.index];
}
template <class S> const BodyState<S>* WorldEngine<S>::state_of(BodyId body) const {
  const Location at = locate(body);
  return at.set == Location::kNone ? nullptr : &state_at(at);
}
template <class S> const BodyProperties<S>* WorldEngine<S>::properties_of(BodyId body) const {
  const Location at = locate(body);
  return at.set == Location::kNone ? nullptr : &properties_at(at);
}
template <class S> const JointProperties<S>* WorldEngine<S>::properties_of(JointId joint) const {
  if (!state_.joint_slots.holds(joint)) return nullptr;
  const Location at = joint_locations_[joint.slot];
  const JointSet<S>& set = at.is_frozen() ? state_.frozen[at.set]->joints : state_.joints;
  return &set.properties[at.index];
}

template <class S> std::span<const Child<S>> WorldEngine<S>::children_of(std::uint32_t shape_slot) const {
  const ShapeRecord& record = (*state_.shapes)[shape_slot];
  return {state_.children->data() + record.first_child, record.child_count};
}

/// A body's origin is its centre less the centre's place in the body.
template <class S> Pose<S> WorldEngine<S>::origin_pose(const BodyState<S>& state, const BodyProperties<S>& body) const {
  if (body.local_centre == Vec3<S>::zero()) return {state.centre, state.orientation};
  return {state.centre - to_matrix(state.orientation) * body.local_centre, state.orientation};
}

/// Pose of the centre of mass, or of the world itself.
template <class S> Pose<S> WorldEngine<S>::centre_pose_at(std::uint32_t slot) const {
  if (slot == kNoBody) return Pose<S>::identity();
  const BodyState<S>& state = state_at(locations_[slot]);
  return {state.centre, state.orientation};
}

template <class S> BodyProperties<S>& WorldEngine<S>::mutable_properties(std::uint32_t slot) {
  const Location at = locations_[slot];
  return at.set == Location::kAwake ? state_.awake.properties[at.index] : state_.fixed.change().properties[at.index];
}

template <class S> void WorldEngine<S>::relabel(const BodySet<S>& set, std::uint32_t set_name, std::size_t from) {
  for (std::size_t i = from; i < set.states.size(); ++i) {
    locations_[set.states[i].slot] = {set_name, static_cast<std::uint32_t>(i)};
  }
}
template <class S>
void WorldEngine<S>::relabel_joints(const JointSet<S>& set, std::uint32_t set_name, std::size_t from) {
  for (std::size_t i = from; i < set.states.size(); ++i) {
    joint_locations_[set.states[i].slot] = {set_name, static_cast<std::uint32_t>(i)};
  }
}

template <class S>
void WorldEngine<S>::insert_body(BodySet<S>& set, std::uint32_t set_name, const BodyState<S>& state,
                                 const BodyProperties<S>& body) {
  const std::size_t at = detail::lower_bound_slot(set, state.slot);
  set.states.insert(set.states.begin() + static_cast<std::ptrdiff_t>(at), state);
  set.properties.insert(set.properties.begin() + static_cast<std::ptrdiff_t>(at), body);
  if (locations_.size() <= state.slot) {
    locations_.resize(state.slot + 1);
    named_.resize(locations_.size());
  }
  relabel(set, set_name, at);
}
template <class S> void WorldEngine<S>::insert_joint(const JointState<S>& state, const JointProperties<S>& joint) {
  const std::size_t at = detail::lower_bound_slot(state_.joints, state.slot);
  state_.joints.states.insert(state_.joints.states.begin() + static_cast<std::ptrdiff_t>(at), state);
  state_.joints.properties.insert(state_.joints.properties.begin() + static_cast<std::ptrdiff_t>(at), joint);
  if (joint_locations_.size() <= state.slot) joint_locations_.resize(state.slot + 1);
  relabel_joints(state_.joints, Location::kAwake, at);
}

template <class S> void WorldEngine<S>::renew_fat_box(BodyState<S>& state, const BodyProperties<S>& body, bool always) {
  const Transform<S> origin = Transform<S>::of(origin_pose(state, body));
  const Aabb<S> tight = bounds(children_of(body.shape), origin);
  if (always || !contains(state.fat, tight)) state.fat = grow(tight, detail::kFatMargin<S>);
}

/// What a command puts somewhere is drawn there and not on the way from where its slot was before.
template <class S> void WorldEngine<S>::draw_from_here(const BodyState<S>& state) {
  const std::size_t at =
      detail::lower_bound(start_slots_.size(), [&](std::size_t i) { return start_slots_[i] < state.slot; });
  if (at < start_slots_.size() && start_slots_[at] == state.slot) start_poses_[at] = {state.centre, state.orientation};
}

/// An awake body rests anew: what held it may be gone, and the rest it had counted was on that.
template <class S> void WorldEngine<S>::restless(std::uint32_t slot) {
  if (slot != kNoBody && locations_[slot].set == Location::kAwake)
    state_.awake.states[locations_[slot].index].sleep_clock = 0;
}

/// Wakes every island and every body that a body's fat box meets: what is moved, changed or taken away may have held
/// them up.
template <class S> void WorldEngine<S>::wake_touching(std::uint32_t slot) {
  if (!proxies_.present(slot)) return;
  std::vector<std::uint32_t> met;
  proxies_.tree().query(proxies_.tree().box(slot), [&](std::uint32_t other) {
    if (locations_[other].is_frozen()) met.push_back(other);
    else if (other != slot) restless(other);
    return true;
  });
  std::vector<std::uint32_t> scratch(met.size());
  stable_sort(met.data(), scratch.data(), static_cast<std::uint32_t>(met.size()), OwnKey{});
  for (const std::uint32_t other : met) {
    const Location at = locations_[other];
    if (at.is_frozen()) unlist(at.set);
  }
  merge_woken();
}

/// Thaws every island with a joint to, or a contact with, a body that no island holds. Its box need not meet theirs any
/// more: a contact is frozen as the last step found it.
template <class S> void WorldEngine<S>::wake_held_by(std::uint32_t slot) {
  for (std::uint32_t i = static_cast<std::uint32_t>(state_.frozen.size()); named_[slot] != 0 && i-- > 0;) {
    const FrozenIsland<S>& island = *state_.frozen[i];
    bool held = false;
    for (const JointProperties<S>& joint : island.joints.properties)
      held = held || joint.body_a == slot || joint.body_b == slot;
    for (const Contact<S>& contact : island.contacts)
      held = held || contact.key.body_a == slot || contact.key.body_b == slot;
    if (held) unlist(i);
  }
  merge_woken();
}

/// Whether a body's motion is to be changed at all: not that of a fixed one.
template <class S> bool WorldEngine<S>::may_change(BodyId body) {
  if (!known(body)) return false;
  const bool moves = locations_[body.slot].set != Location::kFixed;
  return moves || journal_.refuse({Fault::not_dynamic, "", "body", "a dynamic or kinematic one"});
}
template <class S> bool WorldEngine<S>::may_push(BodyId body) {
  if (!known(body)) return false;
  const bool pushable = properties_at(locations_[body.slot]).type == BodyType::dynamic;
  return pushable || journal_.refuse({Fault::not_dynamic, "", "body", "a dynamic one"});
}

/// The awake state of a body about to be changed.
template <class S> BodyState<S>* WorldEngine<S>::wake_for_change(std::uint32_t slot) {
  thaw_body(slot);
  BodyState<S>& state = state_.awake.states[locations_[slot].index];
  state.sleep_clock = 0;
  return &state;
}

/// A velocity of zero. What sleeps has no other, and who rests goes on resting, so that a game may say so every frame.
template <class S> void WorldEngine<S>::halt(std::uint32_t slot) {
  if (locations_[slot].set != Location::kAwake) return;
  BodyState<S>& state = state_.awake.states[locations_[slot].index];
  state.velocity = Vec3<Velocity<S>>::zero();
  state.spin = Vec3<Velocity<S>>::zero();
}

template <class S> S WorldEngine<S>::joint_error(JointId joint) const {
  const JointProperties<S>* properties = properties_of(joint);
  if (properties == nullptr) return S(0);
  const Pose<S> a = compose(centre_pose_at(properties->body_a), properties->frame_a);
  const Pose<S> b = compose(centre_pose_at(properties->body_b), properties->frame_b);
  return visit_joint_type(properties->type, [&](auto kind) ISO_INLINE_LAMBDA {
    return decltype(kind)::template Of<S>::error(*properties, a, b);
  });
}

}  // namespace isostep
