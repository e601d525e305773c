// BuoyancyPoint: the book's model of a floating body, a volume that sinks about one point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using BuoyancyId = Id<struct BuoyancyPointTag>;

/// Force at the point, against gravity, as the weight of the liquid displaced: share s of the volume, where s goes from
/// 0 to 1 while the point sinks from max_depth above the surface to max_depth below it.
/// Source:  Millington 2007, pp. 222-225. Differs: up is against the world's gravity, whose strength the force has.
template <class S> struct BuoyancyPoint {
  BodyId body = {};
  Vec3<S> point = {S(0), S(0), S(0)};  // [m] body frame: the centre of buoyancy
  S max_depth = S(1);                  // [m]
  S volume = S(0);                     // [m^3]
  S surface_height = S(0);             // [m] of the liquid's surface, along up
  S density = S(1000);                 // [kg/m^3] of the liquid

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("point", self.point);
    visit("max_depth", self.max_depth);
    visit("volume", self.volume);
    visit("surface_height", self.surface_height);
    visit("density", self.density);
  }
};

}  // namespace isostep
