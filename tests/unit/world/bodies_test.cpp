// What bodies do in a world: kinds of body, compounds, surfaces, filters, sensors, contacts' events, locks and damping.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

template <class S> class WorldBodies : public ::testing::Test {};
TYPED_TEST_SUITE(WorldBodies, AllScalars);

template <class S> Child<S> part(const Primitive<S>& primitive, D3 at) {
  return {primitive, {vec<S>(at), Quat<Unit<S>>::identity()}};
}
template <class S> ShapeId add_two_boxes(World<S>& w, D3 half_a, D3 at_a, D3 half_b, D3 at_b) {
  const Child<S> parts[] = {part(primitive_of(Box<S>{vec<S>(half_a)}), at_a),
                            part(primitive_of(Box<S>{vec<S>(half_b)}), at_b)};
  return w.add_shape(std::span<const Child<S>>(parts));
}

TYPED_TEST(WorldBodies, a_fixed_body_never_moves_whatever_falls_on_it) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> d = still<S>(add_box(w, 1, 0.5, 1), {0, 0, 0});
  d.velocity = vec<S>(1, 2, 3);
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
    // Velocity first: x_n = a h^2 n (n + 1) / 2, n = 256.
    expect_near(real(alone.velocity(there)), {0, -8 * scale, 0}, 256 * speed_grain<S>(8));
    EXPECT_NEAR(to_double(alone.center_of_mass(there).y), -8 * scale * 256 * 257 / 2 / 65536,
                pick<S>(1e-4, 1e-12, 64 * 0x1p-16, 1e-7));
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

TYPED_TEST(WorldBodies, of_two_restitutions_the_larger_counts) {
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

TYPED_TEST(WorldBodies, of_two_frictions_the_root_of_the_product_counts) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w, 0.2);
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}, {4, 0, 0});
  d.material.friction = num<S>(0.8);
  const BodyId id = w.create(d);
  run(w, 30);
  EXPECT_NEAR(to_double(w.velocity(id).x), 4 - 0.4 * 10 * 0.5, 0.05);
}

TYPED_TEST(WorldBodies, rolling_resistance_stops_a_ball_where_its_lever_arm_says) {
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

TYPED_TEST(WorldBodies, without_rolling_resistance_a_ball_rolls_on) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.5, 0}, {2, 0, 0});
  d.angular_velocity = vec<S>(0, 0, -4);
  const BodyId id = w.create(d);
  run(w, 300);
  EXPECT_NEAR(to_double(w.velocity(id).x), 2, pick<S>(0.01, 0.01, 0.05, 0.01));
}

TYPED_TEST(WorldBodies, a_conveyor_brings_a_box_to_its_own_speed_and_never_lets_it_sleep) {
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

TYPED_TEST(WorldBodies, a_sensor_tells_of_coming_and_going_once_each_and_pushes_nothing) {
  using S = TypeParam;
  World<S> w(settings<S>(0)), without(settings<S>(0));
  const BodyId flier = w.create(moving<S>(add_ball(w, 0.5), {-3, 0, 0}, {6, 0, 0}));
  const BodyId twin = without.create(moving<S>(add_ball(without, 0.5), {-3, 0, 0}, {6, 0, 0}));
  BodyDefinition<S> d = still<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0, 0});
  d.sensor = true;
  const BodyId sensor = w.create(d);
  int begins = 0, ends = 0, begin_step = 0, end_step = 0;
  for (int i = 1; i <= 60; ++i) {
    w.step();
    without.step();
    for (const SensorEvent& e : w.events().sensor_begin) {
      EXPECT_EQ(e.sensor, sensor);
      EXPECT_EQ(e.other, flier);
      ++begins;
      begin_step = i;
    }
    for (const SensorEvent& e : w.events().sensor_end) {
      EXPECT_EQ(e.sensor, sensor);
      EXPECT_EQ(e.other, flier);
      ++ends;
      end_step = i;
    }
    EXPECT_TRUE(w.events().contact_begin.empty());
  }
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 1);
  // Surfaces meet at x = -1 and part at x = 1: 20 steps and 40 steps of 1/10 m, seen when the next step begins.
  EXPECT_NEAR(begin_step, 21, 1);
  EXPECT_NEAR(end_step, 41, 1);
  EXPECT_EQ(w.center_of_mass(flier), without.center_of_mass(twin));
  EXPECT_EQ(w.velocity(flier), without.velocity(twin));
}

