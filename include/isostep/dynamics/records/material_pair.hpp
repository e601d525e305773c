// MaterialPair: what two kinds of material are to each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep {

using MaterialPairId = Id<struct MaterialPairTag>;

/// A row of the world's table of pairs. Where a surface of one kind meets one of the other, these numbers replace the
/// mix of the two materials. Their anisotropy and their belts still count. The order of the kinds does not matter: a
/// second record of the same two is refused, and so is a kind of 0.
template <class S> struct MaterialPair {
  std::uint32_t kind_a = 0, kind_b = 0;  // Material::kind, 1 or more
  S friction = S(0.6);                   // [1] of what slides
  S static_friction = S(0);              // [1] of what does not; below friction: the same
  S restitution = S(0);                  // [1] 0..1
  S rolling_resistance = S(0);           // [m]
  S spin_resistance = S(1.0 / 128);      // [m]

  ISO_FIELDS(kind_a, kind_b, friction, static_friction, restitution, rolling_resistance, spin_resistance)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<MaterialPair<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const MaterialPair<S>& p) {
    return Checklist()
        .finite(p.friction, "friction")
        .finite(p.static_friction, "static_friction")
        .finite(p.restitution, "restitution")
        .finite(p.rolling_resistance, "rolling_resistance")
        .finite(p.spin_resistance, "spin_resistance")
        .in_range(p.friction <= kMaxFriction<S>, "friction", "0 to 16")
        .in_range(p.static_friction <= kMaxFriction<S>, "static_friction", "0 to 16")
        .in_range(p.rolling_resistance <= Limits<S>::extent(), "rolling_resistance", "0 to Limits::extent()")
        .in_range(p.spin_resistance <= Limits<S>::extent(), "spin_resistance", "0 to Limits::extent()")
        .proper(p.kind_a != 0, "kind_a", "1 or more")
        .proper(p.kind_b != 0, "kind_b", "1 or more")
        .proper(S(0) <= p.friction, "friction", "0 to 16")
        .proper(S(0) <= p.static_friction, "static_friction", "0 to 16")
        .proper(S(0) <= p.restitution && p.restitution <= S(1), "restitution", "0 to 1")
        .proper(S(0) <= p.rolling_resistance, "rolling_resistance", "0 to Limits::extent()")
        .proper(S(0) <= p.spin_resistance, "spin_resistance", "0 to Limits::extent()")
        .report();
  }
  static constexpr OnlyOne only_one(const MaterialPair<S>&) { return kOnePairOfKinds; }
  static RecordKey key(const MaterialPair<S>& p) { return {kinds_key(p.kind_a, p.kind_b)}; }
  template <class Random> static void draw(MaterialPair<S>& p, Random& random) {
    p.kind_a = random.kind();
    p.kind_b = random.kind();
    p.friction = random.in(0, 1.25);
    p.static_friction = random.in(0, 2);
    if (random.one_in(3)) p.restitution = random.in(0, 1);
    if (random.one_in(3)) p.rolling_resistance = random.in(0, 0.0625);
  }
};

}  // namespace isostep::detail
