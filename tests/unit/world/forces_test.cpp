// Forces that act from step to step: what each does, against formulas.
// SPDX-License-Identifier: MIT

#include "unit/world/forces.hpp"

namespace isostep::test {
namespace forces_test {

TYPED_TEST_SUITE(Forces, AllScalars);

TYPED_TEST(Forces, drag_leads_to_its_terminal_speed) {  // O3
  using S = TypeParam;
  const BodyId id = this->ball({0, 0, 0});
  this->added(this->world_.add(BodyDrag<S>{id, S(1), num<S>(0.5), S(0)}));
  run(this->world_, 900);
  const double k1 = 1, k2 = 0.5, weight = 20, terminal = (-k1 + std::sqrt(k1 * k1 + 4 * k2 * weight)) / (2 * k2);
  EXPECT_NEAR(-this->velocity(id).y, terminal, terminal * pick<S>(1e-4, 1e-9, 1e-2, 1e-6));
}

TYPED_TEST(Forces, drag_of_any_strength_only_slows) {
  using S = TypeParam;
  for (const double strength : {1.0, 100.0, 30000.0}) {
    const BodyId id = this->ball({0, 0, 0}, 0.5, {8, 0, 0});
    this->weightless();
    this->world_.set_velocity(id, vec<S>(8, 0, 0), vec<S>(0, 5, 0));
    const S most = num<S>(strength);
    this->added(this->world_.add(BodyDrag<S>{id, most, most, most}));
    double speed = 8, turning = 5;
    for (int i = 0; i < 60; ++i) {
      EXPECT_TRUE(this->world_.step().clean());
      EXPECT_GE(this->velocity(id).x, 0);
      EXPECT_LE(this->velocity(id).x, speed);
      EXPECT_GE(this->spin(id).y, 0);
      EXPECT_LE(this->spin(id).y, turning + 4 * speed_grain<S>(5));
      speed = this->velocity(id).x, turning = this->spin(id).y;
    }
    EXPECT_LT(speed, strength == 1.0 ? 4 : 0.2);
    EXPECT_LT(turning, strength == 1.0 ? 1 : 0.2);
    this->world_.destroy(id);
  }
}

TYPED_TEST(Forces, drag_turns_a_body_with_the_wind) {
  using S = TypeParam;
  this->weightless();
  const BodyId in = this->ball({0, 0, 0}), out = this->ball({8, 0, 0});
  for (const BodyId id : {in, out}) this->added(this->world_.add(BodyDrag<S>{id, S(4), S(0), S(0)}));
  ForceZone<S> zone;
  zone.shape = ZoneShape::box;
  zone.half = vec<S>(4, 4, 20);
  zone.wind = vec<S>(0, 0, 3);
  this->added(this->world_.add(zone));
  run(this->world_, 60);
  EXPECT_NEAR(this->velocity(in).z, 3 * (1 - std::exp(-2.0)), 0.02);
  EXPECT_EQ(this->velocity(out).z, 0);
}

TYPED_TEST(Forces, springs_hold_weights_and_swing_without_gaining) {  // defect 26: a compressed one pushes
  using S = TypeParam;
  const BodyId id = this->ball({0, 2, 0}, 2);
  BodySpring<S> spring;
  spring.a = id;
  spring.anchor_b = vec<S>(0, 4, 0);
  spring.rest_length = S(3);
  spring.stiffness = S(200);
  this->added(this->world_.add(spring));
  double lowest = 1e9, highest = -1e9;
  for (int i = 0; i < 600; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    if (i >= 540) lowest = std::min(lowest, this->centre(id).y), highest = std::max(highest, this->centre(id).y);
  }
  // About 4 - 3 - m g / k = 0.9, from 2: an amplitude of 1.1.
  EXPECT_NEAR((lowest + highest) / 2, 0.9, 0.02);
  EXPECT_NEAR((highest - lowest) / 2, 1.1, 0.03);
}

TYPED_TEST(Forces, damped_springs_come_to_rest_where_statics_says) {
  using S = TypeParam;
  const BodyId id = this->box({0, 1, 0}, {0.5, 0.125, 0.25}, 4);
  for (const double side : {-0.5, 0.5}) {
    BodySpring<S> spring;
    spring.a = id;
    spring.anchor_a = vec<S>(side, 0, 0);
    spring.anchor_b = vec<S>(side, 3, 0);
    spring.rest_length = S(2);
    spring.stiffness = S(side < 0 ? 100 : 50);
    spring.damping = S(8);
    this->added(this->world_.add(spring));
  }
  run(this->world_, 1200);
  // 20 N each: stretched by 0.2 and by 0.4 m.
  expect_near(this->centre(id), {0, 3 - 2.3, 0}, 0.005);
  EXPECT_NEAR(rotated<S>(this->world_.pose(id).orientation, D3{1, 0, 0}).y, -0.2, 0.005);
}

TYPED_TEST(Forces, bungees_only_pull) {  // defect 27
  using S = TypeParam;
  this->weightless();
  const BodyId slack = this->ball({0, 0, 0}), taut = this->ball({4, 0, 0});
  BodySpring<S> spring;
  spring.only_pulls = true;
  spring.stiffness = S(20);
  spring.rest_length = S(2);
  spring.a = slack;
  spring.anchor_b = vec<S>(0, 1, 0);
  this->added(this->world_.add(spring));
  spring.a = taut;
  spring.anchor_b = vec<S>(4, 3, 0);
  this->added(this->world_.add(spring));
  run(this->world_, 10);
  EXPECT_EQ(this->velocity(slack).y, 0);
  EXPECT_GT(this->velocity(taut).y, 0.5);
}

TYPED_TEST(Forces, between_bodies_keep_momentum) {  // O24
  using S = TypeParam;
  this->weightless();
  const BodyId a = this->ball({0, 0, 0}, 2, {0, 0, 1}), b = this->ball({3, 0, 0}, 2);
  BodySpring<S> spring;
  spring.a = a, spring.b = b;
  spring.anchor_a = vec<S>(0.25, 0.25, 0);
  spring.rest_length = S(2);
  spring.stiffness = S(30);
  this->added(this->world_.add(spring));
  Attractor<S> attractor;
  attractor.body = a;
  attractor.strength = S(4);
  this->added(this->world_.add(attractor));
  run(this->world_, 120);
  expect_near(this->velocity(a) + this->velocity(b), {0, 0, 1}, 2e4 * speed_grain<S>() + 1e-9);
  EXPECT_GT(length(this->velocity(b)), 0.1);
  EXPECT_GT(length(this->spin(a)), 0.01);
}

TYPED_TEST(Forces, thrusters_push_and_turn_with_their_body) {
  using S = TypeParam;
  this->weightless();
  const BodyId id = this->box({0, 0, 0}, {1, 0.5, 0.5}, 3);
  this->added(this->world_.add(Thruster<S>{id, vec<S>(0, 0, 0), vec<S>(6, 0, 0)}));
  run(this->world_, 30);
  expect_near(this->velocity(id), {1, 0, 0}, 0.002);
  this->world_.set_pose(id, {Vec3<S>::zero(), turn<S>({0, 1, 0}, kPi / 2)});
  this->world_.set_velocity(id, Vec3<S>::zero(), Vec3<S>::zero());
  run(this->world_, 30);
  expect_near(this->velocity(id), {0, 0, -1}, 0.002);
  // Off the centre it turns: I = m (x^2 + y^2) / 3 = 1.25.
  this->world_.set_pose(id, Pose<S>::identity());
  this->world_.set_velocity(id, Vec3<S>::zero(), Vec3<S>::zero());
  const auto ids = this->world_.state().records->thrusters.slot_map().template ids<ThrusterId>();
  ASSERT_EQ(ids.size(), 1u);
  EXPECT_TRUE(this->world_.set(ids[0], {id, vec<S>(0, 0.5, 0), vec<S>(3, 0, 0)}));
  run(this->world_, 6);
  EXPECT_NEAR(this->spin(id).z, -1.5 * 0.1 / 1.25, 0.003);
}

TYPED_TEST(Forces, buoyancy_floats_at_the_depth_of_its_mass) {  // O21; defect 28
  using S = TypeParam;
  const BodyId id = this->ball({0, 1, 0}, 5);
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = id;
  buoyancy.max_depth = num<S>(0.5);
  buoyancy.volume = num<S>(0.02);
  buoyancy.surface_height = S(1);
  this->added(this->world_.add(buoyancy));
  run(this->world_, 6);
  // w^2 = density volume g / (2 max_depth m) = 40; begun 0.25 m below its place, from rest.
  EXPECT_NEAR(this->centre(id).y, 1.25 - 0.25 * std::cos(std::sqrt(40) * 0.1), 0.005);
  this->added(this->world_.add(BodyDrag<S>{id, S(20), S(0), S(0)}));
  run(this->world_, 600);
  EXPECT_NEAR(this->centre(id).y, 1 + 0.5 - 5 / 20.0, pick<S>(1e-4, 1e-6, 1e-2, 1e-5));
  EXPECT_LT(std::fabs(this->velocity(id).y), 0.001);
}

TYPED_TEST(Forces, zones_accelerate_what_is_inside_and_of_their_categories) {
  using S = TypeParam;
  const BodyId in = this->ball({0, 0, 0}), out = this->ball({0, 5, 0}), other = this->ball({2, 0, 0});
  this->world_.set_filter(other, {4, 0xffffffffu, 0});
  ForceZone<S> zone;
  zone.shape = ZoneShape::box;
  zone.pose.orientation = turn<S>({0, 0, 1}, kPi / 4);
  zone.half = vec<S>(2.5, 2.5, 1);
  zone.acceleration = vec<S>(0, 10, 2);
  zone.mask = 1;
  const ForceZoneId id = this->added(this->world_.add(zone));
  run(this->world_, 30);
  expect_near(this->velocity(in), {0, 0, 1}, 0.002);
  expect_near(this->velocity(out), {0, -5, 0}, 0.002);
  expect_near(this->velocity(other), {0, -5, 0}, 0.002);
  EXPECT_TRUE(this->world_.remove(id));
  run(this->world_, 30);
  expect_near(this->velocity(in), {0, -5, 1}, 0.002);
}

TYPED_TEST(Forces, attractors_keep_bodies_in_orbit) {
  using S = TypeParam;
  this->weightless();
  const BodyId planet = this->ball({4, 0, 0}, 1, {0, 0, 2}), far = this->ball({20, 0, 0});
  Attractor<S> sun;
  sun.strength = S(16);
  sun.range = S(10);
  this->added(this->world_.add(sun));
  for (int i = 0; i < 1200; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    EXPECT_NEAR(length(this->centre(planet)), 4, pick<S>(0.02, 0.02, 0.25, 0.02));
  }
  EXPECT_LT(this->centre(planet).x, 3.9);
  EXPECT_EQ(this->velocity(far).x, 0);
}

}  // namespace forces_test
}  // namespace isostep::test