TYPED_TEST(WorldBodies, what_sleeps_inside_a_sensor_stays_inside_until_either_is_moved) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  BodyDefinition<S> d = still<S>(box, {0, 0.5, 0});
  d.sensor = true;
  const BodyId sensor = w.create(d);
  const BodyId sleeper = w.create(moving<S>(box, {0, 0.5, 0}));
  int begins = 0, ends = 0;
  const auto step = [&] {
    w.step();
    begins += static_cast<int>(w.events().sensor_begin.size());
    ends += static_cast<int>(w.events().sensor_end.size());
  };
  for (int i = 0; i < 90; ++i) step();
  EXPECT_FALSE(w.is_awake(sleeper));
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 0);
  ASSERT_TRUE(w.set_pose(sensor, {vec<S>(5, 0.5, 0), Quat<Unit<S>>::identity()}));
  for (int i = 0; i < 90; ++i) step();
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 1);
  EXPECT_FALSE(w.is_awake(sleeper));
  ASSERT_TRUE(w.set_pose(sensor, {vec<S>(0, 0.5, 0), Quat<Unit<S>>::identity()}));
  for (int i = 0; i < 3; ++i) step();
  EXPECT_EQ(begins, 2);
  EXPECT_TRUE(w.destroy(sleeper));
  for (int i = 0; i < 3; ++i) step();
  EXPECT_TRUE(w.state().overlaps.empty());
}

TYPED_TEST(WorldBodies, a_contact_begins_once_with_the_impulse_that_stopped_the_body) {
  using S = TypeParam;
  for (const double e : {0.0, 0.5}) {
    World<S> w(settings<S>(0));
    const BodyId ground = add_ground(w);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 1, 0}, {0, -4, 0});
    d.mass = S(3);
    d.material.restitution = num<S>(e);
    const BodyId ball = w.create(d);
    int begins = 0, ends = 0;
    for (int i = 0; i < 30; ++i) {
      w.step();
      for (const ContactBegin<S>& c : w.events().contact_begin) {
        ++begins;
        EXPECT_EQ(c.a, ground);
        EXPECT_EQ(c.b, ball);
        expect_near(real(c.normal), {0, 1, 0}, 1e-4);
        // The push out of the overlap that the ball arrived with comes on top.
        EXPECT_GE(to_double(c.impulse), 0.99 * 3 * 4 * (1 + e));
        EXPECT_LE(to_double(c.impulse), 1.2 * 3 * 4 * (1 + e));
      }
      ends += static_cast<int>(w.events().contact_end.size());
    }
    EXPECT_EQ(begins, 1);
    EXPECT_GE(ends, e > 0 ? 1 : 0);
    EXPECT_LE(ends, 1);
  }
}

TYPED_TEST(WorldBodies, the_impulse_between_two_moving_bodies_is_that_of_their_reduced_mass) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  BodyDefinition<S> d = moving<S>(ball, {-1, 0, 0}, {3, 0, 0});
  d.mass = S(2);
  const BodyId a = w.create(d);
  d = moving<S>(ball, {1, 0, 0}, {-3, 0, 0});
  d.mass = S(6);
  const BodyId b = w.create(d);
  double impulse = 0;
  for (int i = 0; i < 20; ++i) {
    w.step();
    for (const ContactBegin<S>& c : w.events().contact_begin) impulse = to_double(c.impulse);
  }
  EXPECT_NEAR(impulse, 1.5 * 6, 0.05 * 9);
  EXPECT_NEAR(to_double(w.velocity(a).x), -1.5, 0.05);
  EXPECT_NEAR(to_double(w.velocity(b).x), -1.5, 0.05);
}

