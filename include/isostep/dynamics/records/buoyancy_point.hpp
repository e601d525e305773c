// BuoyancyPoint: the book's model of a floating body, a volume that sinks about one point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using BuoyancyId = Id<struct BuoyancyPointTag>;

/// Applies a force at the point, against gravity, equal to the weight of the displaced liquid: share s of the volume,
/// where s goes from 0 to 1 while the point sinks from max_depth above the surface to max_depth below it.
/// Source:  Millington 2007, pp. 222-225. Differs: up is against the world's gravity, whose strength the force has.
template <class S> struct BuoyancyPoint {
  BodyId body = {};
  Vec3<S> point = {S(0), S(0), S(0)};  // [m] body frame: the centre of buoyancy
  S max_depth = S(1);                  // [m]
  S volume = S(0);                     // [m^3]
  S surface_height = S(0);             // [m] of the liquid's surface, along up
  S density = S(1000);                 // [kg/m^3] of the liquid

  ISO_FIELDS(body, point, max_depth, volume, surface_height, density)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<BuoyancyPoint<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes;
  static constexpr bool kBears = true;
  static FaultReport fault(const BuoyancyPoint<S>& b) {
    return Checklist()
        .also(fault_of_place(b.point, "point"))
        .finite(b.max_depth, "max_depth")
        .finite(b.volume, "volume")
        .finite(b.surface_height, "surface_height")
        .finite(b.density, "density")
        .in_range(b.max_depth <= Limits<S>::extent(), "max_depth", "above 0, up to Limits::extent()")
        .in_range(within(b.surface_height, Limits<S>::position()), "surface_height", "a size up to Limits::position()")
        .proper(S(0) < b.max_depth, "max_depth", "above 0, up to Limits::extent()")
        .proper(S(0) <= b.volume, "volume", kZeroOrMore)
        .proper(S(0) <= b.density, "density", kZeroOrMore)
        .report();
  }
  static constexpr NamedBodies<S> bodies(const BuoyancyPoint<S>& b) { return named_point(b.body, b.point, "point"); }
  template <class Random> static void draw(BuoyancyPoint<S>& b, Random& random) {
    b.body = random.body();
    b.max_depth = random.in(0.125, 0.5);
    b.volume = random.in(0, 2);
    b.density = random.in(1, 1, random.mass(b.body));
    b.surface_height = random.in(0, 2);
  }
  template <class Forces> static void act(const BuoyancyPoint<S>& b, Forces& forces) {
    const auto end = forces.bodies.end_at(b.body, b.point);
    const Heading<S> down = heading_of(forces.bodies.gravity());
    const S sunk = b.surface_height + b.max_depth + dot(end.at, down.direction);
    const S share = clamp(sunk / (b.max_depth + b.max_depth), S(0), S(1));
    const S displaced = saturate_to<S>(product(saturate_to<S>(product(b.density, b.volume)), share));
    forces.sums.push(end, down.direction * -saturate_to<S>(product(displaced, down.length)));
  }
};

}  // namespace isostep::detail
