// Ghost: two bodies that do not touch until they are apart.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using GhostId = Id<struct GhostTag>;

/// Two bodies pass through each other: no contact, no overlap with a sensor, no stop of a bullet, and a character of
/// one of them does not see the other. As a step begins that finds them apart, the record ends by itself: where boxes
/// or exact shapes are further from each other than contacts are made, 2 cm, and a character's skin besides, so that
/// the end makes no contact. For what drops through its platform, or appears inside of something. A OneWay body makes
/// such records too. One record a pair, in whichever order.
template <class S> struct Ghost {
  BodyId a = {}, b = {};

  ISO_FIELDS(a, b)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<Ghost<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const Ghost<S>& g) {
    return Checklist().proper(!(g.a == g.b), "b", "another body than a").report();
  }
  static constexpr NamedBodies<S> bodies(const Ghost<S>& g) {
    return {{{g.a, "a", false, MustBe::any, Vec3<S>::zero(), ""}, {g.b, "b", false, MustBe::any, Vec3<S>::zero(), ""}},
            2};
  }
  static constexpr OnlyOne only_one(const Ghost<S>&) { return {"b", "a pair that has no record yet"}; }
  static RecordKey key(const Ghost<S>& g) { return {min(g.a.slot, g.b.slot), max(g.a.slot, g.b.slot)}; }
  template <class Random> static void draw(Ghost<S>& g, Random& random) {
    g.a = random.mover();
    g.b = random.mover();
  }
};

}  // namespace isostep::detail
