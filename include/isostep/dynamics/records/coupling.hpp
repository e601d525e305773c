// Coupling: a law between the positions of two or three joints: gears, racks, screws, pulleys, differentials.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

using CouplingId = Id<struct CouplingTag>;

/// [1] The most of a ratio of an angle. Q16.16 resolves no larger ratios of speeds: gears of 256 to 1 gained energy.
template <class S> inline constexpr int kMostTeeth = resolution<S>() > S(0x1p-20) ? 128 : 1024;

/// Holds lower <= ratio_a q_a + ratio_b q_b + ratio_c q_c <= upper, where q is World::joint_position of a hinge, a
/// slider, a cylindrical, planar or distance joint. Pushes bodies along these coordinates only: joints hold the rest of
/// the degrees of freedom.
/// Angles:  if one of them is an angle the sum counts modulo 2 pi and ratios of angles are whole numbers, of teeth:
///          turns are not counted: a gear stays in mesh after any number of turns. lower..upper is less than a turn.
/// Method:  one row over the bodies of all joints, solved in turn with joints and contacts and warm started with most
///          of its last impulse. If joints resist it: once, before them. A sub-step closes a fifth of an error, by
///          speed that does not stay. Precision: joints/README.md.
/// It ends with any of its joints.
template <class S> struct Coupling {
  JointId joint_a = {}, joint_b = {};
  JointId joint_c = {};  // null: of two joints
  S ratio_a = S(1);      // [1] of an angle, a whole number up to kMostTeeth; [rad/m] of a length beside an angle
  S ratio_b = S(1);
  S ratio_c = S(0);
  S lower = S(0);  // [rad], of lengths alone [m]
  S upper = S(0);

  ISO_FIELDS(joint_a, joint_b, joint_c, ratio_a, ratio_b, ratio_c, lower, upper)
};

/// The state of a coupling after its last sub-step, which the step writes. 0 if one of its joints is disabled.
template <class S> struct CouplingState {
  S load = S(0);  // [N m], of lengths alone [N]: each joint's coordinate is pushed with its ratio times that

  ISO_FIELDS(load)
};

/// Couples wheels on two hinges whose axes point the same way, so that they turn against each other as gears.
template <class S> ISO_INLINE Coupling<S> gears(JointId a, int teeth_a, JointId b, int teeth_b) {
  return {a, b, {}, S(teeth_a), S(teeth_b), S(0), S(0), S(0)};
}
/// Couples a pinion of that radius [m] on a hinge with a rack on a slider. A forward turn moves the rack forwards. A
/// radius that is too small is refused as ratio_b, -1 / radius.
template <class S> ISO_INLINE Coupling<S> rack_and_pinion(JointId hinge, S radius, JointId slider) {
  return {hinge, slider, {}, S(1), -(S(1) / radius), S(0), S(0), S(0)};
}
/// Couples a nut on a slider with a hinge. Every turn of the hinge moves the nut by `pitch` [m] forwards.
template <class S> ISO_INLINE Coupling<S> screw(JointId hinge, S pitch, JointId slider) {
  return rack_and_pinion<S>(hinge, pitch * S(0.159154943091895336), slider);
}
/// Couples the parts of a rope over two wheels. a and b are distance joints from each wheel to the load there. The rope
/// takes `ratio` metres of b for one of a. It only pulls. `rope` [m]: the largest sum of a's part and `ratio` times b's
/// part.
template <class S> ISO_INLINE Coupling<S> pulley(JointId a, JointId b, S ratio, S rope) {
  return {a, b, {}, S(1), ratio, S(0), S(0), rope};
}
/// Couples a shaft that turns as the mean of two others.
template <class S> ISO_INLINE Coupling<S> differential(JointId shaft, JointId left, JointId right) {
  return {shaft, left, right, S(2), S(-1), S(-1), S(0), S(0)};
}
/// Keeps b's position equal to a's: a rod between two cranks, a hand that copies another.
template <class S> ISO_INLINE Coupling<S> mimic(JointId a, JointId b) {
  return {a, b, {}, S(1), S(-1), S(0), S(0), S(0)};
}

}  // namespace isostep

namespace isostep::detail {

/// Checks that each joint of a coupling has a coordinate, and that the ratios of angles are whole numbers.
template <class S>
FaultReport fault_of_joints(const Coupling<S>& c, const NamedJoints& named, const JointSeen<S> (&joints)[3]) {
  const S ratios[] = {c.ratio_a, c.ratio_b, c.ratio_c};
  constexpr const char* kRatios[] = {"ratio_a", "ratio_b", "ratio_c"};
  Checklist list;
  bool turns = false;
  for (int i = 0; i < 3; ++i) {
    if (joints[i].properties == nullptr) continue;
    const bool angle = joints[i].measure == JointMeasure::angle;
    const bool whole = ratios[i] == S(static_cast<int>(floor_scaled(ratios[i], 0)));
    list.proper(joints[i].has_coordinate, named.field(i), "a hinge, slider, cylindrical, planar or distance joint")
        .proper(!angle || whole, kRatios[i], "a whole number: the joint's position is an angle");
    turns = turns || angle;
  }
  return list.proper(!turns || c.upper - c.lower < S(6.28), "upper", "less than a turn above lower").report();
}

template <class S> struct RecordRules<Coupling<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr bool kTies = true;
  static FaultReport fault(const Coupling<S>& c) {
    const S ratios[] = {c.ratio_a, c.ratio_b, c.ratio_c}, most = S(kMostTeeth<S>);
    constexpr const char* kRatios[] = {"ratio_a", "ratio_b", "ratio_c"};
    constexpr const char* kRatio = kMostTeeth<S> == 128 ? "a size from 1 / 128 to 128" : "a size from 1 / 1024 to 1024";
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
        .proper(c.joint_c || c.ratio_c == S(0), "ratio_c", "0 without joint_c")
        .proper(!c.joint_c || (!(c.joint_a == c.joint_c) && !(c.joint_b == c.joint_c)), "joint_c",
                "another joint than joint_a and joint_b")
        .report();
  }
  static FaultReport fault(const CouplingState<S>& c) { return Checklist().finite(c.load, "load").report(); }
  static constexpr NamedJoints joints(const Coupling<S>& c) { return {{c.joint_a, c.joint_b, c.joint_c}, 3}; }
  static FaultReport fault_at(const Coupling<S>& c, const RecordPlace<S>& place) {
    return fault_of_joints(c, joints(c), place.joints);
  }
};

}  // namespace isostep::detail
