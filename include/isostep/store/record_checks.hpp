// What is required of records that are no forces, as force_checks.hpp has it of forces.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/dynamics/records/record_list.hpp"
#include "isostep/dynamics/wheel_rows.hpp"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/store/contact_record_checks.hpp"
#include "isostep/store/force_checks.hpp"

namespace isostep::detail {

template <class S> FaultReport fault_of(const MaterialPair<S>& p) {
  return Checklist()
      .finite(p.friction, "friction")
      .finite(p.static_friction, "static_friction")
      .finite(p.restitution, "restitution")
      .finite(p.rolling_resistance, "rolling_resistance")
      .finite(p.spin_resistance, "spin_resistance")
      .in_range(p.friction <= kMaxFriction<S>, "friction", "0 to 16")
      .in_range(p.static_friction <= kMaxFriction<S>, "static_friction", "0 to 16")
      .in_range(p.rolling_resistance <= Limits<S>::extent(), "rolling_resistance", "0 to Limits::extent()")
      .in_range(p.spin_resistance <= Limits<S>::extent(), "spin_resistance", "0 to Limits::extent()")
      .proper(p.kind_a != 0, "kind_a", "1 or more")
      .proper(p.kind_b != 0, "kind_b", "1 or more")
      .proper(S(0) <= p.friction, "friction", "0 to 16")
      .proper(S(0) <= p.static_friction, "static_friction", "0 to 16")
      .proper(S(0) <= p.restitution && p.restitution <= S(1), "restitution", "0 to 1")
      .proper(S(0) <= p.rolling_resistance, "rolling_resistance", "0 to Limits::extent()")
      .proper(S(0) <= p.spin_resistance, "spin_resistance", "0 to Limits::extent()")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const MaterialPair<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const Breakable<S>& b) {
  constexpr std::uint32_t kMostPieces = 256, kMostDepth = 16;
  const bool boxes = b.pattern == BreakPattern::eight_boxes;
  return Checklist()
      .finite(b.impulse, "impulse")
      .finite(b.small_mass, "small_mass")
      .finite(b.broken_by, "broken_by")
      .also(fault_of_place(b.hit_point, "hit_point"))
      .proper(b.pattern <= BreakPattern::voronoi, "pattern", "one of BreakPattern")
      .proper((boxes ? 8u : 2u) <= b.most_pieces && b.most_pieces <= kMostPieces, "most_pieces",
              "2 to 256, of eight_boxes 8 or more")
      .proper(b.depth <= kMostDepth, "depth", "0 to 16")
      .proper(is_direction<S>(b.grain), "grain", "a vector of length 1")
      .proper(S(0) <= b.impulse, "impulse", kZeroOrMore)
      .proper(S(0) <= b.small_mass, "small_mass", kZeroOrMore)
      .proper(S(0) <= b.broken_by, "broken_by", kZeroOrMore)
      .proper(b.hit_direction == Vec3<Unit<S>>::zero() || is_direction<S>(b.hit_direction), "hit_direction",
              "a vector of length 1, or 0")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const Breakable<S>& b) {
  return {{{b.body, "body", false, MustBe::dynamic, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const Character<S>& c) {
  const S least = Limits<S>::minimum_size() * S(0.0625), speed = Limits<S>::speed() * S(0.5);
  constexpr const char* kSlow = "up to half of Limits::speed()";
  return Checklist()
      .finite(c.step_height, "step_height")
      .finite(c.least_up, "least_up")
      .finite(c.skin, "skin")
      .finite(c.mass, "mass")
      .finite(c.push_force, "push_force")
      .finite(c.air_acceleration, "air_acceleration")
      .finite(c.gravity_scale, "gravity_scale")
      .finite(c.move, "move")
      .finite(c.jump, "jump")
      .finite(c.velocity, "velocity")
      .also(fault_of_place(c.foot, "foot"))
      .also(fault_of_place(c.foot_at, "foot_at"))
      .in_range(c.step_height <= Limits<S>::extent(), "step_height", "0 to Limits::extent()")
      .in_range(c.mass <= Limits<S>::mass(), "mass", "0 to Limits::mass()")
      .in_range(c.air_acceleration <= Limits<S>::speed(), "air_acceleration", "0 to Limits::speed()")
      .in_range(within(c.gravity_scale, S(16)), "gravity_scale", "a size up to 16")
      .in_range(no_longer(c.move, speed), "move", kSlow)
      .in_range(c.jump <= speed, "jump", "0 to half of Limits::speed()")
      .in_range(within(c.velocity, Limits<S>::speed()), "velocity", "components up to Limits::speed()")
      .proper(S(0) <= c.step_height, "step_height", "0 to Limits::extent()")
      .proper(S(0) < c.least_up && c.least_up <= S(1), "least_up", "above 0, up to 1")
      .proper(least <= c.skin && c.skin <= S(0.25), "skin", "Limits::minimum_size() / 16 to 0.25")
      .proper(S(0) <= c.mass, "mass", "0 to Limits::mass()")
      .proper(S(0) <= c.push_force, "push_force", kZeroOrMore)
      .proper(S(0) <= c.air_acceleration, "air_acceleration", "0 to Limits::speed()")
      .proper(S(0) <= c.jump, "jump", "0 to half of Limits::speed()")
      .proper(c.footing <= Footing::steep, "footing", "one of Footing")
      .proper(c.normal == Vec3<Unit<S>>::zero() || is_direction<S>(c.normal), "normal", "a vector of length 1, or 0")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const Character<S>& c) {
  return {{{c.body, "body", false, MustBe::kinematic, Vec3<S>::zero(), ""}, {}}, 1};
}

inline constexpr char kPart[] = "0 to 1", kInput[] = "-1 to 1", kLeastSize[] = "Limits::minimum_size() or more";
inline constexpr char kDirection[] = "a vector of length 1";

/// Further questions to a list, each about one number.
template <class S> struct NumberChecks {
  Checklist list;

  void not_negative(S x, const char* field) { list.finite(x, field).proper(S(0) <= x, field, kZeroOrMore); }
  void part(S x, const char* field) { list.finite(x, field).proper(S(0) <= x && x <= S(1), field, kPart); }
  void input(S x, const char* field) { list.finite(x, field).proper(within(x, S(1)), field, kInput); }
  void size(S x, const char* field) {
    list.finite(x, field)
        .in_range(x <= Limits<S>::extent(), field, "up to Limits::extent()")
        .proper(Limits<S>::minimum_size() <= x, field, kLeastSize);
  }
  void grip(S x, const char* field) {
    list.finite(x, field).in_range(x <= kMaxFriction<S>, field, "0 to 16").proper(S(0) <= x, field, "0 to 16");
  }
  void size_of_slip(S x, const char* field) {
    list.finite(x, field).in_range(x <= S(4), field, "2^-10 to 4").proper(S(0x1p-10) <= x, field, "2^-10 to 4");
  }
  void direction(const Vec3<Unit<S>>& v, const char* field) { list.proper(is_direction<S>(v), field, kDirection); }
};

template <class S> FaultReport fault_of(const Vehicle<S>& v) {
  NumberChecks<S> checks;
  checks.not_negative(v.engine_torque, "engine_torque");
  checks.not_negative(v.engine_speed, "engine_speed");
  for (const S gear : v.gears) checks.list.finite(gear, "gears");
  checks.list.proper(v.gear < kMostGears, "gear", "0 to 7");
  checks.list.finite(v.final_drive, "final_drive");
  checks.list.finite(v.engine_inertia, "engine_inertia")
      .proper(v.engine_inertia == S(0) || S(0x1p-10) <= v.engine_inertia, "engine_inertia", "0, or 2^-10 or more");
  checks.not_negative(v.clutch_torque, "clutch_torque");
  checks.part(v.differential_lock, "differential_lock");
  checks.not_negative(v.brake_torque, "brake_torque");
  checks.not_negative(v.handbrake_torque, "handbrake_torque");
  checks.part(v.ackermann, "ackermann");
  checks.list.finite(v.track_steer, "track_steer")
      .proper(S(0) <= v.track_steer && v.track_steer <= S(2), "track_steer", "0 to 2");
  checks.input(v.throttle, "throttle");
  checks.part(v.clutch, "clutch");
  checks.part(v.brake, "brake");
  checks.part(v.handbrake, "handbrake");
  checks.input(v.steer, "steer");
  checks.list.finite(v.engine_spin, "engine_spin")
      .in_range(within(v.engine_spin, fastest_engine<S>()), "engine_spin", "a size up to fastest_engine()");
  checks.list.finite(v.clutch_load, "clutch_load");
  return checks.list.report();
}
template <class S> NamedBodies<S> bodies_of(const Vehicle<S>& v) {
  return {{{v.body, "body", false, MustBe::dynamic, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const Wheel<S>& w) {
  constexpr S kMostSteer = S(1.570796326794896619);  // [rad]
  NumberChecks<S> checks;
  checks.list.also(fault_of_place(w.hard_point, "hard_point"));
  checks.direction(w.suspension, "suspension");
  checks.direction(w.axle_direction, "axle_direction");
  checks.list.proper(within(dot(w.axle_direction, w.suspension), Unit<S>(0.5)), "axle_direction",
                     "one across the suspension, to 30 degrees");
  checks.size(w.free_length, "free_length");
  checks.not_negative(w.travel, "travel");
  checks.list.proper(w.travel <= w.free_length, "travel", "0 to free_length");
  checks.not_negative(w.stiffness, "stiffness");
  checks.not_negative(w.damping, "damping");
  checks.size(w.radius, "radius");
  checks.list.finite(w.inertia, "inertia").proper(S(0) < w.inertia, "inertia", "above 0");
  checks.grip(w.grip_along, "grip_along");
  checks.grip(w.grip_across, "grip_across");
  checks.size_of_slip(w.peak_slip, "peak_slip");
  checks.grip(w.peak_grip, "peak_grip");
  checks.size_of_slip(w.slide_slip, "slide_slip");
  checks.list.proper(w.peak_slip < w.slide_slip, "slide_slip", "above peak_slip");
  checks.grip(w.slide_grip, "slide_grip");
  checks.list.finite(w.steer_angle, "steer_angle")
      .in_range(within(w.steer_angle, kMostSteer), "steer_angle", "-pi/2 to pi/2");
  checks.part(w.drive_share, "drive_share");
  checks.part(w.brake_share, "brake_share");
  checks.part(w.handbrake_share, "handbrake_share");
  checks.not_negative(w.anti_roll, "anti_roll");
  checks.list.finite(w.spin, "spin").finite(w.angle, "angle").finite(w.length, "length");
  checks.list.finite(w.steered, "steered");
  checks.list.finite(w.slip, "slip").proper(S(0) <= w.slip && w.slip <= S(4), "slip", "0 to 4");
  checks.list.finite(w.contact_point, "contact_point").finite(w.contact_normal, "contact_normal");
  checks.list.in_range(within(w.angle, kMaxAngle<S>), "angle", "-2 pi to 2 pi");
  checks.list.in_range(within(w.steered, kMaxAngle<S>), "steered", "-2 pi to 2 pi");
  checks.not_negative(w.load, "load");
  checks.list.finite(w.along, "along").finite(w.across, "across");
  return checks.list.report();
}
template <class S> NamedBodies<S> bodies_of(const Wheel<S>& w) {
  return {{{w.body, "body", false, MustBe::dynamic, w.hard_point, "hard_point"}, {}}, 1};
}
template <class S> FaultReport fault_of(const JointLoad<S>& l) {
  NumberChecks<S> checks;
  checks.not_negative(l.break_force, "break_force");
  checks.not_negative(l.break_torque, "break_torque");
  checks.not_negative(l.force, "force");
  checks.not_negative(l.torque, "torque");
  return checks.list.report();
}
template <class S> NamedBodies<S> bodies_of(const JointLoad<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const AxisDrive<S>& d) {
  if (kJointAxes <= static_cast<std::uint32_t>(d.axis)) return {Fault::bad_argument, "", "axis", "one of JointAxis"};
  const bool length = is_length(d.axis), sprung = S(0) < d.spring_frequency;
  const S reach = length ? Limits<S>::position() : kMaxAngle<S> * S(0.5);
  const char* expected = length ? "lengths up to Limits::position()" : "-pi to pi";
  NumberChecks<S> checks;
  checks.not_negative(d.spring_frequency, "spring_frequency");
  checks.not_negative(d.force, "force");
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
template <class S> NamedBodies<S> bodies_of(const AxisDrive<S>&) { return {{}, 0}; }
/// Of a drive with the joint that it names.
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
/// The record on that axis of a joint; null where there is none.
template <class S> AxisDriveId drive_on(const ForceRecords<S>& records, JointId joint, JointAxis axis) {
  return records.axis_drives.id_where(
      [&](const AxisDrive<S>& drive) { return drive.joint == joint && drive.axis == axis; });
}

/// Of all drives that a joint is to have.
template <class S>
FaultReport fault_of_drives(std::span<const AxisDrive<S>> drives, const JointProperties<S>& joint,
                            std::int32_t substep_rate) {
  std::uint32_t taken = 0;
  for (const AxisDrive<S>& drive : drives) {
    const FaultReport fault = fault_of(drive), of_joint = fault_of_joint(drive, joint, substep_rate);
    if (fault != Fault::none) return fault;
    if (of_joint != Fault::none) return of_joint;
    if ((taken & lock_of(drive.axis)) != 0) return {Fault::bad_argument, "", "axis", "each axis once"};
    taken |= lock_of(drive.axis);
  }
  return {};
}

template <class S> FaultReport fault_of(const Coupling<S>& c) {
  const S ratios[] = {c.ratio_a, c.ratio_b, c.ratio_c}, most = S(kMostTeeth);
  constexpr const char* kRatios[] = {"ratio_a", "ratio_b", "ratio_c"};
  constexpr const char* kRatio = "a size from 1 / 1024 to 1024";
  Checklist list;
  for (int i = 0; i < (c.joint_c ? 3 : 2); ++i) {
    list.finite(ratios[i], kRatios[i]).in_range(within(ratios[i], most), kRatios[i], kRatio);
    list.proper(S(1) / most <= abs(ratios[i]), kRatios[i], kRatio);
  }
  return list.finite(c.ratio_c, "ratio_c")
      .finite(c.lower, "lower")
      .finite(c.upper, "upper")
      .in_range(within(c.lower, Limits<S>::position()), "lower", "up to Limits::position()")
      .in_range(within(c.upper, Limits<S>::position()), "upper", "up to Limits::position()")
      .proper(c.lower <= c.upper, "upper", "lower or more")
      .proper(!(c.joint_a == c.joint_b), "joint_b", "another joint than joint_a")
      .proper(!c.joint_c || (!(c.joint_a == c.joint_c) && !(c.joint_b == c.joint_c)), "joint_c",
              "another joint than joint_a and joint_b")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const Coupling<S>&) { return {{}, 0}; }
/// Of a coupling with the joints that it names: whether each has a coordinate, and teeth where that is an angle.
template <class S> FaultReport fault_of_joints(const Coupling<S>& c, const JointProperties<S>* const (&joints)[3]) {
  const S ratios[] = {c.ratio_a, c.ratio_b, c.ratio_c};
  constexpr const char *kJoints[] = {"joint_a", "joint_b", "joint_c"}, *kRatios[] = {"ratio_a", "ratio_b", "ratio_c"};
  Checklist list;
  bool turns = false;
  for (int i = 0; i < 3; ++i) {
    if (joints[i] == nullptr) continue;
    const bool angle = measure_of(joints[i]->type) == JointMeasure::angle;
    const bool whole = ratios[i] == S(static_cast<int>(floor_scaled(ratios[i], 0)));
    list.proper(has_coordinate(joints[i]->type), kJoints[i], "a hinge, slider, cylindrical, planar or distance joint")
        .proper(!angle || whole, kRatios[i], "a whole number: the joint's position is an angle");
    turns = turns || angle;
  }
  return list.proper(!turns || c.upper - c.lower < S(6.28), "upper", "less than a turn above lower").report();
}

/// Whether tyre and body are within the range of masses that one row bears.
template <class S> FaultReport fault_of_inertia(const Wheel<S>& w, const BodyProperties<S>& body) {
  return Checklist()
      .in_range(rim_give(body.mass, w.radius, w.inertia) <= Limits<S>::leverage(), "inertia",
                "mass radius^2 / inertia up to Limits::leverage()")
      .report();
}

/// Whether a character can have a shape of these parts: it is cast, as one.
template <class S> ISO_INLINE bool can_walk(std::span<const Child<S>> parts) {
  return parts.size() == 1 && !is_surface(parts[0].primitive.type) && is_bounded(parts[0].primitive.type);
}

}  // namespace isostep::detail
