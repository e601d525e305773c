// Ghost: two bodies that do not touch until they are apart.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/id.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

using GhostId = Id<struct GhostTag>;

/// Two bodies pass through each other: no contact, no overlap with a sensor, no stop of a bullet, and a character of
/// one of them does not see the other. As a step begins that finds them apart, the record ends by itself: where boxes
/// or exact shapes are further from each other than contacts are made, 2 cm, and a character's skin besides, so that
/// the end makes no contact. For what drops through its platform, or appears inside of something. A OneWay body makes
/// such records too. One record a pair, in whichever order.
template <class S> struct Ghost {
  BodyId a = {}, b = {};

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("a", self.a);
    visit("b", self.b);
  }
};

}  // namespace isostep
