// BodyDrag: what a fluid takes from a body's motion.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using DragId = Id<struct BodyDragTag>;

/// Applies the force -v (linear + quadratic |v|) at the centre of mass and the torque -angular w, with v the velocity
/// through the air: less the wind of the zones around the centre. Stable for any coefficients, and exact at the speed
/// at which it balances a steady force.
template <class S> struct BodyDrag {
  BodyId body = {};
  S linear = S(0);     // [N s/m]
  S quadratic = S(0);  // [N s^2/m^2]
  S angular = S(0);    // [N m s]

  ISO_FIELDS(body, linear, quadratic, angular)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<BodyDrag<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::resists;
  static FaultReport fault(const BodyDrag<S>& d) {
    return Checklist()
        .finite(d.linear, "linear")
        .finite(d.quadratic, "quadratic")
        .finite(d.angular, "angular")
        .proper(S(0) <= d.linear, "linear", kZeroOrMore)
        .proper(S(0) <= d.quadratic, "quadratic", kZeroOrMore)
        .proper(S(0) <= d.angular, "angular", kZeroOrMore)
        .report();
  }
  static constexpr NamedBodies<S> bodies(const BodyDrag<S>& d) { return named_body<S>(d.body, MustBe::dynamic); }
  template <class Random> static void draw(BodyDrag<S>& d, Random& random) {
    d.body = random.body();
    const double mass = random.mass(d.body), unit = random.one_in(4) ? 100 * mass : mass;
    d.linear = random.in(0, 2, unit);
    d.quadratic = random.in(0, 1, unit);
    d.angular = random.in(0, 0.25, unit);
  }
  template <class Forces> static void resist(const BodyDrag<S>& d, Forces& forces) {
    const auto& resistance = forces.resistance;
    const std::uint32_t row = forces.bodies.row_of(d.body);
    if (!forces.bodies.moves(row)) return;
    const auto& mass = forces.bodies.mass(row);
    const auto h = forces.bodies.when().h;
    const S part = resistance.mass_part(row), half = highest<S>() * S(0.5);
    Bounder<S> bounder;
    // v' = v - h (linear + quadratic |v'|) v' / part: first |v'|, the root of 1 + a and b, then the rest.
    const Vec3<S> v = resistance.next_velocity(row) - forces.zones.wind_at(forces.bodies.state(row).centre);
    const S one = S(1) + bounder.quotient(d.linear, part, half) * h;
    const S b = bounder.quotient(d.quadratic, part, half) * h, speed = length(v);
    const S root = sqrt(saturate_to<S>(product(one, one) + product(saturate_to<S>(product(b, speed)), S(4))));
    const S next_speed = speed / (one * S(0.5) + root * S(0.5));
    const S c = saturating_add(d.linear, saturate_to<S>(product(d.quadratic, next_speed)));
    const S slowed = bounder.quotient(c, mass.mass, half) / (S(1) + bounder.quotient(c, part, half) * h);
    forces.sums.slow(row, v, slowed);
    if (!(S(0) < d.angular)) return;
    const S turning = bounder.quotient(d.angular, mass.mass, half);
    const S largest = max(max_abs(mass.kappa.rows[0]), max(max_abs(mass.kappa.rows[1]), max_abs(mass.kappa.rows[2])));
    const S fastest = min(saturate_to<S>(product(turning, largest)), half);
    if (!(S(0) < largest)) return;
    const Vec3<S> way = (mass.kappa * resistance.next_angular_velocity(row)) / largest;
    forces.resistance.slow_turning(row, way, fastest);
  }
};

}  // namespace isostep::detail
