// Water: a body of water, in which everything floats, sinks and is slowed by what of it is wet.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

using WaterId = Id<struct WaterTag>;

/// Dynamic bodies that are awake, of a category of the mask, whose boxes touch the region, are borne by the weight of
/// the water in place of them: of each part of their shapes the exact volume below the surface, at its centre. What
/// drag says is of the wet part alone: it slows its centre, and the body's turning, to those of the water.
/// The surface is level, up is against the world's gravity; without gravity there is no surface and no force. A wave
/// travels over it, height wave_height sin(2 pi (x / wave_length - t / wave_period)) with x along wave_direction, and
/// carries the water round in circles (Airy's of deep water). A body meets it as the plane that touches it above or
/// below the body's centre of mass, along whose normal it is borne: what is longer than a third of a wave has waves of
/// its own to be built of several bodies.
/// Source:  Archimedes; geometry/submersion.hpp. Millington 2007, pp. 222-225, has BuoyancyPoint.
template <class S> struct Water {
  S surface_height = S(0);               // [m] along up, of the water at rest
  S density = S(1000);                   // [kg/m^3]
  Vec3<S> middle = {S(0), S(0), S(0)};   // [m] of the region: a box along the world's axes
  Vec3<S> half = {S(0), S(0), S(0)};     // [m] all 0: everywhere
  Vec3<S> current = {S(0), S(0), S(0)};  // [m/s]
  S linear_drag = S(0.5);                // [1/s] each of a kg of water displaced
  S quadratic_drag = S(0);               // [1/m] the same, times speed
  S angular_drag = S(0.5);               // [1/s] of the body's turning, each of its kg displaced
  S wave_height = S(0);                  // [m] above the water at rest; 0: no wave
  S wave_length = S(10);                 // [m]
  S wave_period = S(3);                  // [s]
  Vec3<Unit<S>> wave_direction = {Unit<S>(1), Unit<S>(0), Unit<S>(0)};  // [1] unit length; along the surface
  std::uint32_t mask = 0xffffffffu;                                     // categories: Filter

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("surface_height", self.surface_height);
    visit("density", self.density);
    visit("middle", self.middle);
    visit("half", self.half);
    visit("current", self.current);
    visit("linear_drag", self.linear_drag);
    visit("quadratic_drag", self.quadratic_drag);
    visit("angular_drag", self.angular_drag);
    visit("wave_height", self.wave_height);
    visit("wave_length", self.wave_length);
    visit("wave_period", self.wave_period);
    visit("wave_direction", self.wave_direction);
    visit("mask", self.mask);
  }
};

template <class S> ISO_INLINE bool in_region(const Water<S>& water, const Aabb<S>& box) {
  const Vec3<S> h = water.half;
  return h == Vec3<S>::zero() || overlap(Aabb<S>::around(water.middle, h), box);
}

}  // namespace isostep
