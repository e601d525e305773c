// ForceZone: a part of the world with its own gravity or wind.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

using ForceZoneId = Id<struct ForceZoneTag>;

enum class ZoneShape : std::uint32_t { everywhere, sphere, box };

/// Dynamic bodies that are awake, of a category of the mask, with their centre of mass inside, are accelerated. The
/// wind moves no body by itself: BodyDrag and AeroSurface feel the sum of the winds at their points.
template <class S> struct ForceZone {
  ZoneShape shape = ZoneShape::everywhere;
  Pose<S> pose = Pose<S>::identity();         // of a sphere the position alone
  Vec3<S> half = {S(0), S(0), S(0)};          // [m] of a box; of a sphere x is the radius
  Vec3<S> acceleration = {S(0), S(0), S(0)};  // [m/s^2] world
  Vec3<S> wind = {S(0), S(0), S(0)};          // [m/s] world
  std::uint32_t mask = 0xffffffffu;           // categories: Filter. The wind blows for all

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("shape", self.shape);
    visit("pose", self.pose);
    visit("half", self.half);
    visit("acceleration", self.acceleration);
    visit("wind", self.wind);
    visit("mask", self.mask);
  }
};

}  // namespace isostep
