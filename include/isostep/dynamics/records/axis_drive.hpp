// AxisDrive: what acts along one free axis of a six-axis joint: limits, a motor, a spring or a servo.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/id.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"

namespace isostep {

using AxisDriveId = Id<struct AxisDriveTag>;

/// The axes of a six-axis joint, in the order of its rows: b's origin along x, y and z of frame a; the swing of b's z
/// axis about x and y of a, and the twist about z.
enum class JointAxis : std::uint32_t { x, y, z, swing_x, swing_y, twist };
inline constexpr std::uint32_t kJointAxes = kJointRows;

ISO_INLINE constexpr bool is_length(JointAxis axis) { return axis < JointAxis::swing_x; }
ISO_INLINE constexpr std::uint32_t lock_of(JointAxis axis) {
  return joint_flag::kLockX << static_cast<std::uint32_t>(axis);
}

/// Acts along one axis of a six-axis joint, which does not lock it. An axis has one of these at most; one without is
/// free. It ends with its joint.
/// Servo: a spring with a largest force and no motor beside it: it goes to its target as far as it is strong enough.
/// Stiffness: spring_mass (2 pi frequency)^2, at most as of 2^20 times what its two bodies weigh, 2^14 in Q16.16. With
/// spring_mass 0 a spring has its frequency between those two alone, where the joint's frames coincide, and gives under
/// the weight of what else hangs on them. It is as stiff in every other pose. In a kCone the stiffer of both swings'
/// springs acts on both. A twist or a single turn without limits is pulled the shorter way round.
/// Soft limits: beyond them a spring of `limit_frequency` and `limit_damping` pulls back, beside the spring and the
/// motor; a servo rests there. Those of a kCone are swing_x's.
template <class S> struct AxisDrive {
  JointId joint = {};
  JointAxis axis = JointAxis::x;
  bool limited = false;  // lower..upper holds
  bool motor = false;
  S lower = S(0);  // [m] or [rad] in (-pi, pi]
  S upper = S(0);
  S motor_speed = S(0);       // [m/s] or [rad/s] of b against a; 0: the motor is a brake, or friction
  S spring_target = S(0);     // [m] or [rad]
  S spring_frequency = S(0);  // [Hz] up to half the sub-step rate; 0: no spring
  S spring_damping = S(0);    // [1] ratio, 1 = critical
  S force = S(0);             // [N] or [N m] most that the motor gives; without a motor the spring, 0: any
  S spring_mass = S(0);       // [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel
  S limit_frequency = S(0);   // [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones
  S limit_damping = S(0);     // [1] ratio, 1 = critical

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("joint", self.joint);
    visit("axis", self.axis);
    visit("limited", self.limited);
    visit("motor", self.motor);
    visit("lower", self.lower);
    visit("upper", self.upper);
    visit("motor_speed", self.motor_speed);
    visit("spring_target", self.spring_target);
    visit("spring_frequency", self.spring_frequency);
    visit("spring_damping", self.spring_damping);
    visit("force", self.force);
    visit("spring_mass", self.spring_mass);
    visit("limit_frequency", self.limit_frequency);
    visit("limit_damping", self.limit_damping);
  }
};

/// A record as a step takes it: `joint` is the joint's place among those that are awake.
template <class S> struct JointAxisDrive {
  std::uint32_t joint;
  const AxisDrive<S>* drive;
};

}  // namespace isostep
