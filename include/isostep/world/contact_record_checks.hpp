// What is required of the records that say how bodies touch, as force_checks.hpp has it of forces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/record_list.hpp"
#include "isostep/world/force_checks.hpp"

namespace isostep::detail {

template <class S> FaultReport fault_of(const SurfaceVelocity<S>& v) {
  return Checklist()
      .finite(v.linear, "linear")
      .finite(v.angular, "angular")
      .in_range(no_longer(v.linear, Limits<S>::speed()), "linear", kWithinSpeed)
      .in_range(no_longer(v.angular, Limits<S>::angular_speed()), "angular", "a length up to Limits::angular_speed()")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const SurfaceVelocity<S>& v) {
  return {{{v.body, "body", false, MustBe::any, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const Ghost<S>& g) {
  return Checklist().proper(!(g.a == g.b), "b", "another body than a").report();
}
template <class S> NamedBodies<S> bodies_of(const Ghost<S>& g) {
  return {{{g.a, "a", false, MustBe::any, Vec3<S>::zero(), ""}, {g.b, "b", false, MustBe::any, Vec3<S>::zero(), ""}},
          2};
}

template <class S> FaultReport fault_of(const OneWay<S>& w) {
  return Checklist()
      .proper(is_direction<S>(w.axis), "axis", "a vector of length 1")
      .finite(w.least_cosine, "least_cosine")
      .proper(S(0) < w.least_cosine && w.least_cosine <= S(1), "least_cosine", "above 0, up to 1")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const OneWay<S>& w) {
  return {{{w.body, "body", false, MustBe::any, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const HitReport<S>& h) {
  return Checklist()
      .finite(h.speed, "speed")
      .in_range(h.speed <= Limits<S>::speed(), "speed", "0 to Limits::speed()")
      .proper(S(0) <= h.speed, "speed", "0 to Limits::speed()")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const HitReport<S>& h) {
  return {{{h.body, "body", false, MustBe::any, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const ContactReport<S>&) { return {}; }
template <class S> NamedBodies<S> bodies_of(const ContactReport<S>& r) {
  return {{{r.body, "body", false, MustBe::any, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const KindGhost<S>& g) {
  return Checklist().proper(g.kind_a != 0, "kind_a", "1 or more").proper(g.kind_b != 0, "kind_b", "1 or more").report();
}
template <class S> NamedBodies<S> bodies_of(const KindGhost<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const MoveTarget<S>& t) {
  return Checklist()
      .also(fault_of_place(t.pose.position, "pose.position"))
      .proper(is_unit<S>(t.pose.orientation), "pose.orientation", kUnitLength)
      .report();
}
template <class S> NamedBodies<S> bodies_of(const MoveTarget<S>& t) {
  return {{{t.body, "body", false, MustBe::kinematic, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const RankedZone<S>& z) {
  return Checklist()
      .also(fault_of(static_cast<const ForceZone<S>&>(z)))
      .proper((z.replaces & ~zone_effect::kAll) == 0, "replaces", "bits of zone_effect")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const RankedZone<S>&) { return {{}, 0}; }

}  // namespace isostep::detail
