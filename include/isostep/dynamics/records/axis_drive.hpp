// AxisDrive: what acts along one free axis of a six-axis joint: limits, a motor, a spring or a servo.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep {

using AxisDriveId = Id<struct AxisDriveTag>;

/// The axes of a six-axis joint, in the order of its rows: b's origin along x, y and z of frame a; the swing of b's z
/// axis about x and y of a; the twist about z.
enum class JointAxis : std::uint32_t { x, y, z, swing_x, swing_y, twist };

/// The words for it, in scene files and in C.
inline constexpr const char* kJointAxisNames[] = {"x", "y", "z", "swing_x", "swing_y", "twist"};
ISO_INLINE constexpr std::span<const char* const> words_of(JointAxis) { return kJointAxisNames; }
inline constexpr std::uint32_t kJointAxes = kJointRows;

ISO_INLINE constexpr bool is_length(JointAxis axis) { return axis < JointAxis::swing_x; }
ISO_INLINE constexpr std::uint32_t lock_of(JointAxis axis) {
  return joint_flag::kLockX << static_cast<std::uint32_t>(axis);
}

/// Acts along one axis that its six-axis joint does not lock. An axis has at most one; without one it is free. It ends
/// with its joint.
/// Servo: a spring with a largest force and without a motor. It moves to its target as far as its force allows.
/// Stiffness: spring_mass (2 pi frequency)^2, at most as for 2^20 times the mass of its two bodies, 2^14 in Q16.16.
/// With spring_mass 0 a spring has its frequency for those two alone, where the joint's frames coincide, and yields
/// under the weight of bodies that hang on them. Its stiffness is the same in every pose. In a kCone both swings have
/// the stiffer spring of the two. A twist or a single turn without limits is pulled the shorter way round.
/// Soft limits: beyond them a spring of `limit_frequency` and `limit_damping` pulls back, beside spring and motor. A
/// servo rests there. Those of a kCone are swing_x's.
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
  S max_force = S(0);         // [N] or [N m] most that the motor gives; without a motor the spring, 0: any
  S spring_mass = S(0);       // [kg] or [kg m^2] that springs and soft limits are made for; 0: what they feel
  S limit_frequency = S(0);   // [Hz] of limits that yield, up to half the sub-step rate; 0: hard ones
  S limit_damping = S(0);     // [1] ratio, 1 = critical

  ISO_FIELDS(joint, axis, limited, motor, lower, upper, motor_speed, spring_target, spring_frequency, spring_damping,
             max_force, spring_mass, limit_frequency, limit_damping)
};

/// A record during a step. `joint` is the index of the joint among the awake ones.
template <class S> struct JointAxisDrive {
  std::uint32_t joint;
  const AxisDrive<S>* drive;
};

}  // namespace isostep

namespace isostep::detail {

/// Checks a drive against its joint.
template <class S>
FaultReport fault_of_joint(const AxisDrive<S>& d, const JointProperties<S>& joint, std::int32_t substep_rate) {
  const bool cone = (joint.flags & joint_flag::kCone) != 0 && d.limited &&
                    (d.axis == JointAxis::swing_x || d.axis == JointAxis::swing_y);
  return Checklist()
      .proper(joint.type == JointType::six_axis, "joint", "a six-axis joint")
      .proper((joint.flags & lock_of(d.axis)) == 0, "axis", "one that the joint does not lock")
      .proper(!cone || d.lower == -d.upper, "lower", "-upper: the joint's kCone makes an ellipse of them")
      .in_range(d.spring_frequency <= S(substep_rate) * S(0.5), "spring_frequency", "up to half the sub-step rate")
      .in_range(d.limit_frequency <= S(substep_rate) * S(0.5), "limit_frequency", "up to half the sub-step rate")
      .report();
}

template <class S> struct RecordRules<AxisDrive<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const AxisDrive<S>& d) {
    if (kJointAxes <= static_cast<std::uint32_t>(d.axis)) return {Fault::bad_argument, "", "axis", "one of JointAxis"};
    const bool length = is_length(d.axis), sprung = S(0) < d.spring_frequency;
    const S reach = length ? Limits<S>::position() : kMaxAngle<S> * S(0.5);
    const char* expected = length ? "lengths up to Limits::position()" : "-pi to pi";
    NumberChecks<S> checks;
    checks.not_negative(d.spring_frequency, "spring_frequency");
    checks.not_negative(d.max_force, "max_force");
    checks.not_negative(d.spring_mass, "spring_mass");
    checks.not_negative(d.limit_frequency, "limit_frequency");
    return checks.list.also(fault_of_drive(d, length, reach, expected))
        .proper(d.lower <= d.upper, "lower", "no more than upper")
        .proper(!sprung || S(0) <= d.spring_damping, "spring_damping", "0 to 64")
        .in_range(d.spring_mass <= Limits<S>::mass(), "spring_mass", "0 to Limits::mass()")
        .finite(d.limit_damping, "limit_damping")
        .proper(S(0) <= d.limit_damping && d.limit_damping <= kMaxDampingRatio<S>, "limit_damping", "0 to 64")
        .report();
  }
  static constexpr OnlyOne only_one(const AxisDrive<S>&) { return {"axis", "an axis that has no record yet"}; }
  static RecordKey key(const AxisDrive<S>& d) { return {d.joint.slot, static_cast<std::uint32_t>(d.axis)}; }
  static constexpr NamedJoints joints(const AxisDrive<S>& d) { return {{d.joint}, 1}; }
  static FaultReport fault_at(const AxisDrive<S>& d, const RecordPlace<S>& place) {
    return fault_of_joint(d, *place.joints[0].properties, substep_rate(place.settings));
  }
};

/// Checks all drives of a joint to be created.
template <class S>
FaultReport fault_of_drives(std::span<const AxisDrive<S>> drives, const JointProperties<S>& joint,
                            std::int32_t substep_rate) {
  std::uint32_t taken = 0;
  for (const AxisDrive<S>& drive : drives) {
    const FaultReport fault = RecordRules<AxisDrive<S>>::fault(drive),
                      of_joint = fault_of_joint(drive, joint, substep_rate);
    if (fault != Fault::none) return fault;
    if (of_joint != Fault::none) return of_joint;
    if ((taken & lock_of(drive.axis)) != 0) return {Fault::bad_argument, "", "axis", "each axis once"};
    taken |= lock_of(drive.axis);
  }
  return {};
}

}  // namespace isostep::detail
