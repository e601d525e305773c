// Attractor: gravity towards a point or a body, by the inverse square of the distance.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using AttractorId = Id<struct AttractorTag>;

/// Accelerates every awake dynamic body with a category of the mask and nearer than `range` by strength / max(distance,
/// least_distance)^2 towards the point. A dynamic body that attracts is pulled back as much: momentum is conserved.
/// Sleeping bodies stay asleep.
template <class S> struct Attractor {
  BodyId body = {};                    // whose centre of mass attracts; null: the point
  Vec3<S> point = {S(0), S(0), S(0)};  // [m] world
  S strength = S(0);                   // [m^3/s^2] the constant of gravitation times the mass; negative: pushes away
  S least_distance = S(1);             // [m]
  S range = S(0);                      // [m] 0: everywhere
  std::uint32_t mask = 0xffffffffu;    // categories: Filter

  ISO_FIELDS(body, point, strength, least_distance, range, mask)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<Attractor<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::pushes;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const Attractor<S>& a) {
    return Checklist()
        .also(fault_of_place(a.point, "point"))
        .finite(a.strength, "strength")
        .finite(a.least_distance, "least_distance")
        .finite(a.range, "range")
        .in_range(a.range <= Limits<S>::position(), "range", "0 to Limits::position()")
        .in_range(Limits<S>::minimum_size() <= a.least_distance, "least_distance", "Limits::minimum_size() or more")
        .proper(S(0) <= a.range, "range", "0 to Limits::position()")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const Attractor<S>& a) {
    return {{{a.body, "body", true, MustBe::any, Vec3<S>::zero(), "point"}, {}}, 1};
  }
  template <class Random> static void draw(Attractor<S>& a, Random& random) {
    if (random.one_in(2)) a.body = random.body();
    a.point = random.point(3, 2);
    // What all others are pulled with pulls a body back: a splinter cannot hold a whole world.
    constexpr double kHeavy = 64;  // [kg]
    const double mass = random.mass(a.body);
    a.strength = random.in(-2, 4, a.body && mass < kHeavy ? mass / kHeavy : 1);
    a.range = random.in(1, 4);
  }
  /// Pulls every awake body.
  template <class Forces> static void act(const Attractor<S>& a, Forces& forces) {
    const auto& bodies = forces.bodies;
    if (a.body && !bodies.is_enabled(a.body)) return;
    const auto source = a.body ? bodies.centre_of(a.body) : bodies.end_at({}, a.point);
    for (std::uint32_t row = 1; row < bodies.rows(); ++row) {
      if (row == source.row || !bodies.is_pushed(row, a.mask)) continue;
      const Heading<S> way = heading_of(source.at - bodies.state(row).centre);
      if (S(0) < a.range && a.range < way.length) continue;
      const S distance = max(way.length, a.least_distance);
      Bounder<S> bounder;
      const S once = bounder.quotient(a.strength, distance, highest<S>());
      const S size = bounder.quotient(once, distance, forces.sums.most());
      forces.sums.note_cut(row, bounder.cut);
      forces.sums.accelerate(row, way.direction * size);
      if (source.row == 0 || !bodies.moves(source.row)) continue;
      const S force = saturate_to<S>(product(size, bodies.mass(row).mass));
      forces.sums.push(source.row, way.direction * -force, Vec3<S>::zero());
    }
  }
};

}  // namespace isostep::detail
