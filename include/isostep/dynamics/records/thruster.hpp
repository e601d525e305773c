// Thruster: a force that turns with its body.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/quat.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using ThrusterId = Id<struct ThrusterTag>;

template <class S> struct Thruster {
  BodyId body = {};
  Vec3<S> point = {S(0), S(0), S(0)};  // [m] body frame
  Vec3<S> force = {S(0), S(0), S(0)};  // [N] body frame

  ISO_FIELDS(body, point, force)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<Thruster<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes;
  static FaultReport fault(const Thruster<S>& t) {
    return Checklist().also(fault_of_place(t.point, "point")).finite(t.force, "force").report();
  }
  static constexpr NamedBodies<S> bodies(const Thruster<S>& t) { return named_point(t.body, t.point, "point"); }
  template <class Random> static void draw(Thruster<S>& t, Random& random) {
    t.body = random.body();
    t.point = random.point(0.0625);
    t.force = random.arrow(0, 4, random.mass(t.body));
  }
  template <class Forces> static void act(const Thruster<S>& t, Forces& forces) {
    const auto end = forces.bodies.end_at(t.body, t.point);
    if (end.row != 0) forces.sums.push(end, rotate(forces.bodies.state(end.row).orientation, t.force));
  }
};

}  // namespace isostep::detail
