// Bodies of world.hpp: joints, and where they stand.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/query/joint_queries.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

template <class S> JointId World<S>::create(const JointProperties<S>& joint) { return apply(CreateJoint<S>{joint}); }
template <class S> bool World<S>::destroy(JointId joint) { return apply(DestroyJoint{joint}); }
template <class S> bool World<S>::set_limits(JointId joint, S lower, S upper) {
  return apply(SetJointLimits<S>{joint, lower, upper});
}
template <class S> bool World<S>::set_motor(JointId joint, S speed, S max_force) {
  return apply(SetJointMotor<S>{joint, speed, max_force});
}
template <class S> bool World<S>::set_spring(JointId joint, S frequency, S damping) {
  return apply(SetJointSpring<S>{joint, frequency, damping});
}
template <class S> bool World<S>::set_target(JointId joint, S target) {
  return apply(SetJointTarget<S>{joint, target});
}
template <class S> bool World<S>::set_joint(JointId joint, const JointProperties<S>& properties) {
  return apply(SetJoint<S>{joint, properties});
}
template <class S> const JointProperties<S>* World<S>::joint(JointId joint) const {
  return engine_->map_.joints.properties_of(joint);
}
template <class S> S World<S>::joint_error(JointId joint) const {
  return pin_floats([&] { return detail::joint_error(engine_->map_, joint); });
}
template <class S> S World<S>::joint_position(JointId joint) const {
  return pin_floats([&] { return detail::joint_position(engine_->map_, joint); });
}

template <class S> S World<S>::joint_position(JointId joint, JointAxis axis) const {
  return pin_floats([&] { return detail::joint_position(engine_->state_, engine_->map_, joint, axis); });
}

/// Makes both frames from one world frame, with the bodies where they are now. Leaves a frame whose orientation is not
/// a unit quaternion unchanged, so that create() refuses it.
template <class S>
JointProperties<S> World<S>::joint_at(JointType type, BodyId a, BodyId b, const Pose<S>& frame) const {
  return joint_between(type, a, frame, b, frame);
}
template <class S> AxisDriveId World<S>::axis_drive(JointId joint, JointAxis axis) const {
  return detail::drive_on(*engine_->state_.records, joint, axis);
}
template <class S>
JointProperties<S> World<S>::joint_between(JointType type, BodyId a, const Pose<S>& frame_a, BodyId b,
                                           const Pose<S>& frame_b) const {
  return pin_floats([&]() -> JointProperties<S> {
    JointProperties<S> joint;
    joint.type = type;
    const auto local = [&](BodyId body, const Pose<S>& frame, std::uint32_t& slot, std::uint32_t& generation) {
      if (!body) return frame;
      slot = body.slot;
      generation = body.generation;
      if (!contains(body) || !detail::is_unit<S>(frame.orientation)) return frame;
      const Pose<S> centre = engine_->map_.centre_pose_at(body.slot);
      const Vec3<S> arm = transposed_times(to_matrix(centre.orientation), frame.position - centre.position);
      return Pose<S>{arm, normalise(conjugate(centre.orientation) * frame.orientation)};
    };
    joint.frame_a = local(a, frame_a, joint.body_a, joint.generation_a);
    joint.frame_b = local(b, frame_b, joint.body_b, joint.generation_b);
    return joint;
  });
}
template <class S> JointId World<S>::create(const JointDefinition<S>& definition) {
  JointProperties<S> joint =
      joint_between(definition.settings.type, definition.a, definition.frame_a, definition.b, definition.frame_b);
  joint.take_settings(definition.settings);
  if (kJointAxes < definition.drive_count) {
    this->refuse("create_joint", {Fault::bad_argument, "", "drive_count", "0 to 6"});
    return {};
  }
  const std::span<const AxisDrive<S>> drives(definition.drives, definition.drive_count);
  const FaultReport fault = detail::fault_of_drives(drives, joint, substep_rate(this->settings()));
  if (fault != Fault::none) {
    this->refuse("create_joint", fault);
    return {};
  }
  const JointId made = create(joint);
  if (!made) return {};
  for (AxisDrive<S> drive : drives) {
    drive.joint = made;
    add(drive);  // fault_of_drives() has seen that each fits
  }
  return made;
}

}  // namespace isostep
