// WorldEngine: the commands about joints.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/checks.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

template <class S> JointId WorldEngine<S>::execute(const CreateJoint<S>& command) {
  JointProperties<S> joint = command.joint;
  if (!journal_.accept(detail::fault_of(joint, state_.settings.hz * state_.settings.substeps))) return {};
  const BodyId ends[2] = {{joint.body_a, joint.generation_a}, {joint.body_b, joint.generation_b}};
  const Vec3<S> arms[2] = {joint.frame_a.position, joint.frame_b.position};
  constexpr const char *kBodies[2] = {"body_a", "body_b"}, *kFrames[2] = {"frame_a.position", "frame_b.position"};
  bool moves = false;
  for (int end = 0; end < 2; ++end) {
    if (ends[end].slot == kNoBody) continue;
    if (!known(state_.body_slots, ends[end], kBodies[end])) return {};
    const BodyProperties<S>& body = properties_at(locations_[ends[end].slot]);
    if (detail::overreaches(body.kappa, body.principal, arms[end])) {
      journal_.refuse({Fault::out_of_range, "", kFrames[end], "kappa arm^2 up to Limits::leverage()"});
      return {};
    }
    moves = moves || body.type == BodyType::dynamic;
  }
  if (!moves || joint.body_a == joint.body_b) {
    if (moves) journal_.refuse({Fault::bad_argument, "", "body_b", "another body than body_a"});
    else journal_.refuse({Fault::not_dynamic, "", "body_a, body_b", "a dynamic one"});
    return {};
  }
  for (const std::uint32_t slot : {joint.body_a, joint.body_b}) {
    if (slot != kNoBody) thaw_body(slot);
    restless(slot);
  }
  joint.frame_a.orientation = normalise(joint.frame_a.orientation);
  joint.frame_b.orientation = normalise(joint.frame_b.orientation);
  const JointId id = state_.joint_slots.template take<JointId>(state_.settings.id_space);
  JointState<S> state = {};
  state.slot = id.slot;
  insert_joint(state, joint);
  return id;
}

/// Thaws the joint's island and unsettles what it ties; answers where it then lies in the awake image.
template <class S> std::uint32_t WorldEngine<S>::wake_joint(JointId joint) {
  const Location at = joint_locations_[joint.slot];
  if (at.is_frozen()) {
    unlist(at.set);
    merge_woken();
  }
  const std::uint32_t index = joint_locations_[joint.slot].index;
  const JointProperties<S>& properties = state_.joints.properties[index];
  restless(properties.body_a);
  restless(properties.body_b);
  return index;
}

template <class S> bool WorldEngine<S>::execute(const DestroyJoint& command) {
  if (!known(state_.joint_slots, command.joint, "joint")) return false;
  const std::uint32_t slot = command.joint.slot;
  const std::uint32_t index = wake_joint(command.joint);
  const auto at = static_cast<std::ptrdiff_t>(index);
  state_.joints.states.erase(state_.joints.states.begin() + at);
  state_.joints.properties.erase(state_.joints.properties.begin() + at);
  joint_locations_[slot] = Location{};
  relabel_joints(state_.joints, Location::kAwake, index);
  state_.joint_slots.give_back(slot);
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetJoint<S>& command) {
  if (!known(state_.joint_slots, command.joint, "joint")) return false;
  const JointProperties<S>& next = command.properties;
  if (!journal_.accept(detail::fault_of(next, state_.settings.hz * state_.settings.substeps))) return false;
  if (next.type != properties_of(command.joint)->type)
    return journal_.refuse({Fault::bad_argument, "", "type", "the one that the joint was made with"});
  state_.joints.properties[wake_joint(command.joint)].take_settings(next);
  return true;
}

}  // namespace isostep
