// Bodies in a world: kinds of body, compounds, gravity, damping, locks, filters, and where the world ends.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace bodies_test {

template <class S> class WorldBodies : public ::testing::Test {};
TYPED_TEST_SUITE(WorldBodies, AllScalars);

TYPED_TEST(WorldBodies, a_fixed_body_never_moves_whatever_falls_on_it) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = still<S>(add_box(w, 1, 0.5, 1), {0, 0, 0});
  const BodyId table = w.create(d);
  const BodyId load = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0.25, 2, 0}));
  EXPECT_EQ(w.velocity(table), Vec3<S>::zero());
  run(w, 60);
  EXPECT_EQ(w.pose(table).position, d.position);
  EXPECT_EQ(w.pose(table).orientation, d.orientation);
  EXPECT_NEAR(to_double(w.center_of_mass(load).y), 1, 0.02);
  EXPECT_FALSE(w.is_awake(table));
}

TYPED_TEST(WorldBodies, a_kinematic_body_goes_as_told_and_nothing_stops_it) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 64, 4));
  BodyDefinition<S> d = still<S>(add_box(w, 0.5, 0.5, 0.5), {-2, 1, 0});
  d.type = BodyType::kinematic;
  d.velocity = vec<S>(1, 0, 0);
  const BodyId pusher = w.create(d);
  add_ground(w);
  BodyDefinition<S> crate = moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0});
  crate.mass = num<S>(100);
  const BodyId pushed = w.create(crate);
  run(w, 128);
  // 1/256 s is exact, and so is the sum of 512 of them.
  expect_near(real(w.pose(pusher).position), {0, 1, 0}, 4 * grain<S>());
  EXPECT_EQ(w.velocity(pusher), vec<S>(1, 0, 0));
  EXPECT_NEAR(to_double(w.velocity(pushed).x), 1, 0.02);
  EXPECT_NEAR(to_double(w.center_of_mass(pushed).x), 1, 0.02);
  EXPECT_NEAR(to_double(w.center_of_mass(pushed).y), 0.5, 0.02);
}

TYPED_TEST(WorldBodies, a_kinematic_body_carries_and_drops_with_its_velocity) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = still<S>(add_box(w, 2, 0.25, 2), {0, 0, 0});
  d.type = BodyType::kinematic;
  const BodyId lift = w.create(d);
  const BodyId load = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.75, 0}));
  run(w, 20);
  ASSERT_TRUE(w.set_velocity(lift, vec<S>(0.5, 1, 0), vec<S>(0, 0, 0)));
  run(w, 60);
  expect_near(real(w.velocity(load)), {0.5, 1, 0}, 0.02);
  EXPECT_NEAR(to_double(w.center_of_mass(load).y) - to_double(w.center_of_mass(lift).y), 0.75, 0.02);
}

TYPED_TEST(WorldBodies, two_boxes_in_one_shape_have_the_mass_centre_and_inertia_of_both) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  // Unit cubes at x = 0 and 3: centre 3/2, I_y = 2 (1/6 + 9/4).
  const BodyId id =
      w.create(moving<S>(add_two_boxes(w, {0.5, 0.5, 0.5}, {0, 0, 0}, {0.5, 0.5, 0.5}, {3, 0, 0}), {1, 2, 3}));
  EXPECT_NEAR(to_double(w.mass(id)), 2, 8 * grain<S>());
  expect_near(real(w.center_of_mass(id)), {2.5, 2, 3}, 8 * grain<S>());
  expect_near(real(w.pose(id).position), {1, 2, 3}, 8 * grain<S>(3));
  ASSERT_TRUE(w.apply_impulse(id, Vec3<S>::zero(), vec<S>(0, 4, 0)));
  const double inertia = 2 * (1.0 / 6 + 2.25);
  EXPECT_NEAR(to_double(w.angular_velocity(id).y), 4 / inertia, pick<S>(1e-5, 1e-12, 1e-3, 1e-8));
  run(w, 60);
  // It turns about its centre, and its origin with it.
  expect_near(real(w.center_of_mass(id)), {2.5, 2, 3}, 64 * grain<S>(3));
  const double angle = 480 * 2 * std::atan(4 / inertia / 960);
  expect_near(real(w.pose(id).position), {2.5 - 1.5 * std::cos(angle), 2, 3 + 1.5 * std::sin(angle)},
              pick<S>(1e-4, 1e-8, 1e-2, 1e-6));
}

