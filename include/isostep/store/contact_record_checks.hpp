// What is required of the records that say how bodies touch, as force_checks.hpp has it of forces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/record_list.hpp"
#include "isostep/store/force_checks.hpp"

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

template <class S> FaultReport fault_of(const KindResponse<S>& r) {
  constexpr const char *kMass = "0, or 2^-8 to 1", *kOne = "above 0 where inverse_mass_scale_a is 0", *kPart = "0 to 1",
                       *kSame = "that of a, for both are of one kind";
  const auto is_mass_scale = [](S x) { return x == S(0) || (S(0x1p-8) <= x && x <= S(1)); };
  const bool same = r.kind_a == r.kind_b;
  return Checklist()
      .finite(r.inverse_mass_scale_a, "inverse_mass_scale_a")
      .finite(r.inverse_mass_scale_b, "inverse_mass_scale_b")
      .finite(r.inverse_inertia_scale_a, "inverse_inertia_scale_a")
      .finite(r.inverse_inertia_scale_b, "inverse_inertia_scale_b")
      .finite(r.max_force, "max_force")
      .proper(r.kind_a != 0, "kind_a", "1 or more")
      .proper(r.kind_b != 0, "kind_b", "1 or more")
      .proper(is_mass_scale(r.inverse_mass_scale_a), "inverse_mass_scale_a", kMass)
      .proper(is_mass_scale(r.inverse_mass_scale_b), "inverse_mass_scale_b", kMass)
      .proper(S(0) < r.inverse_mass_scale_a || S(0) < r.inverse_mass_scale_b, "inverse_mass_scale_b", kOne)
      .proper(S(0) <= r.inverse_inertia_scale_a && r.inverse_inertia_scale_a <= S(1), "inverse_inertia_scale_a", kPart)
      .proper(S(0) <= r.inverse_inertia_scale_b && r.inverse_inertia_scale_b <= S(1), "inverse_inertia_scale_b", kPart)
      .proper(!same || r.inverse_mass_scale_a == r.inverse_mass_scale_b, "inverse_mass_scale_b", kSame)
      .proper(!same || r.inverse_inertia_scale_a == r.inverse_inertia_scale_b, "inverse_inertia_scale_b", kSame)
      .proper(S(0) <= r.max_force, "max_force", kZeroOrMore)
      .report();
}
template <class S> NamedBodies<S> bodies_of(const KindResponse<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const MoveTarget<S>& t) {
  return Checklist()
      .also(fault_of_place(t.pose.position, "pose.position"))
      .proper(is_unit<S>(t.pose.orientation), "pose.orientation", kUnitLength)
      .report();
}
template <class S> NamedBodies<S> bodies_of(const MoveTarget<S>& t) {
  return {{{t.body, "body", false, MustBe::kinematic, Vec3<S>::zero(), ""}, {}}, 1};
}

template <class S> FaultReport fault_of(const SensorMount<S>& m) {
  return Checklist()
      .proper(!(m.sensor == m.on), "on", "another body than sensor")
      .finite(m.frame.position, "frame.position")
      .in_range(within(m.frame.position, Limits<S>::extent()), "frame.position", "components up to Limits::extent()")
      .proper(is_unit<S>(m.frame.orientation), "frame.orientation", kUnitLength)
      .report();
}
template <class S> NamedBodies<S> bodies_of(const SensorMount<S>& m) {
  return {{{m.sensor, "sensor", false, MustBe::kinematic, Vec3<S>::zero(), ""},
           {m.on, "on", false, MustBe::any, Vec3<S>::zero(), ""}},
          2};
}

template <class S> FaultReport fault_of(const RankedZone<S>& z) {
  return Checklist()
      .also(fault_of(static_cast<const ForceZone<S>&>(z)))
      .proper((z.replaces & ~zone_effect::kAll) == 0, "replaces", "bits of zone_effect")
      .report();
}
template <class S> NamedBodies<S> bodies_of(const RankedZone<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const DampingZone<S>& z) {
  constexpr const char* kRate = "0 to 16384";
  return Checklist()
      .also(fault_of_region(z))
      .finite(z.linear, "linear")
      .finite(z.angular, "angular")
      .in_range(z.linear <= S(kMaxRate), "linear", kRate)
      .in_range(z.angular <= S(kMaxRate), "angular", kRate)
      .proper(S(0) <= z.linear, "linear", kRate)
      .proper(S(0) <= z.angular, "angular", kRate)
      .report();
}
template <class S> NamedBodies<S> bodies_of(const DampingZone<S>&) { return {{}, 0}; }

template <class S> FaultReport fault_of(const RankedWater<S>& w) { return fault_of(static_cast<const Water<S>&>(w)); }
template <class S> NamedBodies<S> bodies_of(const RankedWater<S>&) { return {{}, 0}; }

}  // namespace isostep::detail
