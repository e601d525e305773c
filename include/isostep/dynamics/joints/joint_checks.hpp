// fault_of(JointProperties): the numbers that a joint takes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"

namespace isostep::detail {

/// Holds what a kind of joint requires of its record: see JointOf.
template <class S> struct JointRules {
  JointMeasure measure;
  std::uint32_t flags;
  const char* flag_names;
  FaultReport own;
};
template <class S> ISO_INLINE JointRules<S> rules_of(const JointProperties<S>& j) {
  return visit_joint_type(j.type, [&](auto kind) ISO_INLINE_LAMBDA {
    using Joint = typename decltype(kind)::template Of<S>;
    return JointRules<S>{Joint::kMeasure, Joint::kFlags, Joint::kFlagNames, Joint::fault(j)};
  });
}

/// Finds the first fault of a joint's properties in a world of `substep_rate` [1/s].
template <class S> FaultReport fault_of(const JointProperties<S>& j, std::int32_t substep_rate) {
  if (static_cast<std::uint32_t>(j.type) >= kJointTypes) return {Fault::bad_argument, "", "type", "one of JointType"};
  const JointRules<S> rules = rules_of(j);
  const bool length = rules.measure == JointMeasure::length, sprung = (j.flags & joint_flag::kSpring) != 0;
  const S reach = length ? Limits<S>::position() : kMaxAngle<S>;
  const char* expected = length ? "lengths up to Limits::position()" : "-2 pi to 2 pi";
  return Checklist()
      .finite(j.cone, "cone")
      .finite(j.max_force, "max_force")
      .finite(j.spring_frequency, "spring_frequency")
      .finite(j.frame_a.position, "frame_a.position")
      .finite(j.frame_b.position, "frame_b.position")
      .in_range(within(j.frame_a.position, Limits<S>::position()), "frame_a.position", kWithinPosition)
      .in_range(within(j.frame_b.position, Limits<S>::position()), "frame_b.position", kWithinPosition)
      .proper(is_unit<S>(j.frame_a.orientation), "frame_a.orientation", kUnitLength)
      .proper(is_unit<S>(j.frame_b.orientation), "frame_b.orientation", kUnitLength)
      .also(fault_of_drive(j, length, reach, expected))
      .in_range(S(0) <= j.cone && j.cone <= kMaxAngle<S> * S(0.5), "cone", "0 to pi")
      .proper((j.flags & ~rules.flags) == 0, "flags", rules.flag_names)
      .proper(j.lower <= j.upper, "lower", "no more than upper")
      .proper(length || (j.flags & joint_flag::kLimit) == 0 || j.upper - j.lower <= kMaxAngle<S>, "upper",
              "no more than 2 pi above lower: a turn further is the same angle")
      .also(rules.own)
      .proper(S(0) <= j.max_force, "max_force", "0 or more")
      .proper(!sprung || (S(0) < j.spring_frequency && j.spring_frequency <= S(substep_rate) * S(0.5)),
              "spring_frequency", "above 0, up to half the sub-step rate")
      .proper(!sprung || S(0) <= j.spring_damping, "spring_damping", "0 to 64")
      .report();
}

/// Returns true if one of two dynamic bodies is too heavy for a joint with the other: in float a weight that hung on
/// two links of a ten thousandth of it fell by 68 m.
template <class S> ISO_INLINE bool outweighs(const BodyProperties<S>& a, const BodyProperties<S>& b) {
  if (a.type != BodyType::dynamic || b.type != BodyType::dynamic) return false;
  return min(a.mass, b.mass) < max(a.mass, b.mass) * (S(1) / Limits<S>::mass_ratio());
}

}  // namespace isostep::detail
