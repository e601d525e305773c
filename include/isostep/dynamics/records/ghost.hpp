// Ghost: two bodies that do not touch until they are apart.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using GhostId = Id<struct GhostTag>;

/// Lets two bodies pass through each other: no contact, no overlap with a sensor, no stop of a bullet, and a character
/// of one of them does not see the other. The record ends by itself at the start of a step that finds them apart: when
/// boxes or exact shapes are further apart than the distance of contacts, 2 cm, plus a character's skin, so that its
/// end makes no contact. For bodies that drop through a platform, or appear inside another. A OneWay body makes such
/// records too. One record a pair, in either order.
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
