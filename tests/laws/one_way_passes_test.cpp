// Law of OneWay: what passes a body from below keeps its motion to the last bit, and lands on it afterwards.
// SPDX-License-Identifier: MIT

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace one_way_passes_test {

/// Bodies of all kinds below a platform at y = 3, thrown up; they pass each other. `with`: it is there.
template <class S> std::vector<BodyId> jumpers(World<S>& w, bool with, int count) {
  const BodyId platform = w.create(still<S>(add_box(w, 100, 0.125, 100), {0, 3, 0}));
  OneWay<S> record;
  record.body = platform;
  const bool made = with ? static_cast<bool>(w.add(record)) : w.set_filter(platform, {1, 0, 0});
  EXPECT_TRUE(made) << describe(w.fault());
  const ShapeId shapes[] = {add_ball(w, 0.25), add_box(w, 0.25, 0.25, 0.25), add_box(w, 0.125, 0.5, 0.25),
                            w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.25)})};
  Dice dice(77);
  std::vector<BodyId> all;
  for (int i = 0; i < count; ++i) {
    const D3 velocity = {dice.in(-3, 3), dice.in(4, 16), dice.in(-3, 3)};
    const D3 place = {dice.in(-60, 60), dice.in(0.5, 2), dice.in(-60, 60)};
    BodyDefinition<S> d = moving<S>(shapes[i % 4], place, velocity);
    d.angular_velocity = vec<S>(dice.point(4));
    d.orientation = dice.orientation<S>();
    d.filter.group = 7;
    d.allow_sleep = false;
    all.push_back(w.create(d));
  }
  return all;
}

/// The ghosts by body slot.
template <class S> std::vector<std::uint8_t> ghosts_of(const World<S>& w) {
  std::vector<std::uint8_t> all(w.state().body_slots.entries().size(), 0);
  for (const Ghost<S>& ghost : w.state().records->ghosts.all()) {
    if (ghost.a) all[ghost.a.slot] = all[ghost.b.slot] = 1;
  }
  return all;
}

template <class S> class OneWayPasses : public ::testing::Test {};
TYPED_TEST_SUITE(OneWayPasses, AllScalars);

TYPED_TEST(OneWayPasses, a_thousand_jumps_keep_every_bit_while_they_pass_and_land_on_top) {
  using S = TypeParam;
  constexpr std::size_t kJumps = 1000;
  World<S> with(settings<S>()), without(settings<S>());
  const std::vector<BodyId> a = jumpers(with, true, kJumps), b = jumpers(without, false, kJumps);
  std::vector<std::uint8_t> inside(kJumps, 0), above(kJumps, 0);
  std::size_t passed = 0, returned = 0;
  for (int frame = 0; frame < 150; ++frame) {
    with.step();
    without.step();
    const std::vector<std::uint8_t> ghosts = ghosts_of(with);
    for (std::size_t i = 0; i < kJumps; ++i) {
      if (above[i] != 0) continue;  // what comes after is a landing
      const auto one = with.view(a[i]), other = without.view(b[i]);
      const double y = to_double(other.state->centre.y);
      const bool is_inside = ghosts[a[i].slot] != 0, out = inside[i] != 0 && !is_inside;
      inside[i] = is_inside ? 1 : 0;
      if (out && y > 3) {
        above[i] = 1;
        ++passed;
      }
      returned += out && y < 3 ? 1u : 0u;
      ASSERT_EQ(one.state->velocity, other.state->velocity) << i << ", step " << frame;
      ASSERT_EQ(one.state->angular_velocity, other.state->angular_velocity) << i;
      ASSERT_EQ(one.state->centre, other.state->centre) << i;
    }
  }
  EXPECT_GT(passed, 600u);
  EXPECT_GT(returned, 50u);
  for (int frame = 0; frame < 240; ++frame) with.step();
  for (std::size_t i = 0; i < kJumps; ++i) {
    if (above[i] == 0) continue;
    EXPECT_GT(to_double(with.center_of_mass(a[i]).y), 3.125 + 0.1) << i;
    EXPECT_LT(std::fabs(to_double(with.velocity(a[i]).y)), 0.1) << i;
  }
  for (const std::uint8_t ghost : ghosts_of(with)) EXPECT_EQ(ghost, 0u) << "all are apart";
}

}  // namespace one_way_passes_test
}  // namespace isostep::test
