// JointLoad: what a joint bears, and how much of it breaks the joint.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using JointLoadId = Id<struct JointLoadTag>;

/// Measures a joint. Every step writes JointLoadState, the mean over its sub-steps, so that their number does not
/// decide what breaks. A step with a mean above its limit destroys the joint, and this record with it;
/// events().joint_broke reports it. One record a joint. Sleeping joints are not measured.
template <class S> struct JointLoad {
  JointId joint = {};
  S break_force = S(0);   // [N] 0: no force breaks it
  S break_torque = S(0);  // [N m] 0: no torque breaks it

  ISO_FIELDS(joint, break_force, break_torque)
};

/// The load of a joint in the last step, which the step writes.
template <class S> struct JointLoadState {
  S force = S(0);   // [N] on body b, of all the joint does; held at the format's end
  S torque = S(0);  // [N m] about b's origin of the joint; held at the format's end

  ISO_FIELDS(force, torque)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<JointLoad<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const JointLoad<S>& l) {
    NumberChecks<S> checks;
    checks.not_negative(l.break_force, "break_force");
    checks.not_negative(l.break_torque, "break_torque");
    return checks.list.report();
  }
  static FaultReport fault(const JointLoadState<S>& l) {
    NumberChecks<S> checks;
    checks.not_negative(l.force, "force");
    checks.not_negative(l.torque, "torque");
    return checks.list.report();
  }
  static constexpr OnlyOne only_one(const JointLoad<S>&) { return kOneAJoint; }
  static RecordKey key(const JointLoad<S>& l) { return {l.joint.slot}; }
  static constexpr NamedJoints joints(const JointLoad<S>& l) { return {{l.joint}, 1}; }
  template <class Random> static void draw(JointLoad<S>& l, Random& random) {
    l.joint = random.joint();
    if (random.one_in(2)) l.break_force = random.in(0, 400);
    if (random.one_in(2)) l.break_torque = random.in(0, 100);
  }
};

}  // namespace isostep::detail