TYPED_TEST(WorldBodies, a_compound_stands_while_its_centre_is_above_its_support_and_falls_when_not) {
  using S = TypeParam;
  for (const bool heavy_end_supported : {true, false}) {
    World<S> w(settings<S>());
    add_ground(w);
    w.create(still<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
    // A cube of 1 m^3 and a plate of 0.1 m^3 whose centre is 1 m aside: the whole's is 1/11 m from the cube's.
    const D3 cube = heavy_end_supported ? D3{0, 0, 0} : D3{1, 0, 0},
             plate = heavy_end_supported ? D3{1, 0, 0} : D3{0, 0, 0};
    BodyDefinition<S> d = moving<S>(add_two_boxes(w, {0.5, 0.5, 0.5}, cube, {0.5, 0.5, 0.05}, plate), {0, 1.5, 0});
    const BodyId id = w.create(d);
    EXPECT_NEAR(to_double(w.center_of_mass(id).x), heavy_end_supported ? 1.0 / 11 : 10.0 / 11, 0.001);
    run(w, 120);
    if (heavy_end_supported) expect_near(real(w.pose(id).position), {0, 1.5, 0}, 0.02);
    else EXPECT_LT(to_double(w.center_of_mass(id).y), 1.2);
  }
}

TYPED_TEST(WorldBodies, gravity_acts_by_its_scale) {
  using S = TypeParam;
  World<S> w(settings<S>(-8, 64, 4));
  const ShapeId ball = add_ball(w, 0.25);
  for (const double scale : {1.0, 0.0, 0.5, -1.0}) {
    BodyDefinition<S> d = moving<S>(ball, {4 * scale, 0, 10 * scale});
    d.gravity_scale = num<S>(scale);
    const BodyId id = w.create(d);
    World<S> alone(settings<S>(-8, 64, 4));
    d.shape = add_ball(alone, 0.25);
    const BodyId there = alone.create(d);
    run(alone, 64);
    expect_near(real(alone.velocity(there)), {0, -8 * scale, 0}, 256 * speed_grain<S>(8));
    EXPECT_NEAR(to_double(alone.center_of_mass(there).y), -4 * scale, pick<S>(1e-4, 1e-12, 64 * 0x1p-16, 1e-7))
        << "the parabola";
    EXPECT_TRUE(w.set_motion(id, num<S>(scale), S(0), S(0), 0));
  }
}

TYPED_TEST(WorldBodies, damping_divides_velocity_by_one_plus_h_c_every_substep) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 4));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0}, {8, 0, -4});
  d.angular_velocity = vec<S>(0, 6, 0);
  d.linear_damping = num<S>(2);
  d.angular_damping = num<S>(0.5);
  const BodyId id = w.create(d);
  run(w, 64);
  const double keep = std::pow(1 + 2.0 / 256, -256), keep_angular = std::pow(1 + 0.5 / 256, -256);
  const double bound = pick<S>(1e-4, 1e-12, 4e-2, 1e-6);  // Q16.16 keeps a factor near one to 1 / 65536, 256 times
  expect_near(real(w.velocity(id)), {8 * keep, 0, -4 * keep}, bound);
  expect_near(real(w.angular_velocity(id)), {0, 6 * keep_angular, 0}, bound);
}

TYPED_TEST(WorldBodies, heavy_damping_never_turns_a_velocity_round) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0}, {8, 0, -4});
  d.linear_damping = num<S>(10000);
  const BodyId id = w.create(d);
  for (int i = 0; i < 10; ++i) {
    w.step();
    EXPECT_GE(to_double(w.velocity(id).x), 0);
    EXPECT_LE(to_double(w.velocity(id).z), 0);
  }
  EXPECT_LT(to_double(w.velocity(id).x), 0.001);
}

TYPED_TEST(WorldBodies, a_locked_axis_holds_bit_for_bit_in_free_flight) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 1), {1, 20, 3});
  d.locks =
      body_flag::kLockX | body_flag::kLockAngularX | body_flag::kLockAngularX << 1 | body_flag::kLockAngularX << 2;
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_impulse(id, vec<S>(5, 0, 5), vec<S>(1, 2, 3)));
  run(w, 30);
  EXPECT_EQ(w.center_of_mass(id).x, S(1));
  EXPECT_EQ(w.pose(id).orientation, d.orientation);
  EXPECT_GT(to_double(w.center_of_mass(id).z), 3.1);
  EXPECT_LT(to_double(w.center_of_mass(id).y), 19);
}

TYPED_TEST(WorldBodies, a_locked_axis_holds_when_other_bodies_push) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  BodyDefinition<S> d = moving<S>(ball, {0, 0, 0});
  d.locks = body_flag::kLockX | body_flag::kLockAngularX << 2;
  const BodyId held = w.create(d);
  BodyDefinition<S> fast = moving<S>(ball, {-2, 0, 0}, {10, 0, 0});
  const BodyId hit = w.create(fast);
  run(w, 30);
  EXPECT_EQ(w.center_of_mass(held).x, S(0));
  EXPECT_EQ(w.velocity(held).x, S(0));
  EXPECT_LT(to_double(w.center_of_mass(hit).x), -0.98) << "what runs into a locked body runs into a wall";
  EXPECT_LT(std::fabs(to_double(w.velocity(hit).x)), 0.2);
}

