// What is required of force records: the same rules for commands and for states read from files.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/force_list.hpp"
#include "isostep/store/checks.hpp"

namespace isostep::detail {

inline constexpr char kZeroOrMore[] = "0 or more";
inline constexpr int kMostWavePeriod = 1024;    // [s] its part in a sub-step still has digits
inline constexpr int kMostBlastSeconds = 1024;  // [s] of each phase; the clock counts to 16384

/// Where a zone of any kind is.
template <class Zone> FaultReport fault_of_region(const Zone& z) {
  using S = decltype(z.half.x);
  return Checklist()
      .proper(z.shape <= ZoneShape::box, "shape", "one of ZoneShape")
      .also(fault_of_place(z.pose.position, "pose.position"))
      .proper(is_unit<S>(z.pose.orientation), "pose.orientation", kUnitLength)
      .finite(z.half, "half")
      .in_range(within(z.half, Limits<S>::position()), "half", "0 to Limits::position()")
      .proper(S(0) <= z.half.x && S(0) <= z.half.y && S(0) <= z.half.z, "half", "0 to Limits::position()")
      .report();
}
template <class S> FaultReport fault_of(const ForceZone<S>& z) {
  const S speed = Limits<S>::speed();
  return Checklist()
      .also(fault_of_region(z))
      .finite(z.acceleration, "acceleration")
      .finite(z.wind, "wind")
      .in_range(within(z.acceleration, speed), "acceleration", "components up to Limits::speed()")
      .in_range(no_longer(z.wind, speed), "wind", kWithinSpeed)
      .report();
}
template <class S> FaultReport fault_of(const Attractor<S>& a) {
  return Checklist()
      .also(fault_of_place(a.point, "point"))
      .finite(a.strength, "strength")
      .finite(a.least_distance, "least_distance")
      .finite(a.range, "range")
      .in_range(a.range <= Limits<S>::position(), "range", "0 to Limits::position()")
      .in_range(Limits<S>::minimum_size() <= a.least_distance, "least_distance", "Limits::minimum_size() or more")
      .proper(S(0) <= a.range, "range", "0 to Limits::position()")
      .report();
}
template <class S> FaultReport fault_of(const BodySpring<S>& s) {
  return Checklist()
      .also(fault_of_place(s.anchor_a, "anchor_a"))
      .also(fault_of_place(s.anchor_b, "anchor_b"))
      .finite(s.rest_length, "rest_length")
      .finite(s.stiffness, "stiffness")
      .finite(s.damping, "damping")
      .in_range(s.rest_length <= Limits<S>::position(), "rest_length", "0 to Limits::position()")
      .proper(S(0) <= s.rest_length, "rest_length", "0 to Limits::position()")
      .proper(S(0) <= s.stiffness, "stiffness", kZeroOrMore)
      .proper(S(0) <= s.damping, "damping", kZeroOrMore)
      .proper(!(s.a == s.b), "b", "another body than a")
      .report();
}
template <class S> FaultReport fault_of(const Thruster<S>& t) {
  return Checklist().also(fault_of_place(t.point, "point")).finite(t.force, "force").report();
}
template <class S> FaultReport fault_of(const BuoyancyPoint<S>& b) {
  return Checklist()
      .also(fault_of_place(b.point, "point"))
      .finite(b.max_depth, "max_depth")
      .finite(b.volume, "volume")
      .finite(b.surface_height, "surface_height")
      .finite(b.density, "density")
      .in_range(b.max_depth <= Limits<S>::extent(), "max_depth", "above 0, up to Limits::extent()")
      .in_range(within(b.surface_height, Limits<S>::position()), "surface_height", "a size up to Limits::position()")
      .proper(S(0) < b.max_depth, "max_depth", "above 0, up to Limits::extent()")
      .proper(S(0) <= b.volume, "volume", kZeroOrMore)
      .proper(S(0) <= b.density, "density", kZeroOrMore)
      .report();
}
template <class S> FaultReport fault_of(const BodyDrag<S>& d) {
  return Checklist()
      .finite(d.linear, "linear")
      .finite(d.quadratic, "quadratic")
      .finite(d.angular, "angular")
      .proper(S(0) <= d.linear, "linear", kZeroOrMore)
      .proper(S(0) <= d.quadratic, "quadratic", kZeroOrMore)
      .proper(S(0) <= d.angular, "angular", kZeroOrMore)
      .report();
}
template <class S> bool is_finite_matrix(const Mat3<S>& m) {
  return is_finite(m.rows[0]) && is_finite(m.rows[1]) && is_finite(m.rows[2]);
}
template <class S> FaultReport fault_of(const AeroSurface<S>& a) {
  constexpr const char *kFinite = "finite numbers", *kControl = "-1 to 1";
  return Checklist()
      .also(fault_of_place(a.point, "point"))
      .proper(is_unit<S>(a.orientation), "orientation", kUnitLength)
      .ask(is_finite_matrix(a.tensor), Fault::not_finite, "tensor", kFinite)
      .ask(is_finite_matrix(a.low), Fault::not_finite, "low", kFinite)
      .ask(is_finite_matrix(a.high), Fault::not_finite, "high", kFinite)
      .finite(a.control, "control")
      .proper(within(a.control, S(1)), "control", kControl)
      .report();
}

template <class S> FaultReport fault_of(const Water<S>& w) {
  constexpr const char* kPlace = "a size up to Limits::position()";
  const S position = Limits<S>::position(), rate = S(kMaxRate);
  const Vec3<Unit<S>>& way = w.wave_direction;
  return Checklist()
      .finite(w.surface_height, "surface_height")
      .finite(w.density, "density")
      .also(fault_of_place(w.middle, "middle"))
      .finite(w.half, "half")
      .finite(w.current, "current")
      .finite(w.linear_drag, "linear_drag")
      .finite(w.quadratic_drag, "quadratic_drag")
      .finite(w.angular_drag, "angular_drag")
      .finite(w.wave_height, "wave_height")
      .finite(w.wave_length, "wave_length")
      .finite(w.wave_period, "wave_period")
      .in_range(within(w.surface_height, position), "surface_height", kPlace)
      .in_range(w.density <= Limits<S>::mass(), "density", "0 to Limits::mass()")
      .in_range(within(w.half, position), "half", "0 to Limits::position()")
      .in_range(no_longer(w.current, Limits<S>::speed()), "current", kWithinSpeed)
      .in_range(w.linear_drag <= rate, "linear_drag", "0 to 16384")
      .in_range(w.quadratic_drag <= rate, "quadratic_drag", "0 to 16384")
      .in_range(w.angular_drag <= rate, "angular_drag", "0 to 16384")
      .in_range(w.wave_length <= position, "wave_length", "16 Limits::minimum_size() to Limits::position()")
      .in_range(w.wave_period <= S(kMostWavePeriod), "wave_period", "1/64 to 1024")
      .proper(S(0) <= w.density, "density", "0 to Limits::mass()")
      .proper(S(0) <= w.half.x && S(0) <= w.half.y && S(0) <= w.half.z, "half", "0 to Limits::position()")
      .proper(S(0) <= w.linear_drag, "linear_drag", "0 to 16384")
      .proper(S(0) <= w.quadratic_drag, "quadratic_drag", "0 to 16384")
      .proper(S(0) <= w.angular_drag, "angular_drag", "0 to 16384")
      .proper(S(16) * Limits<S>::minimum_size() <= w.wave_length, "wave_length",
              "16 Limits::minimum_size() to Limits::position()")
      .proper(S(1.0 / 64) <= w.wave_period, "wave_period", "1/64 to 1024")
      // A steeper wave breaks (Stokes: a seventh of its length from trough to crest).
      .proper(S(0) <= w.wave_height && w.wave_height * S(14) <= w.wave_length, "wave_height", "0 to wave_length / 14")
      .proper(is_direction<S>(way), "wave_direction", "a vector of length 1")
      .report();
}
template <class S> FaultReport fault_of(const Explosion<S>& e) {
  constexpr const char *kSeconds = "0 to 1024", *kLength = "0 to Limits::position()";
  Checklist list;
  list.also(fault_of_place(e.centre, "centre"));
  const auto length = [&](S x, const char* field) {
    list.finite(x, field).in_range(x <= Limits<S>::position(), field, kLength).proper(S(0) <= x, field, kLength);
  };
  const auto seconds = [&](S x, const char* field) {
    list.finite(x, field).in_range(x <= S(kMostBlastSeconds), field, kSeconds).proper(S(0) <= x, field, kSeconds);
  };
  list.finite(e.implosion_force, "implosion_force");
  length(e.implosion_least, "implosion_least");
  length(e.implosion_most, "implosion_most");
  seconds(e.implosion_duration, "implosion_duration");
  list.finite(e.wave_force, "wave_force");
  length(e.wave_speed, "wave_speed");
  length(e.wave_width, "wave_width");
  list.finite(e.wave_ramp, "wave_ramp").proper(S(0) <= e.wave_ramp && e.wave_ramp <= S(1), "wave_ramp", "0 to 1");
  seconds(e.wave_duration, "wave_duration");
  list.finite(e.chimney_force, "chimney_force");
  length(e.chimney_radius, "chimney_radius");
  length(e.chimney_height, "chimney_height");
  seconds(e.chimney_duration, "chimney_duration");
  // Beyond that the wave has nothing to meet, and its place would leave the format.
  list.in_range(product(e.wave_speed, e.wave_duration) <= product(Limits<S>::position(), S(1)), "wave_duration",
                "wave_speed wave_duration up to Limits::position()");
  return list.proper(Limits<S>::minimum_size() <= e.wave_speed, "wave_speed", "Limits::minimum_size() or more")
      .proper(Limits<S>::minimum_size() <= e.chimney_radius, "chimney_radius", "Limits::minimum_size() or more")
      .report();
}

/// What a record requires of the bodies that it names: the name of each field, whether it may be null, of which type it
/// has to be, and where on it the force acts.
enum class MustBe { any, dynamic, kinematic };
template <class S> struct NamedBody {
  BodyId body;
  const char* field;
  bool may_be_null;
  MustBe must_be;
  Vec3<S> point;  // [m] body frame
  const char* point_field;
};
ISO_INLINE constexpr bool is_as_asked(BodyType type, MustBe must_be) {
  if (must_be == MustBe::any) return true;
  return type == (must_be == MustBe::dynamic ? BodyType::dynamic : BodyType::kinematic);
}
/// Whether a force of the record acts too far from the centre of mass of the body that it names; a record without a
/// point is about the body as a whole.
template <class S> bool overreaches(const BodyProperties<S>& body, const NamedBody<S>& named) {
  return *named.point_field != 0 && overreaches(body.kappa, body.principal, named.point - body.local_centre);
}
template <class S> struct NamedBodies {
  NamedBody<S> all[2];
  int count;
};
template <class S> NamedBodies<S> bodies_of(const ForceZone<S>&) { return {{}, 0}; }
template <class S> NamedBodies<S> bodies_of(const Explosion<S>&) { return {{}, 0}; }
template <class S> NamedBodies<S> bodies_of(const Water<S>&) { return {{}, 0}; }
template <class S> NamedBodies<S> bodies_of(const Attractor<S>& a) {
  return {{{a.body, "body", true, MustBe::any, Vec3<S>::zero(), "point"}, {}}, 1};
}
template <class S> NamedBodies<S> bodies_of(const BodySpring<S>& s) {
  return {
      {{s.a, "a", false, MustBe::any, s.anchor_a, "anchor_a"}, {s.b, "b", true, MustBe::any, s.anchor_b, "anchor_b"}},
      2};
}
template <class S> NamedBodies<S> bodies_of(const Thruster<S>& t) {
  return {{{t.body, "body", false, MustBe::dynamic, t.point, "point"}, {}}, 1};
}
template <class S> NamedBodies<S> bodies_of(const BuoyancyPoint<S>& b) {
  return {{{b.body, "body", false, MustBe::dynamic, b.point, "point"}, {}}, 1};
}
template <class S> NamedBodies<S> bodies_of(const BodyDrag<S>& d) {
  return {{{d.body, "body", false, MustBe::dynamic, Vec3<S>::zero(), ""}, {}}, 1};
}
template <class S> NamedBodies<S> bodies_of(const AeroSurface<S>& a) {
  return {{{a.body, "body", false, MustBe::dynamic, a.point, "point"}, {}}, 1};
}

/// [kg] What an end of a spring bears at a point: the mass, less what turning gives way.
template <class S> S least_mass_at(const BodyProperties<S>& body, Vec3<S> point) {
  const S arm = length(point - body.local_centre), most = max_abs(body.kappa);
  return body.mass / (S(1) + (most * arm) * arm);
}
/// Whether a spring swings more slowly than the sub-steps of that rate [1/s] resolve, and is damped no faster. Null
/// bodies do not move.
template <class S>
FaultReport fault_of_rate(const BodySpring<S>& s, const BodyProperties<S>* a, const BodyProperties<S>* b, S rate) {
  const auto mass_of = [](const BodyProperties<S>* body, Vec3<S> anchor) {
    return body == nullptr || body->type != BodyType::dynamic ? S(0) : least_mass_at(*body, anchor);
  };
  const S mass_a = mass_of(a, s.anchor_a), mass_b = mass_of(b, s.anchor_b);
  const S reduced = !(S(0) < mass_a) ? mass_b : !(S(0) < mass_b) ? mass_a : mass_a * mass_share(mass_a, mass_b).a;
  return Checklist()
      .in_range((s.stiffness / rate) / rate <= reduced, "stiffness", "up to the reduced mass times the rate squared")
      .in_range(s.damping / rate <= reduced, "damping", "up to the reduced mass times the rate of sub-steps")
      .report();
}

}  // namespace isostep::detail
