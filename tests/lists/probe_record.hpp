// A kind of record for the tests alone: a balloon that is tied to a dynamic body, one at most, and lifts it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep {

using ProbeId = Id<struct ProbeTag>;

template <class S> struct Probe {
  BodyId body = {};
  S volume = S(0);  // [m^3] each of which lifts a newton
  ISO_FIELDS(body, volume)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<Probe<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes;
  static FaultReport fault(const Probe<S>& p) {
    NumberChecks<S> checks;
    checks.not_negative(p.volume, "volume");
    return checks.list.report();
  }
  static NamedBodies<S> bodies(const Probe<S>& p) { return named_body<S>(p.body, MustBe::dynamic); }
  static constexpr OnlyOne only_one(const Probe<S>&) { return kOneABody; }
  static RecordKey key(const Probe<S>& p) { return {p.body.slot}; }
  template <class Forces> static void act(const Probe<S>& p, Forces& forces) {
    forces.sums.push(forces.bodies.centre_of(p.body), Vec3<S>{S(0), p.volume, S(0)});
  }
};

}  // namespace isostep::detail
