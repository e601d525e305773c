// A world with characters in it, and what walks them.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/world/worlds.hpp"

namespace isostep::test {

inline constexpr double kRadius = 0.3, kHalf = 0.6;  // [m] of the capsule: its middle is 0.9 m up

template <class S> class Characters : public ::testing::Test {
 protected:
  CharacterId walker(D3 foot) {
    if (!capsule_) capsule_ = w.add_shape(Capsule<S>{num<S>(kRadius), num<S>(kHalf)});
    BodyDefinition<S> d = moving<S>(capsule_, foot + D3{0, kRadius + kHalf + kSkin, 0});
    d.type = BodyType::kinematic;
    d.allow_sleep = false;
    CharacterSettings<S> c;
    c.body = w.create(d);
    c.step_height = num<S>(0.4);
    const CharacterId id = w.add(c);
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  BodyId box(D3 half, D3 at, BodyType type = BodyType::static_, double mass = 0) {
    BodyDefinition<S> d = moving<S>(add_box(w, half.x, half.y, half.z), at);
    d.type = type;
    d.mass = num<S>(mass);
    return w.create(d);
  }
  BodyId ramp(double angle, D3 at) {
    BodyDefinition<S> d = still<S>(add_box(w, 4, 0.5, 2), at);
    d.orientation = turn<S>({0, 0, 1}, angle);
    return w.create(d);
  }
  void ask(CharacterId id, D3 move, double jump = 0) {
    EXPECT_TRUE(w.set_input(id, {vec<S>(move), num<S>(jump)})) << describe(w.fault());
  }
  /// Walks on for so many steps; true while it never leaves the floor.
  bool walk(CharacterId id, D3 move, int steps) {
    bool grounded = true;
    for (int i = 0; i < steps; ++i) {
      ask(id, move);
      EXPECT_TRUE(w.step().clean()) << i;
      grounded = grounded && footing(id) == Footing::floor;
    }
    return grounded;
  }
  D3 foot(CharacterId id) const { return real(w.pose(w.find(id)->body).position) - D3{0, kRadius + kHalf + kSkin, 0}; }
  Footing footing(CharacterId id) const { return w.state(id)->footing; }

  static constexpr double kSkin = 1.0 / 64;
  World<S> w{settings<S>()};
  ShapeId capsule_ = {};
};

}  // namespace isostep::test
