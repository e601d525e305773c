// KindResponse: how contacts of two kinds of bodies push: whom they move, and how hard at most.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/scalar/platform.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

using KindResponseId = Id<struct KindResponseTag>;

/// A row of the world's table of pairs, like MaterialPair: contacts of bodies whose materials are of these kinds solve
/// for other masses, and press with a limited force. The kind of the part's material counts, not those of a mesh's or
/// height field's triangles. A second record of the same two kinds is refused, and so is every record if the solver is
/// those of whole islands, whose matrix is symmetric.
/// The scales multiply a body's inverse mass and inverse inertia in such contacts and nothing else: gravity, joints and
/// other contacts have the true ones. A body with a scale of 0 pushes the other and is not pushed back, and as a bullet
/// it is not stopped by it. Only the ratio of the two mass scales counts; against an unmoved body they have no effect.
/// Such contacts conserve neither momentum nor energy: a body that is not pushed back gives the other its speed,
/// however heavy that is. Impulses in events and the force below are those on the side with the larger scale.
/// A body that presses harder than max_force sinks in at its speed, is slowed by that force while it is inside, and has
/// the friction of that force. The force is that of one contact with all its points: of a pair of bodies' parts.
/// Continuous collision lets such bodies through.
template <class S> struct KindResponse {
  std::uint32_t kind_a = 0, kind_b = 0;                        // Material::kind, 1 or more
  S inverse_mass_scale_a = S(1), inverse_mass_scale_b = S(1);  // [1] 0, or 2^-8 to 1; not both 0
  // [1] 0 to 1, times those of the masses; 0: the contact does not turn the body
  S inverse_inertia_scale_a = S(1), inverse_inertia_scale_b = S(1);
  S max_force = S(0);  // [N] along the normal; 0: any

  ISO_FIELDS(kind_a, kind_b, inverse_mass_scale_a, inverse_mass_scale_b, inverse_inertia_scale_a,
             inverse_inertia_scale_b, max_force)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<KindResponse<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const KindResponse<S>& r) {
    constexpr const char *kMass = "0, or 2^-8 to 1", *kOne = "above 0 where inverse_mass_scale_a is 0",
                         *kSame = "that of a, for both are of one kind";
    const auto is_mass_scale = [](S x) { return x == S(0) || (S(0x1p-8) <= x && x <= S(1)); };
    const bool same = r.kind_a == r.kind_b;
    return Checklist()
        .finite(r.inverse_mass_scale_a, "inverse_mass_scale_a")
        .finite(r.inverse_mass_scale_b, "inverse_mass_scale_b")
        .finite(r.inverse_inertia_scale_a, "inverse_inertia_scale_a")
        .finite(r.inverse_inertia_scale_b, "inverse_inertia_scale_b")
        .finite(r.max_force, "max_force")
        .proper(r.kind_a != 0, "kind_a", "1 or more")
        .proper(r.kind_b != 0, "kind_b", "1 or more")
        .proper(is_mass_scale(r.inverse_mass_scale_a), "inverse_mass_scale_a", kMass)
        .proper(is_mass_scale(r.inverse_mass_scale_b), "inverse_mass_scale_b", kMass)
        .proper(S(0) < r.inverse_mass_scale_a || S(0) < r.inverse_mass_scale_b, "inverse_mass_scale_b", kOne)
        .proper(S(0) <= r.inverse_inertia_scale_a && r.inverse_inertia_scale_a <= S(1), "inverse_inertia_scale_a",
                kPart)
        .proper(S(0) <= r.inverse_inertia_scale_b && r.inverse_inertia_scale_b <= S(1), "inverse_inertia_scale_b",
                kPart)
        .proper(!same || r.inverse_mass_scale_a == r.inverse_mass_scale_b, "inverse_mass_scale_b", kSame)
        .proper(!same || r.inverse_inertia_scale_a == r.inverse_inertia_scale_b, "inverse_inertia_scale_b", kSame)
        .proper(S(0) <= r.max_force, "max_force", kZeroOrMore)
        .report();
  }
  static constexpr OnlyOne only_one(const KindResponse<S>&) { return kOnePairOfKinds; }
  static RecordKey key(const KindResponse<S>& p) { return {kinds_key(p.kind_a, p.kind_b)}; }
  /// Refuses solvers of whole islands: two rows on one body share its true mass there, as the matrix is one of square
  /// roots of masses.
  static FaultReport fault_at(const KindResponse<S>&, const RecordPlace<S>& place) {
    return Checklist()
        .proper(!solves_islands(place.settings.solver), "solver", "another solver than direct, avbd and admm")
        .report();
  }
  template <class Random> static void draw(KindResponse<S>& r, Random& random) {
    r.kind_a = random.kind();
    r.kind_b = random.kind();
    if (r.kind_a != r.kind_b) {
      const S scale = random.one_in(3) ? S(0) : random.in(0.0625, 1);
      (random.one_in(2) ? r.inverse_mass_scale_a : r.inverse_mass_scale_b) = scale;
      r.inverse_inertia_scale_a = random.in(0, 1);
    }
    if (random.one_in(2)) r.max_force = random.in(1, 200);
  }
};

}  // namespace isostep::detail
