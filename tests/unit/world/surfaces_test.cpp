// What surfaces do to bodies: restitution, friction, rolling resistance, conveyors.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

template <class S> class WorldSurfaces : public ::testing::Test {};
TYPED_TEST_SUITE(WorldSurfaces, AllScalars);

TYPED_TEST(WorldSurfaces, of_two_restitutions_the_larger_counts) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId ball = add_ball(w, 0.5);
  int index = 0;
  for (const double e : {0.0, 0.5, 1.0}) {
    BodyDefinition<S> d = moving<S>(ball, {4.0 * index++, 0.75, 0}, {0, -6, 0});
    d.material.restitution = num<S>(e);
    const BodyId id = w.create(d);
    w.set_motion(id, S(0), S(0), S(0), 0);
    EXPECT_EQ(w.velocity(id).y, S(-6));
  }
  run(w, 6);
  const std::vector<BodyId> ids = w.bodies();
  EXPECT_NEAR(to_double(w.velocity(ids[1]).y), 0, 0.01);
  EXPECT_NEAR(to_double(w.velocity(ids[2]).y), 3, 0.01);
  EXPECT_NEAR(to_double(w.velocity(ids[3]).y), 6, 0.01);
}

TYPED_TEST(WorldSurfaces, of_two_frictions_the_root_of_the_product_counts) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w, 0.2);
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}, {4, 0, 0});
  d.material.friction = num<S>(0.8);
  const BodyId id = w.create(d);
  run(w, 30);
  EXPECT_NEAR(to_double(w.velocity(id).x), 4 - 0.4 * 10 * 0.5, 0.05);
}

TYPED_TEST(WorldSurfaces, rolling_resistance_stops_a_ball_where_its_lever_arm_says) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const double r = 0.5, arm = 0.05, v = 2;
  BodyDefinition<S> d = moving<S>(add_ball(w, r), {0, r, 0}, {v * 0.6, 0, v * 0.8});
  d.angular_velocity = vec<S>(v * 0.8 / r, 0, -v * 0.6 / r);
  d.material.rolling_resistance = num<S>(arm);
  const BodyId id = w.create(d);
  ASSERT_TRUE(settle(w, 60 * 5));
  // (m + I / r^2) a = arm m g / r with I = 2/5 m r^2.
  const double distance = v * v / (2 * 5.0 / 7 * 10 * arm / r);
  const D3 at = real(w.center_of_mass(id));
  EXPECT_NEAR(at.x, 0.6 * distance, 0.03 * distance);
  EXPECT_NEAR(at.z, 0.8 * distance, 0.03 * distance);
}

TYPED_TEST(WorldSurfaces, without_rolling_resistance_a_ball_rolls_on) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.5, 0}, {2, 0, 0});
  d.angular_velocity = vec<S>(0, 0, -4);
  const BodyId id = w.create(d);
  run(w, 300);
  EXPECT_NEAR(to_double(w.velocity(id).x), 2, pick<S>(0.01, 0.01, 0.05, 0.01));
}

TYPED_TEST(WorldSurfaces, a_conveyor_brings_a_box_to_its_own_speed_and_never_lets_it_sleep) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> belt = still<S>(add_box(w, 20, 0.5, 20), {0, -0.5, 0});
  belt.material.surface_velocity = vec<S>(1.2, 0, -1.6);
  const BodyId carrier = w.create(belt);
  const BodyId box = w.create(moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}));
  // 2 m/s at 6 m/s^2 takes a third of a second.
  run(w, 12);
  EXPECT_NEAR(to_double(w.velocity(box).x), 0.6 * 6 * 0.2, 0.1);
  EXPECT_NEAR(to_double(w.velocity(box).z), -0.8 * 6 * 0.2, 0.1);
  run(w, 88);
  expect_near(real(w.velocity(box)), {1.2, 0, -1.6}, 0.01);
  EXPECT_EQ(w.velocity(carrier), Vec3<S>::zero());
  EXPECT_TRUE(w.is_awake(box));
  Material<S> stopped;
  ASSERT_TRUE(w.set_material(carrier, stopped));
  EXPECT_TRUE(settle(w));
}

}  // namespace
}  // namespace isostep::test
