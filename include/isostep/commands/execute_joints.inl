// The commands about joints.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/command_executor.hpp"
#include "isostep/dynamics/joints/joint_checks.hpp"

namespace isostep {

/// Checks that a joint may tie these two bodies.
template <class S> bool CommandExecutor<S>::check_ends(const JointProperties<S>& joint) {
  const BodyId ends[2] = {{joint.body_a, joint.generation_a}, {joint.body_b, joint.generation_b}};
  const Vec3<S> arms[2] = {joint.frame_a.position, joint.frame_b.position};
  constexpr const char *kBodies[2] = {"body_a", "body_b"}, *kFrames[2] = {"frame_a.position", "frame_b.position"};
  const BodyProperties<S>* bodies[2] = {};
  bool moves = false;
  for (int end = 0; end < 2; ++end) {
    if (ends[end].slot == kNoBody) continue;
    if (!known(state_.body_slots, ends[end], kBodies[end])) return false;
    const BodyProperties<S>& body = map_.properties_at(map_.location(ends[end].slot));
    if (detail::overreaches(body.kappa, body.principal, arms[end]))
      return faults_.refuse({Fault::out_of_range, "", kFrames[end], "kappa arm^2 up to Limits::leverage()"});
    bodies[end] = &body;
    moves = moves || body.type == BodyType::dynamic;
  }
  if (bodies[0] != nullptr && bodies[1] != nullptr && detail::outweighs(*bodies[0], *bodies[1]))
    return faults_.refuse({Fault::out_of_range, "", "body_a, body_b", "masses up to Limits::mass_ratio() to one"});
  if (!moves) return faults_.refuse({Fault::not_dynamic, "", "body_a, body_b", "a dynamic one"});
  return joint.body_a != joint.body_b ||
         faults_.refuse({Fault::bad_argument, "", "body_b", "another body than body_a"});
}

template <class S> JointId CommandExecutor<S>::execute(const CreateJoint<S>& command) {
  JointProperties<S> joint = command.joint;
  if (!faults_.accept(detail::fault_of(joint, substep_rate(state_.settings)))) return {};
  if (!check_ends(joint)) return {};
  for (const std::uint32_t slot : {joint.body_a, joint.body_b}) {
    if (slot != kNoBody) wake_.wake(slot);
    wake_.reset_clock(slot);
  }
  joint.frame_a.orientation = normalise(joint.frame_a.orientation);
  joint.frame_b.orientation = normalise(joint.frame_b.orientation);
  const JointId id = state_.joint_slots.template take<JointId>(state_.settings.id_space);
  JointState<S> state = {};
  state.slot = id.slot;
  map_.joints.insert(state, joint);
  return id;
}

template <class S> bool CommandExecutor<S>::execute(const DestroyJoint& command) {
  if (!known(state_.joint_slots, command.joint, "joint")) return false;
  destruction_.destroy_joint(command.joint.slot);
  return true;
}

/// Checks that the joint's AxisDrives fit its next properties.
template <class S> bool CommandExecutor<S>::check_drives(JointId joint, const JointProperties<S>& next) {
  const std::int32_t rate = substep_rate(state_.settings);
  const auto& drives = state_.records->axis_drives;
  for (std::uint32_t slot = 0; slot < drives.all().size(); ++slot) {
    if (!drives.is_taken(slot) || !(drives.all()[slot].joint == joint)) continue;
    if (detail::fault_of_joint(drives.all()[slot], next, rate) == Fault::none) continue;
    return faults_.refuse({Fault::bad_argument, "", "flags", "locks and a cone that the joint's AxisDrives allow"});
  }
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetJoint<S>& command) {
  if (!known(state_.joint_slots, command.joint, "joint")) return false;
  const JointProperties<S>& next = command.properties;
  if (!faults_.accept(detail::fault_of(next, substep_rate(state_.settings)))) return false;
  if (next.type != map_.joints.properties_of(command.joint)->type)
    return faults_.refuse({Fault::bad_argument, "", "type", "the one that the joint was made with"});
  if (!check_drives(command.joint, next)) return false;
  state_.joints.properties[wake_.wake_joint(command.joint.slot)].take_settings(next);
  return true;
}

/// Executes SetJoint with the joint's properties after change(properties, set_flag); set_flag(flag, on) turns a
/// joint_flag on or off.
template <class S> template <class Change> bool CommandExecutor<S>::change_joint(JointId joint, const Change& change) {
  if (!known(state_.joint_slots, joint, "joint")) return false;
  JointProperties<S> next = *map_.joints.properties_of(joint);
  const auto set_flag = [&](std::uint32_t flag, bool on) { next.flags = on ? next.flags | flag : next.flags & ~flag; };
  change(next, set_flag);
  return execute(SetJoint<S>{joint, next});
}
template <class S> bool CommandExecutor<S>::execute(const SetJointLimits<S>& command) {
  return change_joint(command.joint, [&](JointProperties<S>& joint, const auto& set_flag) {
    set_flag(joint_flag::kLimit, true);
    joint.lower = command.lower;
    joint.upper = command.upper;
  });
}
template <class S> bool CommandExecutor<S>::execute(const SetJointMotor<S>& command) {
  return change_joint(command.joint, [&](JointProperties<S>& joint, const auto& set_flag) {
    set_flag(joint_flag::kMotor, !(command.max_force == S(0)));
    joint.motor_speed = command.speed;
    joint.max_force = command.max_force;
  });
}
template <class S> bool CommandExecutor<S>::execute(const SetJointSpring<S>& command) {
  return change_joint(command.joint, [&](JointProperties<S>& joint, const auto& set_flag) {
    set_flag(joint_flag::kSpring, !(command.frequency == S(0)));
    joint.spring_frequency = command.frequency;
    joint.spring_damping = command.damping;
  });
}
template <class S> bool CommandExecutor<S>::execute(const SetJointTarget<S>& command) {
  return change_joint(command.joint,
                      [&](JointProperties<S>& joint, const auto&) { joint.spring_target = command.target; });
}

}  // namespace isostep
