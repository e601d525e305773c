// Joints by their usual names, each from the numbers that it needs: world.create(hinge<S>({.a = frame, .b = door})).
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/records/axis_drive.hpp"

namespace isostep {

/// A joint with its drives, for World::create. A null body is the world. The frames are in world space, with the bodies
/// where they are when the joint is created.
template <class S> struct JointDefinition {
  BodyId a = {}, b = {};
  Pose<S> frame_a = Pose<S>::identity();
  Pose<S> frame_b = Pose<S>::identity();
  JointProperties<S> settings;      // kind, flags and numbers; its bodies and frames are not looked at
  AxisDrive<S> drives[kJointAxes];  // of a six-axis joint; their `joint` is not looked at
  std::uint32_t drive_count = 0;    // of them, from the first; the others are not looked at
};

template <class S> struct JointRange { S lower, upper; };  // [m] or [rad]
template <class S> struct JointMotor {
  S speed = S(0);  // [m/s] or [rad/s]
  S max_force = S(0);  // [N] or [N m] at most
};
template <class S> struct JointSpring {
  S frequency = S(1);  // [Hz]
  S damping = S(1);    // [1] 1 = critical
  S target = S(0);     // [m] or [rad]
};
template <class S> struct JointServo {
  S frequency = S(1);  // [Hz]
  S damping = S(1);    // [1] 1 = critical
  S target = S(0);     // [m] or [rad]
  S max_force = S(0);      // [N] or [N m] at most; 0: any
  S mass = S(0);       // [kg] or [kg m^2] that it is made for: AxisDrive::spring_mass
};

/// Fixed, universal and angular joints.
template <class S> struct PlainJoint {
  BodyId a = {}, b = {};
  Pose<S> frame = Pose<S>::identity();
  bool collide = false;  // a and b have contacts with each other
};
/// Hinges, sliders, cylindrical and planar joints. Limit, motor and spring act about z or along it.
template <class S> struct OneAxisJoint {
  BodyId a = {}, b = {};
  Pose<S> frame = Pose<S>::identity();
  std::optional<JointRange<S>> limit = {};
  std::optional<JointMotor<S>> motor = {};
  std::optional<JointSpring<S>> spring = {};
  bool collide = false;
};
/// Ball and constant velocity joints.
template <class S> struct SwingJoint {
  BodyId a = {}, b = {};
  Pose<S> frame = Pose<S>::identity();
  std::optional<S> cone = {};               // [rad] most between the z axes
  std::optional<JointRange<S>> twist = {};  // of a ball joint
  bool collide = false;
};
/// Rods, ropes and springs between two points.
template <class S> struct TwoPointJoint {
  BodyId a = {}, b = {};
  Vec3<S> anchor_a = Vec3<S>::zero(), anchor_b = Vec3<S>::zero();  // [m] world
  S length = S(0);                                                 // [m]
  std::optional<JointSpring<S>> spring = {};                       // its target is `length`
  bool collide = false;
};
/// A wheel b below a chassis a. The frame's y points up along the suspension, z along the axle to the left, x to the
/// rear. A positive speed then rolls the car forwards, as it does for a Wheel.
template <class S> struct WheelJoint {
  BodyId a = {}, b = {};
  Pose<S> frame = Pose<S>::identity();
  JointSpring<S> suspension = {};
  JointRange<S> travel = {S(0), S(0)};      // [m] along y
  std::optional<JointServo<S>> steer = {};  // [rad] about y; without it the wheel does not steer
  std::optional<JointMotor<S>> drive = {};  // of the spin about z; a speed of 0 brakes
  bool collide = false;
};
/// Six servos that move b's frame to a's, as far as their forces allow.
template <class S> struct MotorJoint {
  BodyId a = {}, b = {};
  Pose<S> frame_a = Pose<S>::identity(), frame_b = Pose<S>::identity();
  JointServo<S> place = {};
  JointServo<S> turn = {};
  bool collide = true;
};
/// A six-axis joint with locks and drives of your choice.
template <class S> struct SixAxisDefinition {
  BodyId a = {}, b = {};
  Pose<S> frame = Pose<S>::identity();
  std::uint32_t locks = 0;  // joint_flag::kLock..., and kCone
  AxisDrive<S> drives[kJointAxes];
  std::uint32_t drive_count = 0;
  bool collide = false;
};

namespace detail {
template <class S, class Preset>
ISO_INLINE JointDefinition<S> definition_of(JointType type, const Preset& preset, std::uint32_t flags = 0) {
  JointDefinition<S> made;
  made.a = preset.a;
  made.b = preset.b;
  if constexpr (requires { preset.frame; }) made.frame_a = made.frame_b = preset.frame;
  made.settings.type = type;
  made.settings.flags = flags | (preset.collide ? joint_flag::kCollideConnected : 0);
  return made;
}
template <class S> ISO_INLINE void set_limit(JointProperties<S>& joint, const JointRange<S>& range) {
  joint.flags |= joint_flag::kLimit;
  joint.lower = range.lower;
  joint.upper = range.upper;
}
template <class S> ISO_INLINE void set_spring(JointProperties<S>& joint, const JointSpring<S>& spring) {
  joint.flags |= joint_flag::kSpring;
  joint.spring_frequency = spring.frequency;
  joint.spring_damping = spring.damping;
  joint.spring_target = spring.target;
}
template <class S> ISO_INLINE JointDefinition<S> one_axis(JointType type, const OneAxisJoint<S>& preset) {
  JointDefinition<S> made = definition_of<S>(type, preset);
  if (preset.limit) set_limit(made.settings, *preset.limit);
  if (preset.spring) set_spring(made.settings, *preset.spring);
  if (!preset.motor) return made;
  made.settings.flags |= joint_flag::kMotor;
  made.settings.motor_speed = preset.motor->speed;
  made.settings.max_force = preset.motor->max_force;
  return made;
}
template <class S> ISO_INLINE JointDefinition<S> swing(JointType type, const SwingJoint<S>& preset) {
  JointDefinition<S> made = definition_of<S>(type, preset);
  if (preset.twist) set_limit(made.settings, *preset.twist);
  if (!preset.cone) return made;
  made.settings.flags |= joint_flag::kCone;
  made.settings.cone = *preset.cone;
  return made;
}
template <class S> ISO_INLINE JointDefinition<S> two_points(const TwoPointJoint<S>& preset, S lower) {
  JointDefinition<S> made = definition_of<S>(JointType::distance, preset);
  made.frame_a.position = preset.anchor_a;
  made.frame_b.position = preset.anchor_b;
  if (preset.spring) {
    set_spring(made.settings, *preset.spring);
    made.settings.spring_target = preset.length;
  } else {
    set_limit(made.settings, {lower, preset.length});
  }
  return made;
}
template <class S> ISO_INLINE AxisDrive<S>& add_drive(JointDefinition<S>& to, JointAxis axis) {
  AxisDrive<S>& drive = to.drives[to.drive_count++];
  drive.axis = axis;
  return drive;
}
template <class S> ISO_INLINE void add_servo(JointDefinition<S>& to, JointAxis axis, const JointServo<S>& servo) {
  AxisDrive<S>& drive = add_drive(to, axis);
  drive.spring_frequency = servo.frequency;
  drive.spring_damping = servo.damping;
  drive.spring_target = servo.target;
  drive.max_force = servo.max_force;
  drive.spring_mass = servo.mass;
}
}  // namespace detail

/// The origins of the frames coincide.
template <class S> ISO_INLINE JointDefinition<S> ball(const SwingJoint<S>& of) {
  return detail::swing(JointType::ball, of);
}
/// The origins coincide, and b does not twist against a. `twist` has no meaning here.
template <class S> ISO_INLINE JointDefinition<S> constant_velocity(const SwingJoint<S>& of) {
  return detail::swing(JointType::constant_velocity, of);
}
template <class S> ISO_INLINE JointDefinition<S> fixed(const PlainJoint<S>& of) {
  return detail::definition_of<S>(JointType::fixed, of);
}
template <class S> ISO_INLINE JointDefinition<S> universal(const PlainJoint<S>& of) {
  return detail::definition_of<S>(JointType::universal, of);
}
/// Holds the orientation only.
template <class S> ISO_INLINE JointDefinition<S> angular(const PlainJoint<S>& of) {
  return detail::definition_of<S>(JointType::angular, of);
}
template <class S> ISO_INLINE JointDefinition<S> hinge(const OneAxisJoint<S>& of) {
  return detail::one_axis(JointType::hinge, of);
}
template <class S> ISO_INLINE JointDefinition<S> slider(const OneAxisJoint<S>& of) {
  return detail::one_axis(JointType::slider, of);
}
template <class S> ISO_INLINE JointDefinition<S> cylindrical(const OneAxisJoint<S>& of) {
  return detail::one_axis(JointType::cylindrical, of);
}
template <class S> ISO_INLINE JointDefinition<S> planar(const OneAxisJoint<S>& of) {
  return detail::one_axis(JointType::planar, of);
}
/// Keeps two points `length` apart.
template <class S> ISO_INLINE JointDefinition<S> rod(const TwoPointJoint<S>& of) {
  return detail::two_points(of, of.length);
}
/// Keeps two points no further than `length` apart.
template <class S> ISO_INLINE JointDefinition<S> rope(const TwoPointJoint<S>& of) {
  return detail::two_points(of, S(0));
}
template <class S> ISO_INLINE JointDefinition<S> wheel(const WheelJoint<S>& of) {
  const std::uint32_t steers = of.steer ? 0 : joint_flag::kLockSwingY;
  JointDefinition<S> made = detail::definition_of<S>(
      JointType::six_axis, of, joint_flag::kLockX | joint_flag::kLockZ | joint_flag::kLockSwingX | steers);
  AxisDrive<S>& suspension = detail::add_drive(made, JointAxis::y);
  suspension.limited = true;
  suspension.lower = of.travel.lower;
  suspension.upper = of.travel.upper;
  suspension.spring_frequency = of.suspension.frequency;
  suspension.spring_damping = of.suspension.damping;
  suspension.spring_target = of.suspension.target;
  if (of.steer) detail::add_servo(made, JointAxis::swing_y, *of.steer);
  if (!of.drive) return made;
  AxisDrive<S>& spin = detail::add_drive(made, JointAxis::twist);
  spin.motor = true;
  spin.motor_speed = of.drive->speed;
  spin.max_force = of.drive->max_force;
  return made;
}
template <class S> ISO_INLINE JointDefinition<S> motor(const MotorJoint<S>& of) {
  JointDefinition<S> made = detail::definition_of<S>(JointType::six_axis, of);
  made.frame_a = of.frame_a;
  made.frame_b = of.frame_b;
  for (const JointAxis axis : {JointAxis::x, JointAxis::y, JointAxis::z}) detail::add_servo(made, axis, of.place);
  for (const JointAxis axis : {JointAxis::swing_x, JointAxis::swing_y, JointAxis::twist})
    detail::add_servo(made, axis, of.turn);
  return made;
}
template <class S> ISO_INLINE JointDefinition<S> six_axis(const SixAxisDefinition<S>& of) {
  JointDefinition<S> made = detail::definition_of<S>(JointType::six_axis, of, of.locks);
  for (std::uint32_t i = 0; i < kJointAxes; ++i) made.drives[i] = of.drives[i];
  made.drive_count = of.drive_count;
  return made;
}

}  // namespace isostep
