// DampingZone: a part of the world that slows what moves in it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/records/force_zone.hpp"
#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep {

using DampingZoneId = Id<struct DampingZoneTag>;

/// Slows awake dynamic bodies with a category of the mask and their centre of mass inside. Their velocity fades by
/// `linear` of itself a second, their angular velocity by `angular`, at any mass and inertia, beside their own damping.
/// Uses backward Euler, like all resistance: at no rate does a sub-step reverse a velocity. Among overlapping zones,
/// those below the highest priority that replaces have no effect; all others add up. A zone with rates of 0 that
/// replaces keeps a place free of others.
template <class S> struct DampingZone {
  ZoneShape shape = ZoneShape::everywhere;
  Pose<S> pose = Pose<S>::identity();  // of a sphere the position alone
  Vec3<S> half = {S(0), S(0), S(0)};   // [m] of a box; of a sphere x is the radius
  S linear = S(0);                     // [1/s] of velocities
  S angular = S(0);                    // [1/s] of angular velocities
  std::uint32_t mask = 0xffffffffu;    // categories: Filter
  std::int32_t priority = 0;
  bool replaces = false;  // hides zones of lower priority from what it acts on

  ISO_FIELDS(shape, pose, half, linear, angular, mask, priority, replaces)
};

}  // namespace isostep

namespace isostep::detail {

/// Returns true if the zone hides zones of lower priority at this point, from bodies of that category.
template <class S> ISO_INLINE bool replaces(const DampingZone<S>& zone, std::uint32_t category, Vec3<S> point) {
  return zone.replaces && (category & zone.mask) != 0 && is_inside(zone, point);
}

template <class S> struct RecordRules<DampingZone<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::slows;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const DampingZone<S>& z) {
    constexpr const char* kRate = "0 to 16384";
    return Checklist()
        .also(fault_of_region(z))
        .finite(z.linear, "linear")
        .finite(z.angular, "angular")
        .in_range(z.linear <= S(kMaxRate), "linear", kRate)
        .in_range(z.angular <= S(kMaxRate), "angular", kRate)
        .proper(S(0) <= z.linear, "linear", kRate)
        .proper(S(0) <= z.angular, "angular", kRate)
        .report();
  }
  template <class Random> static void draw(DampingZone<S>& z, Random& random) {
    random.region(z);
    z.linear = random.in(0, 4);
    z.angular = random.one_in(4) ? S(kMaxRate) : random.in(0, 4);
    z.priority = random.rank();
    z.replaces = random.one_in(2);
  }
  template <class Forces> static void slow(const DampingZone<S>& z, Forces& forces) {
    for (std::uint32_t row = 1; row < forces.bodies.rows(); ++row) {
      if (!forces.bodies.is_pushed(row, z.mask)) continue;
      const Vec3<S> centre = forces.bodies.state(row).centre;
      if (!is_inside(z, centre)) continue;
      const bool hidden = forces.zones.is_undamped(z.priority, forces.bodies.category(row), centre);
      if (!hidden) forces.resistance.fade(row, z.linear, z.angular);
    }
  }
};

}  // namespace isostep::detail
