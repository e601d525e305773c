// Random places and effects of zones.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/force_zone.hpp"
#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Draws a zone of bounded power, near the middle of a world.
template <class S> void draw_zone(Dice& dice, ForceZone<S>& zone) {
  zone.shape = static_cast<ZoneShape>(dice.below(3));
  zone.pose.position = vec<S>(dice.point(3));
  zone.pose.orientation = dice.template orientation<S>();
  const double x = dice.in(0.5, 2), y = dice.in(0.5, 2);
  zone.half = vec<S>(x, y, dice.in(0.5, 2));
  zone.acceleration = vec<S>(dice.arrow(0, 3));
  zone.wind = vec<S>(dice.arrow(0, 3));
}

}  // namespace isostep::test
