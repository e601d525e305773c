// ForceZone: a part of the world with its own gravity or wind, which may hide those of others.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

using ForceZoneId = Id<struct ForceZoneTag>;

enum class ZoneShape : std::uint32_t { everywhere, sphere, box };

/// The words for it, in scene files and in C.
inline constexpr const char* kZoneShapeNames[] = {"everywhere", "sphere", "box"};
ISO_INLINE constexpr std::span<const char* const> words_of(ZoneShape) { return kZoneShapeNames; }

/// Bits of ForceZone::replaces.
namespace zone_effect {
inline constexpr std::uint32_t kAcceleration = 1u << 0;  // of zones
inline constexpr std::uint32_t kWind = 1u << 1;          // of zones
inline constexpr std::uint32_t kGravity = 1u << 2;       // Settings::gravity, which is below all zones
inline constexpr std::uint32_t kWater = 1u << 3;         // of Water: what is inside is dry
inline constexpr std::uint32_t kAll = 15u;
}  // namespace zone_effect

/// Accelerates awake dynamic bodies with a category of the mask and their centre of mass inside. The wind moves no body
/// by itself: BodyDrag and AeroSurface use the sum of the winds at their points.
/// Priority: zones act by (priority, slot). For each effect at a point, zones below the highest priority that replaces
/// it there have no effect; all others add up. A zone neither moves a body outside its mask nor hides anything from it;
/// its wind blows for all. A body with its centre of mass in a zone that replaces water of lower priority is neither
/// borne nor slowed by that water. A body that reaches into the zone from outside, as the hull round a cabin, is borne
/// by all that is below the surface.
template <class S> struct ForceZone {
  ZoneShape shape = ZoneShape::everywhere;
  Pose<S> pose = Pose<S>::identity();         // of a sphere the position alone
  Vec3<S> half = {S(0), S(0), S(0)};          // [m] of a box; of a sphere x is the radius
  Vec3<S> acceleration = {S(0), S(0), S(0)};  // [m/s^2] world
  Vec3<S> wind = {S(0), S(0), S(0)};          // [m/s] world
  std::uint32_t mask = 0xffffffffu;           // categories: Filter. The wind blows for all
  std::int32_t priority = 0;
  std::uint32_t replaces = 0;  // zone_effect: what it hides, of zones of lower priority; 0: it adds to them

  ISO_FIELDS(shape, pose, half, acceleration, wind, mask, priority, replaces)
};

}  // namespace isostep

namespace isostep::detail {

/// Returns true if a point is in the region of a zone of any kind.
template <class Zone, class S> ISO_INLINE bool is_inside(const Zone& zone, Vec3<S> point) {
  if (zone.shape == ZoneShape::everywhere) return true;
  const Vec3<S> from_middle = point - zone.pose.position;
  if (zone.shape == ZoneShape::sphere) return length(from_middle) <= zone.half.x;
  const Vec3<S> local = transposed_times(to_matrix(zone.pose.orientation), from_middle);
  return within(local.x, zone.half.x) && within(local.y, zone.half.y) && within(local.z, zone.half.z);
}
/// Returns true if the zone hides an effect of lower zones at a point, from bodies of that category.
template <class S>
ISO_INLINE bool replaces(const ForceZone<S>& zone, std::uint32_t effect, std::uint32_t category, Vec3<S> point) {
  return (zone.replaces & effect) != 0 && (category & zone.mask) != 0 && is_inside(zone, point);
}

template <class S> struct RecordRules<ForceZone<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::pushes;
  static constexpr Wakes kWakes = Wakes::all;
  static FaultReport fault(const ForceZone<S>& z) {
    const S speed = Limits<S>::speed();
    return Checklist()
        .also(fault_of_region(z))
        .finite(z.acceleration, "acceleration")
        .finite(z.wind, "wind")
        .in_range(within(z.acceleration, speed), "acceleration", "components up to Limits::speed()")
        .in_range(no_longer(z.wind, speed), "wind", kWithinSpeed)
        .proper((z.replaces & ~zone_effect::kAll) == 0, "replaces", "bits of zone_effect")
        .report();
  }
  template <class Random> static void draw(ForceZone<S>& z, Random& random) {
    random.region(z);
    z.acceleration = random.arrow(0, 3);
    z.wind = random.arrow(0, 3);
    z.priority = random.rank();
    z.replaces = random.below(zone_effect::kAll + 1);
  }
  /// Accelerates every awake body inside. Zones handles its effects on wind, gravity and water.
  template <class Forces> static void act(const ForceZone<S>& z, Forces& forces) {
    if (z.acceleration == Vec3<S>::zero()) return;
    for (std::uint32_t row = 1; row < forces.bodies.rows(); ++row) {
      const Vec3<S> centre = forces.bodies.state(row).centre;
      if (!forces.bodies.is_pushed(row, z.mask) || !is_inside(z, centre)) continue;
      const std::uint32_t category = forces.bodies.category(row);
      const bool hidden = forces.zones.is_hidden(zone_effect::kAcceleration, z.priority, category, centre);
      if (!hidden) forces.sums.accelerate(row, z.acceleration);
    }
  }
};

}  // namespace isostep::detail
