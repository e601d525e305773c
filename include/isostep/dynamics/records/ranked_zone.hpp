// RankedZone: a force zone that may hide others where they overlap.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/force_zone.hpp"

namespace isostep {

using RankedZoneId = Id<struct RankedZoneTag>;

/// Bits of RankedZone::replaces.
namespace zone_effect {
inline constexpr std::uint32_t kAcceleration = 1u << 0;  // of zones
inline constexpr std::uint32_t kWind = 1u << 1;          // of zones
inline constexpr std::uint32_t kGravity = 1u << 2;       // Settings::gravity, which is below all zones
inline constexpr std::uint32_t kWater = 1u << 3;         // of Water, which has rank 0: what is inside is dry
inline constexpr std::uint32_t kAll = 15u;
}  // namespace zone_effect

/// A ForceZone with a rank. Of what acts at a point, effect by effect, zones below the highest rank that replaces the
/// effect there count for nothing; all others add up. A ForceZone has rank 0 and replaces nothing. Acts after them, by
/// (priority, slot). What a zone's mask leaves out it neither moves nor hides anything from; its wind blows for all.
/// A body whose centre of mass is in a zone that replaces the water is neither borne nor slowed by any; of a body that
/// reaches into it from outside, as the hull round a cabin, the water bears all that is below the surface.
template <class S> struct RankedZone : ForceZone<S> {
  std::int32_t priority = 0;
  std::uint32_t replaces = 0;  // zone_effect: what it hides, of zones of lower priority; 0: it adds to them

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    ForceZone<S>::fields(visit, self);
    visit("priority", self.priority);
    visit("replaces", self.replaces);
  }
};

}  // namespace isostep