TYPED_TEST(WorldBodies, a_body_that_may_not_turn_slides_down_upright) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> slope = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0.6), Unit<S>(0.8), Unit<S>(0)}, S(0)}));
  slope.material.friction = S(0);
  w.create(slope);
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 1, 0});
  d.locks = 7u * body_flag::kLockAngularX;
  d.material.friction = S(0);
  const BodyId id = w.create(d);
  run(w, 60);
  EXPECT_EQ(w.pose(id).orientation, d.orientation);
  EXPECT_GT(to_double(w.center_of_mass(id).x), 1);
  EXPECT_NEAR(0.6 * to_double(w.center_of_mass(id).x) + 0.8 * to_double(w.center_of_mass(id).y), 0.7, 0.03);
}

TYPED_TEST(WorldBodies, filters_part_bodies_by_category_mask_and_group) {
  using S = TypeParam;
  const auto collide = [](Filter a, Filter b) {
    World<S> w(settings<S>(0));
    const ShapeId ball = add_ball(w, 0.5);
    BodyDefinition<S> d = moving<S>(ball, {-1, 0, 0}, {6, 0, 0});
    d.filter = a;
    const BodyId first = w.create(d);
    d = moving<S>(ball, {1, 0, 0}, {-6, 0, 0});
    d.filter = b;
    w.create(d);
    run(w, 20);
    return to_double(w.velocity(first).x) < 3;
  };
  EXPECT_TRUE(collide({}, {}));
  EXPECT_FALSE(collide({2, 0xffffffffu, 0}, {1, ~2u, 0}));
  EXPECT_FALSE(collide({1, ~4u, 0}, {4, 0xffffffffu, 0}));
  EXPECT_TRUE(collide({2, 4, 0}, {4, 2, 0}));
  EXPECT_FALSE(collide({1, 0xffffffffu, 7}, {1, 0xffffffffu, 7}));
  EXPECT_TRUE(collide({1, 0xffffffffu, 7}, {1, 0xffffffffu, 8}));
  EXPECT_FALSE(collide({0, 0xffffffffu, 0}, {}));
}

TYPED_TEST(WorldBodies, a_filter_set_anew_acts_at_once_both_ways) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const BodyId ground = add_ground(w);
  const BodyId box = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  ASSERT_TRUE(settle(w));
  ASSERT_TRUE(w.set_filter(ground, {1, 0, 0}));
  EXPECT_TRUE(w.is_awake(box));
  run(w, 10);
  EXPECT_LT(to_double(w.velocity(box).y), -1);
  ASSERT_TRUE(w.set_filter(ground, {}));
  ASSERT_TRUE(settle(w));
  EXPECT_NEAR(to_double(w.center_of_mass(box).y), 0.5, 0.03);
}

TYPED_TEST(WorldBodies, a_body_that_does_not_collide_falls_through_everything) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 1, 0});
  d.collide = false;
  const BodyId id = w.create(d);
  run(w, 60);
  EXPECT_LT(to_double(w.center_of_mass(id).y), -3);
  EXPECT_EQ(w.counts().contacts, 0u);
}

TYPED_TEST(WorldBodies, speed_beyond_the_limit_is_cut_and_reported) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const S most = Limits<S>::speed();
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  ASSERT_TRUE(w.set_velocity(id, {most, S(0), S(0)}, Vec3<S>::zero()));
  ASSERT_TRUE(w.apply_impulse(id, {w.mass(id) * S(8), S(0), S(0)}));
  EXPECT_EQ(w.step().clamped_speed, 1u);
  EXPECT_EQ(w.velocity(id).x, most);
  EXPECT_EQ(w.step().clamped_speed, 0u);
}

TYPED_TEST(WorldBodies, a_body_stops_at_the_edge_of_the_world_and_that_is_reported) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const S edge = Limits<S>::position();
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {to_double(edge) - 1, 0, 0}, {60, 1, 0}));
  EXPECT_EQ(w.step().clamped_position, 0u);
  EXPECT_EQ(w.step().clamped_position, 1u);
  EXPECT_EQ(w.center_of_mass(id).x, edge);
  EXPECT_EQ(w.velocity(id).x, S(0));
  EXPECT_NEAR(to_double(w.velocity(id).y), 1, 1e-3);
  EXPECT_TRUE(w.step().clean());
}

TYPED_TEST(WorldBodies, a_point_of_a_body_moves_and_turns_with_it) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {1, 2, 3}, {4, 0, 0});
  d.angular_velocity = vec<S>(0, 2, 0);
  const BodyId id = w.create(d);
  expect_near(real(w.velocity_at(id, vec<S>(1, 2, 3.5))), {5, 0, 0}, 1e-3);
  expect_near(real(w.velocity_at(id, vec<S>(1.5, 5, 3))), {4, 0, -1}, 1e-3);
  EXPECT_EQ(w.velocity_at({}, vec<S>(1, 2, 3)), Vec3<S>::zero());
}

}  // namespace bodies_test
}  // namespace isostep::test
