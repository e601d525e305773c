// The places of a random world's bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "random/dice.hpp"
#include "random/parts.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

inline constexpr double kPlaceTop = 8;  // [m] most that a body is put at

/// Places a body where nothing is, so that nothing is pushed out of anything: a null id where no place was found.
template <class S>
BodyId place_freely(World<S>& w, Dice& dice, BodyDefinition<S> d, double reach, D3 low, D3 high, std::uint32_t group) {
  const Primitive<S> around = primitive_of(Sphere<S>{num<S>(reach + 0.05)});
  for (int tries = 0; tries < 8; ++tries) {
    const D3 at = {dice.in(low.x, high.x), dice.in(low.y, high.y), dice.in(low.z, high.z)};
    std::vector<BodyId> there;
    w.overlap_shape(around, {vec<S>(at), Quat<Unit<S>>::identity()}, there);
    const bool free = std::all_of(there.begin(), there.end(), [&](BodyId other) {
      return group != 0 && w.view(other).properties->filter.group == group;
    });
    if (!free) continue;
    d.position = vec<S>(at);
    d.filter.group = group;
    return w.create(d);
  }
  return {};
}
template <class S> BodyId add_loose(World<S>& w, Dice& dice, double most) {
  const DrawnShape shape = draw_shape(w, dice);
  BodyDefinition<S> d = draw_body<S>(dice, shape.shape);
  d.velocity = vec<S>(dice.arrow(0, most));
  d.angular_velocity = vec<S>(dice.arrow(0, 6));
  d.sensor = dice.one_in(24);
  return place_freely(w, dice, d, shape.reach, {-4, 0.5, -4}, {4, kPlaceTop, 4}, 0);
}

}  // namespace isostep::test
