// DampingZone: a part of the world that slows what moves in it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/force_zone.hpp"

namespace isostep {

using DampingZoneId = Id<struct DampingZoneTag>;

/// Dynamic bodies that are awake, of a category of the mask, with their centre of mass inside, are slowed: their
/// velocity fades by `linear` of itself a second, their turning by `angular`, whatever their mass and inertia, beside
/// the damping that they have themselves. By backward Euler, as all that resists motion: at no rate does a sub-step
/// turn a velocity round. Of zones that overlap those below the highest priority that replaces count for nothing; all
/// others add up. A zone of rates of 0 that replaces keeps a place free of others.
template <class S> struct DampingZone {
  ZoneShape shape = ZoneShape::everywhere;
  Pose<S> pose = Pose<S>::identity();  // of a sphere the position alone
  Vec3<S> half = {S(0), S(0), S(0)};   // [m] of a box; of a sphere x is the radius
  S linear = S(0);                     // [1/s] of velocities
  S angular = S(0);                    // [1/s] of angular velocities
  std::uint32_t mask = 0xffffffffu;    // categories: Filter
  std::int32_t priority = 0;
  bool replaces = false;  // hides zones of lower priority from what it acts on

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("shape", self.shape);
    visit("pose", self.pose);
    visit("half", self.half);
    visit("linear", self.linear);
    visit("angular", self.angular);
    visit("mask", self.mask);
    visit("priority", self.priority);
    visit("replaces", self.replaces);
  }
};

}  // namespace isostep
