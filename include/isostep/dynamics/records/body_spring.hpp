// BodySpring: a spring or a bungee between points of two bodies, or of one and the world.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/dynamics/reduced_mass.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using BodySpringId = Id<struct BodySpringTag>;

/// Pulls its ends together by stiffness (length - rest_length) + damping d(length)/dt, or pushes them apart. With
/// only_pulls (the book's bungee) it has no force while it is slack. Evaluated in every sub-step: energies stay bounded
/// while the sub-step rate is above half of sqrt(stiffness / reduced mass). A stiffer record is refused. For stiffer
/// springs use joints, which are solved.
template <class S> struct BodySpring {
  BodyId a = {};
  BodyId b = {};                          // null: the world
  Vec3<S> anchor_a = {S(0), S(0), S(0)};  // [m] body a's frame
  Vec3<S> anchor_b = {S(0), S(0), S(0)};  // [m] body b's frame, or the world's
  S rest_length = S(0);                   // [m]
  S stiffness = S(0);                     // [N/m]
  S damping = S(0);                       // [N s/m] along the spring
  bool only_pulls = false;

  ISO_FIELDS(a, b, anchor_a, anchor_b, rest_length, stiffness, damping, only_pulls)
};

}  // namespace isostep

namespace isostep::detail {

/// [kg] Returns the effective mass of a spring's end at a point: the mass, reduced by rotation.
template <class S> S least_mass_at(const BodyProperties<S>& body, Vec3<S> point) {
  const S arm = length(point - body.local_centre), most = max_abs(body.kappa);
  return body.mass / (S(1) + (most * arm) * arm);
}
/// Reports a fault if a spring swings or is damped faster than sub-steps of that rate [1/s] resolve. Null bodies do not
/// move.
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

template <class S> struct RecordRules<BodySpring<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes;
  static constexpr bool kBears = true;
  static constexpr bool kTies = true;
  static FaultReport fault(const BodySpring<S>& s) {
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
  static constexpr NamedBodies<S> bodies(const BodySpring<S>& s) {
    return {
        {{s.a, "a", false, MustBe::any, s.anchor_a, "anchor_a"}, {s.b, "b", true, MustBe::any, s.anchor_b, "anchor_b"}},
        2};
  }
  static FaultReport fault_at(const BodySpring<S>& s, const RecordPlace<S>& place) {
    const BodyProperties<S>*const a = place.bodies[0], *const b = place.bodies[1];
    const auto moves = [](const BodyProperties<S>* body) { return body != nullptr && body->type == BodyType::dynamic; };
    if (!moves(a) && !moves(b)) return {Fault::not_dynamic, "", "a, b", "a dynamic one"};
    const Settings<S>& settings = place.settings;
    return fault_of_rate(s, a, b, S(integration_rate(settings.solver, settings.hz, settings.substeps)));
  }
  template <class Random> static void draw(BodySpring<S>& s, Random& random) {
    s.a = random.body();
    if (!random.one_in(3)) s.b = random.body();
    s.anchor_a = random.point(0.0625);
    s.anchor_b = s.b ? random.point(0.0625) : random.beside(s.a, 0.5, 1);
    const double mass = s.b ? min(random.mass(s.a), random.mass(s.b)) : random.mass(s.a);
    s.rest_length = random.in(0.5, 2);
    s.stiffness = random.in(0, 40, mass);
    s.damping = random.in(0, 2, mass);
    s.only_pulls = random.one_in(2);
  }
  template <class Forces> static void act(const BodySpring<S>& s, Forces& forces) {
    const auto& bodies = forces.bodies;
    if (!bodies.is_enabled(s.a) || !bodies.is_enabled(s.b)) return;
    const auto a = bodies.end_at(s.a, s.anchor_a), b = bodies.end_at(s.b, s.anchor_b);
    if (!bodies.moves(a.row) && !bodies.moves(b.row)) return;
    const Heading<S> way = heading_of(b.at - a.at);
    const S stretch = way.length - s.rest_length;
    if (s.only_pulls && !(S(0) < stretch)) return;
    const S rate = dot(b.velocity - a.velocity, way.direction);
    S pull = saturate_to<S>(product(s.stiffness, stretch) + product(s.damping, rate));
    if (s.only_pulls) pull = max(pull, S(0));
    forces.sums.push(a, way.direction * pull);
    forces.sums.push(b, way.direction * -pull);
  }
};

}  // namespace isostep::detail
