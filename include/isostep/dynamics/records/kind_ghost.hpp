// KindGhost: two kinds of bodies that pass each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using KindGhostId = Id<struct KindGhostTag>;

/// Lets bodies whose materials are of these kinds pass through each other while the record exists: no contact, no
/// overlap with a sensor, no stop of a bullet, and a character of one kind does not see bodies of the other. A kind may
/// pass its own. The kind of the body's material counts, not those of a mesh's or height field's triangles. Has no
/// effect on wheels and queries of the game. The order of the kinds does not matter: a second record of the same two is
/// refused.
template <class S> struct KindGhost {
  std::uint32_t kind_a = 0, kind_b = 0;  // Material::kind, 1 or more

  ISO_FIELDS(kind_a, kind_b)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<KindGhost<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const KindGhost<S>& g) {
    return Checklist()
        .proper(g.kind_a != 0, "kind_a", "1 or more")
        .proper(g.kind_b != 0, "kind_b", "1 or more")
        .report();
  }
  static constexpr OnlyOne only_one(const KindGhost<S>&) { return kOnePairOfKinds; }
  static RecordKey key(const KindGhost<S>& p) { return {kinds_key(p.kind_a, p.kind_b)}; }
  template <class Random> static void draw(KindGhost<S>& g, Random& random) {
    g.kind_a = random.kind();
    g.kind_b = random.kind();
  }
};

}  // namespace isostep::detail
