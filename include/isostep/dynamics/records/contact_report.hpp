// ContactReport: a body whose contacts every step tells of.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using ContactReportId = Id<struct ContactReportTag>;

/// Reports every point of every contact of the body in Events::contacts, step by step; World::contacts_of selects them.
/// Has no effect on motion. One record a body.
template <class S> struct ContactReport {
  BodyId body = {};

  ISO_FIELDS(body)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<ContactReport<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::none;
  static FaultReport fault(const ContactReport<S>&) { return {}; }
  static constexpr NamedBodies<S> bodies(const ContactReport<S>& r) { return named_body<S>(r.body, MustBe::any); }
  static constexpr OnlyOne only_one(const ContactReport<S>&) { return kOneABody; }
  static RecordKey key(const ContactReport<S>& r) { return {r.body.slot}; }
};

}  // namespace isostep::detail
