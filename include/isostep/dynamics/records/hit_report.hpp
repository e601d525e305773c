// HitReport: a body whose fast contacts are told.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using HitReportId = Id<struct HitReportTag>;

/// Reports contacts that begin on the body with a greater speed of approach in events().hits: for sounds, sparks,
/// dents. If both bodies have a record the lower speed counts. One record a body.
template <class S> struct HitReport {
  BodyId body = {};
  S speed = S(1);  // [m/s] along the normal, as the step begins in which they first press on each other

  ISO_FIELDS(body, speed)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<HitReport<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::none;
  static FaultReport fault(const HitReport<S>& h) {
    return Checklist()
        .finite(h.speed, "speed")
        .in_range(h.speed <= Limits<S>::speed(), "speed", "0 to Limits::speed()")
        .proper(S(0) <= h.speed, "speed", "0 to Limits::speed()")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const HitReport<S>& h) { return named_body<S>(h.body, MustBe::any); }
  static constexpr OnlyOne only_one(const HitReport<S>&) { return kOneABody; }
  static RecordKey key(const HitReport<S>& r) { return {r.body.slot}; }
  template <class Random> static void draw(HitReport<S>& h, Random& random) {
    h.body = random.any_body();
    h.speed = random.in(0, 4);
  }
};

}  // namespace isostep::detail