TYPED_TEST(WorldBodies, contact_events_ascend_by_bodies_and_pair_up) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId ball = add_ball(w, 0.5);
  for (int i = 0; i < 30; ++i)
    w.create(moving<S>(ball, {0.7 * (i % 5) + 0.01 * i, 1.0 + 1.1 * (i / 5), 0.6 * (i % 3)}));
  std::vector<std::pair<BodyId, BodyId>> touching;
  std::size_t total = 0;
  const auto slots = [](auto& e) { return std::uint64_t{e.a.slot} << 32 | e.b.slot; };
  for (int i = 0; i < 240; ++i) {
    w.step();
    const Events<S>& events = w.events();
    for (std::size_t k = 0; k < events.contact_begin.size(); ++k) {
      EXPECT_LT(events.contact_begin[k].a.slot, events.contact_begin[k].b.slot);
      if (k > 0) {
        EXPECT_LT(slots(events.contact_begin[k - 1]), slots(events.contact_begin[k]));
      }
      EXPECT_GE(to_double(events.contact_begin[k].impulse), 0) << "less than the format shows is none";
      touching.emplace_back(events.contact_begin[k].a, events.contact_begin[k].b);
    }
    total += events.contact_begin.size();
    for (std::size_t k = 0; k < events.contact_end.size(); ++k) {
      if (k > 0) {
        EXPECT_LT(slots(events.contact_end[k - 1]), slots(events.contact_end[k]));
      }
      const std::pair<BodyId, BodyId> pair(events.contact_end[k].a, events.contact_end[k].b);
      std::size_t at = 0;
      while (at < touching.size() && touching[at] != pair) ++at;
      ASSERT_LT(at, touching.size()) << "a contact ended that never began";
      touching.erase(touching.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  EXPECT_GT(total, 40u);
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

TYPED_TEST(WorldBodies, render_poses_lie_between_the_last_two_steps) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d =
      moving<S>(add_two_boxes(w, {0.5, 0.5, 0.5}, {0, 0, 0}, {0.5, 0.5, 0.5}, {3, 0, 0}), {1, 2, 3}, {6, 0, 0});
  d.angular_velocity = vec<S>(0, 3, 0);
  const BodyId id = w.create(d);
  w.create(still<S>(add_ball(w, 1), {20, 0, 0}));
  ASSERT_EQ(w.poses_float(0).size(), 1u);
  EXPECT_FLOAT_EQ(w.poses_float(0)[0].position[0], 1);
  w.step();
  const Pose<S> first = w.pose(id);
  w.step();
  const Pose<S> second = w.pose(id);
  const auto expect_at = [&](float alpha, D3 at) {
    const RenderPose pose = w.poses_float(alpha)[0];
    EXPECT_EQ(pose.body, id);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(pose.position[i], at[i], 2e-4);
    double norm = 0;
    for (const float q : pose.orientation) norm += static_cast<double>(q) * q;
    EXPECT_NEAR(norm, 1, 1e-6);
  };
  expect_at(0, real(first.position));
  expect_at(1, real(second.position));
  expect_at(0.5f, (real(first.position) + real(second.position)) * 0.5);
}

TYPED_TEST(WorldBodies, a_body_new_since_the_last_step_is_drawn_where_it_is) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId old = w.create(moving<S>(ball, {0, 0, 0}, {6, 0, 0}));
  const BodyId gone = w.create(moving<S>(ball, {100, 0, 0}, {6, 0, 0}));
  w.step();
  w.step();
  ASSERT_TRUE(w.destroy(gone));
  const BodyId fresh = w.create(moving<S>(ball, {-100, 0, 0}));
  const std::vector<RenderPose> poses = w.poses_float(0.5f);
  ASSERT_EQ(poses.size(), 2u);
  for (const RenderPose& pose : poses) {
    EXPECT_TRUE(pose.body == fresh || pose.body == old);
    EXPECT_NEAR(pose.position[0], pose.body == fresh ? -100 : 0.15, 1e-3);
  }
}

TYPED_TEST(WorldBodies, a_teleported_body_is_not_drawn_on_the_way) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  w.step();
  ASSERT_TRUE(w.set_pose(id, {vec<S>(100, 0, 0), Quat<Unit<S>>::identity()}));
  EXPECT_FLOAT_EQ(w.poses_float(0.5f)[0].position[0], 100);
}

}  // namespace
}  // namespace isostep::test
