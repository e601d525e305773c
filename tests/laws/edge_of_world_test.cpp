// Bodies thrown about at the edge of the world, alone and joined, stay within Limits: a state that a step leaves can be
// read again.
// SPDX-License-Identifier: MIT

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace edge_of_world_test {

template <class S> class EdgeOfWorld : public ::testing::Test {};
TYPED_TEST_SUITE(EdgeOfWorld, AllScalars);

/// Continuous collision put what joints hold where they have it, and what is stopped between two poses at the edge
/// where rounding leads.
TYPED_TEST(EdgeOfWorld, holds_what_walls_stop_there) {
  using S = TypeParam;
  constexpr int kWorlds = 40, kFrames = 20;
  const double edge = to_double(Limits<S>::position()), fast = std::min(200.0, to_double(Limits<S>::speed()));
  int at_edge = 0;
  for (int seed = 0; seed < kWorlds; ++seed) {
    Dice dice(static_cast<std::uint64_t>(seed));
    World<S> w(settings<S>(0));
    const D3 corner = {dice.one_in(2) ? edge : -edge, dice.in(-edge, edge), dice.one_in(2) ? edge : -edge};
    const auto inwards = [&](double x, double z) {
      return D3{corner.x * (1 - x / edge), corner.y, corner.z * (1 - z / edge)};
    };
    for (const double at : {1.0, 3.0}) w.create(still<S>(add_box(w, 0.125, 4, 8), inwards(at, 4)));
    BodyId last = {};
    for (int i = 0; i < 4; ++i) {
      const double x = dice.in(0, 4), z = dice.in(0, 8);
      BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.5, 0.25), inwards(x, z), dice.arrow(fast / 4, fast));
      d.angular_velocity = vec<S>(dice.arrow(0, 20));
      d.bullet = dice.one_in(3);
      d.filter.group = 1;
      const BodyId body = w.create(d);
      if (!body) continue;  // a corner of it would be beyond
      if (last && dice.one_in(2)) {
        const double far = dice.one_in(2) ? 0 : dice.in(0, 0.5 * edge);
        w.create(w.joint_at(JointType::ball, last, body, {vec<S>(inwards(x + far, z)), Quat<Unit<S>>::identity()}));
      }
      last = body;
    }
    for (int frame = 0; frame < kFrames; ++frame) {
      w.step();
      for (const BodyId body : w.bodies()) {
        ASSERT_LE(max_abs(real(w.center_of_mass(body))), edge) << "seed " << seed << ", frame " << frame;
        at_edge += max_abs(real(w.center_of_mass(body))) == edge ? 1 : 0;
      }
      const std::vector<std::uint8_t> bytes = bytes_of(w);
      World<S> other(settings<S>());
      Reader reader(bytes);
      ASSERT_TRUE(other.read_portable(reader)) << "seed " << seed << ", frame " << frame;
    }
  }
  EXPECT_GT(at_edge, 100);
}

}  // namespace edge_of_world_test
}  // namespace isostep::test
