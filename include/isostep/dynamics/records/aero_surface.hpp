// AeroSurface: a wing, sail, keel, rudder or hydrofoil as a tensor that turns the air's velocity into a force.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

using AeroSurfaceId = Id<struct AeroSurfaceTag>;

/// Force at a point of the body: tensor v in the surface's frame, with v the velocity of that point, the body's turning
/// included, through the air (less the wind of the zones around it). What resists has negative entries. Under water,
/// if it is made for that: through the Water around it, and without a force while the point is above it.
/// A control surface: control from -1 to 1 leads from `low` over `tensor` to `high`, straight between them.
/// An angled surface: `orientation` turns its frame in the body's.
/// Source:  Millington 2007, pp. 217-222, 225-227. Differs: the wind is taken off, the body's turning counts, the
///          force may grow with the speed squared, and large tensors are stable.
template <class S> struct AeroSurface {
  BodyId body = {};
  Vec3<S> point = {S(0), S(0), S(0)};                     // [m] body frame
  Quat<Unit<S>> orientation = Quat<Unit<S>>::identity();  // surface's frame to body frame
  Mat3<S> tensor = Mat3<S>::diagonal(Vec3<S>::zero());    // [N s/m], or [N s^2/m^2] of |v| v
  Mat3<S> low = Mat3<S>::diagonal(Vec3<S>::zero());
  Mat3<S> high = Mat3<S>::diagonal(Vec3<S>::zero());
  S control = S(0);  // [1] -1 to 1
  bool is_quadratic = false;
  bool is_under_water = false;  // a keel, a water rudder, a hydrofoil

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("body", self.body);
    visit("point", self.point);
    visit("orientation", self.orientation);
    visit("tensor", self.tensor);
    visit("low", self.low);
    visit("high", self.high);
    visit("control", self.control);
    visit("is_quadratic", self.is_quadratic);
    visit("is_under_water", self.is_under_water);
  }
};

}  // namespace isostep
