// BodyDrag: what a fluid takes from a body's motion.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using DragId = Id<struct BodyDragTag>;

/// Force -v (linear + quadratic |v|) at the centre of mass, torque -angular w, with v the velocity through the air:
/// less the wind of the zones around the centre. Stable whatever the coefficients, and exact at the speed at which it
/// balances a steady force.
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
  static NamedBodies<S> bodies(const BodyDrag<S>& d) { return named_body<S>(d.body, MustBe::dynamic); }
};

}  // namespace isostep::detail
