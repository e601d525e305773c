// Particles among bodies: momentum, rest, friction, filters and sleep.
// SPDX-License-Identifier: MIT
#include "isostep/effects/particle_coupling.hpp"

#include "unit/effects/coupled.hpp"

namespace isostep::test {
namespace particle_coupling_test {

template <class S> class CouplingOf : public ::testing::Test {};
TYPED_TEST_SUITE(CouplingOf, AllScalars);

TYPED_TEST(CouplingOf, a_central_blow_leaves_body_and_particle_with_the_speeds_of_the_book) {
  using S = TypeParam;
  for (const double bounce : {0.0, 0.5, 1.0}) {
    for (const double mass : {0.125, 2.0, 16.0}) {
      Coupled<S> game(0);
      const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0, 0}, 2);
      const ParticleId hit = game.drop(game.grain(0.125, 0, bounce), {-1, 0, 0}, mass, {4, 0, 0});
      game.run(30);
      const double share = mass / (mass + 2);
      EXPECT_NEAR(game.speed(body).x, 4 * (1 + bounce) * share, pick<S>(1e-5, 1e-9, 2e-4, 1e-7)) << bounce << mass;
      EXPECT_NEAR(game.speed(hit).x, 4 * share - 4 * bounce * (1 - share), pick<S>(1e-5, 1e-9, 2e-4, 1e-7));
    }
  }
}

TYPED_TEST(CouplingOf, a_body_and_what_hits_it_keep_their_momentum_and_gain_no_energy) {
  using S = TypeParam;
  Coupled<S> game(0);
  const ParticleMaterialId grain = game.grain(0.05, 0.5, 0.3);
  const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0, 0}, 2);
  for (int i = 0; i < 12; ++i)
    game.drop(grain, {-2 - 0.1 * i, 0.1 * (i % 3), 0.11 * (i % 4) - 0.1}, 0.1 + 0.05 * i, {6, 0.2 * i - 1, 0});
  const auto energy = [&] {
    double sum = 0;
    for (const ParticleId id : game.particles.particles())
      sum += to_double(game.particles.mass(id)) / 2 * length(game.speed(id)) * length(game.speed(id));
    const double angular_speed = length(real(game.bodies.angular_velocity(body)));
    return sum + length(game.speed(body)) * length(game.speed(body)) +
           angular_speed * angular_speed / 6;  // of a cube: m a^2 / 6
  };
  const D3 before = game.momentum();
  double least = energy();
  for (int i = 0; i < 120; ++i) {
    game.step();
    EXPECT_LT(energy(), least * 1.001) << i;
    least = std::min(least, energy());
  }
  EXPECT_GT(game.speed(body).x, 2.0);
  // One rounding of a velocity a touch and sub-step, times the mass; a float rounds by the size.
  expect_near(game.momentum(), before, pick<S>(1e-4, 1e-12, 5e-4, 1e-7));
}

TYPED_TEST(CouplingOf, a_crowd_that_arrives_together_pushes_no_faster_than_it_came) {
  using S = TypeParam;
  for (const double mass : {0.03125, 0.125, 1.0}) {  // sixteen of them: half the body's, twice, and sixteen times
    Coupled<S> game(0);
    const ParticleMaterialId grain = game.grain(0.05);
    const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0, 0}, 1);
    for (int i = 0; i < 16; ++i) game.drop(grain, {-0.7, 0.2 * (i % 4) - 0.3, 0.2 * (i / 4) - 0.3}, mass, {6, 0, 0});
    for (int i = 0; i < 40; ++i) {
      game.step();
      ASSERT_LE(game.speed(body).x, 6.001) << mass << " at " << i;
      ASSERT_LT(length(real(game.bodies.angular_velocity(body))), 0.01);
    }
    EXPECT_GE(game.speed(body).x, 6 * 16 * mass / (1 + 16 * mass) - 0.001) << mass;  // what sticking would give
    EXPECT_EQ(game.coupling.report().crowded, 0u);
  }
}

TYPED_TEST(CouplingOf, a_box_comes_to_rest_on_the_tops_of_pegs_however_it_came) {
  using S = TypeParam;
  for (const double place : {0.1, 0.3, 0.45}) {
    for (const double tilt : {0.0, 0.1}) {
      Coupled<S> game;
      const ParticleMaterialId peg = game.grain(0.125, 0.6);
      for (const double x : {-place, place}) {
        for (const double z : {-place, place}) game.drop(peg, {x, 0, z}, 1, {0, 0, 0}, true);
      }
      BodyDefinition<S> d = moving<S>(add_box(game.bodies, 0.5, 0.5, 0.5), {tilt / 5, 0.75, tilt / 10});
      d.mass = S(3);
      d.orientation = turn<S>({0, 0, 1}, tilt);
      const BodyId body = game.bodies.create(d);
      game.run(300);
      for (int i = 0; i < 60; ++i) {
        game.step();
        ASSERT_NEAR(game.at(body).y, 0.625, 0.003) << place;
        ASSERT_LT(length(game.speed(body)), 0.005) << place;
        ASSERT_LT(length(real(game.bodies.angular_velocity(body))), 0.01) << place;
      }
      EXPECT_NEAR(game.at(body).x, 0, 0.1);
    }
  }
}

TYPED_TEST(CouplingOf, a_cloth_catches_a_box_and_holds_it) {
  using S = TypeParam;
  Coupled<S> game;
  hang_cloth(game, 13, 0.1, 1, 0.03125, 200, 1);
  const D3 half = {0.2, 0.2, 0.2};
  const BodyId body = game.box(half, {0.02, 1.5, 0.03}, 1);
  for (int i = 0; i < 600; ++i) {
    game.step();
    ASSERT_LT(game.deepest_in(body, half, 0.05), 0.045) << i;  // no particle's centre enters
  }
  const double held = game.at(body).y;
  EXPECT_GT(held, 0.9);
  EXPECT_LT(held, 1.2);
  for (int i = 0; i < 60; ++i) {
    game.step();
    ASSERT_LT(length(game.speed(body)), 0.05);
    ASSERT_LT(game.fastest_particle(), 0.6);  // 1 cm a step
    ASSERT_NEAR(game.at(body).y, held, 0.01);
    ASSERT_LT(game.deepest_in(body, half, 0.05), 0.02);
  }
  EXPECT_TRUE(game.bodies.is_awake(body));
}

TYPED_TEST(CouplingOf, rain_on_one_side_of_a_seesaw_tips_it) {
  using S = TypeParam;
  Coupled<S> game;
  const D3 half = {1, 0.05, 0.3};
  const BodyId plank = game.box(half, {0, 1, 0}, 2);
  game.bodies.create(game.bodies.joint_at(JointType::hinge, plank, {}, {vec<S>(0, 1, 0), Quat<Unit<S>>::identity()}));
  const ParticleMaterialId drop = game.grain(0.04);
  for (int i = 0; i < 30; ++i) game.drop(drop, {0.5 + 0.1 * (i % 4), 1.3 + 0.1 * i, 0.1 * (i % 3) - 0.1}, 0.05);
  for (int i = 0; i < 60; ++i) {
    game.step();
    ASSERT_LT(game.deepest_in(plank, half, 0.04), 0.02) << i;
  }
  const D3 arm = rotated<S>(game.bodies.pose(plank).orientation, {1, 0, 0});
  EXPECT_LT(arm.y, -0.2);
  EXPECT_NEAR(arm.z, 0, 0.01);
  EXPECT_NEAR(length(game.at(plank) - D3{0, 1, 0}), 0, 0.01);
}

TYPED_TEST(CouplingOf, a_pile_comes_to_rest_on_a_fixed_box) {
  using S = TypeParam;
  Coupled<S> game;
  const D3 half = {2, 0.25, 2};
  const BodyId table = game.bodies.create(still<S>(add_box(game.bodies, half.x, half.y, half.z)));
  const ParticleMaterialId grain = game.grain(0.1, 0.6, 0, true);
  for (int i = 0; i < 36; ++i)
    game.drop(grain, {0.21 * (i % 3), 0.5 + 0.21 * (i / 9), 0.21 * (i / 3 % 3) + 0.02 * (i % 2)}, 0.1);
  for (int i = 0; i < 360; ++i) {
    game.step();
    ASSERT_LT(game.deepest_in(table, half, 0.1), 0.03) << i;
  }
  EXPECT_LT(game.fastest_particle(), 0.05);
  EXPECT_LT(game.deepest_in(table, half, 0.1), 0.01);
  for (const ParticleId id : game.particles.particles()) EXPECT_GT(game.at(id).y, 0.33);
}

TYPED_TEST(CouplingOf, a_ball_rolls_over_a_rope_bridge) {
  using S = TypeParam;
  Coupled<S> game;
  const ShapeId bank = add_box(game.bodies, 1, 0.25, 1);
  game.bodies.create(still<S>(bank, {-2.5, -0.25, 0}));
  game.bodies.create(still<S>(bank, {2.5, -0.25, 0}));
  const ParticleMaterialId rope = game.grain(0.05, 0.5);
  std::vector<ParticleId> ropes;
  for (const double z : {-0.2, 0.0, 0.2}) {
    ParticleId last;
    for (int i = 0; i <= 20; ++i) {
      const bool end = i == 0 || i == 20;
      const ParticleId next = game.drop(rope, {-1.5 + 0.15 * i, -0.06, z}, 0.25, {0, 0, 0}, end);
      ropes.push_back(next);
      if (last) {
        Link<S> link;
        link.type = LinkType::rod;
        link.a = last;
        link.b = next;
        link.length = num<S>(0.15);
        game.particles.add(link);
      }
      last = next;
    }
  }
  game.run(120);
  const ShapeId ball = add_ball(game.bodies, 0.3);
  BodyDefinition<S> d = moving<S>(ball, {-2, 0.3, 0}, {4, 0, 0});
  d.angular_velocity = vec<S>(0, 0, -4 / 0.3);
  d.mass = S(1);
  const BodyId id = game.bodies.create(d);
  for (int i = 0; i < 120 && game.at(id).x < 2; ++i) {
    game.step();
    for (const ParticleId each : ropes) ASSERT_GT(length(game.at(id) - game.at(each)), 0.3) << i;  // 0.35 apart
  }
  EXPECT_GE(game.at(id).x, 2);
  EXPECT_GT(game.at(id).y, 0.29);
  EXPECT_NEAR(game.at(id).z, 0, 0.1);
}

TYPED_TEST(CouplingOf, friction_drags_a_particle_along_with_a_kinematic_body_after_coulombs_slip) {
  using S = TypeParam;
  Coupled<S> game;
  const BodyId floor = game.kinematic_box({5, 0.5, 5}, {0, -0.5, 0}, {1, 0, 0});
  const ParticleId rubbing = game.drop(game.grain(0.125, 0.6), {0, 0.125, 0}, 0.5);
  const ParticleId sliding = game.drop(game.grain(0.125), {0, 0.125, 1}, 0.5);
  game.run(120);
  EXPECT_NEAR(game.speed(rubbing).x, 1, 0.001);
  EXPECT_NEAR(game.at(floor).x - game.at(rubbing).x, 1.0 / (2 * 0.6 * 10), 0.006);  // v^2 / (2 mu g), a step's part
  EXPECT_EQ(game.speed(sliding).x, 0);  // friction is the root of the product, and a particle has none by itself
  EXPECT_NEAR(game.at(sliding).y, 0.125, 0.002);
}

TYPED_TEST(CouplingOf, a_lift_takes_particles_along_without_letting_them_sink) {
  using S = TypeParam;
  Coupled<S> game;
  const BodyId lift = game.kinematic_box({1, 0.5, 1}, {0, -0.5, 0}, {0, 2, 0});
  const ParticleId p = game.drop(game.grain(0.125), {0, 0.125, 0}, 0.5);
  for (int i = 0; i < 120; ++i) {
    game.step();
    ASSERT_NEAR(game.at(p).y - game.at(lift).y, 0.625, 0.004) << i;
  }
  EXPECT_NEAR(game.speed(p).y, 2, 0.001);
}

TYPED_TEST(CouplingOf, a_belt_carries_particles) {
  using S = TypeParam;
  Coupled<S> game;
  BodyDefinition<S> d = still<S>(add_box(game.bodies, 5, 0.5, 5), {0, -0.5, 0});
  d.material.surface_velocity = vec<S>(1.5, 3, 0);  // a belt runs along its surface: the part across it is nothing
  game.bodies.create(d);
  const ParticleId p = game.drop(game.grain(0.125, 0.6), {0, 0.125, 0}, 0.5);
  game.run(90);
  EXPECT_NEAR(game.speed(p).x, 1.5, 0.001);
  EXPECT_NEAR(game.at(p).y, 0.125, 0.004);
}

TYPED_TEST(CouplingOf, a_bullet_stops_at_a_thin_wall_and_passes_beside_it_unharmed) {
  using S = TypeParam;
  Coupled<S> game(0);
  game.bodies.create(still<S>(add_box(game.bodies, 0.05, 1, 1)));
  const ParticleMaterialId shot = game.grain(0.05, 0, 1);
  const double fast = 200;  // 3.3 m a step
  const ParticleId at_wall = game.drop(shot, {-1, 0.3, 0.2}, 0.1, {fast, 20, 0});
  const ParticleId beside = game.drop(shot, {-1, 1.1, 0.3}, 0.1, {fast, 0, 0});
  const ParticleId ahead = game.drop(shot, {-6, 0, 0}, 0.1, {fast, 0, 0});
  game.run(6);
  const double tolerance = pick<S>(1e-3, 1e-9, 2e-2, 1e-5);
  expect_near(game.speed(at_wall), {-fast, 20, 0}, tolerance);
  expect_near(game.speed(beside), {fast, 0, 0}, 0);
  expect_near(game.speed(ahead), {-fast, 0, 0}, tolerance);
  EXPECT_LT(game.at(at_wall).x, -0.1 + 1e-3);
  EXPECT_NEAR(game.at(beside).x, -1 + 0.1 * fast, 0.01);
}

TYPED_TEST(CouplingOf, pinned_particles_hold_a_body_and_fixed_bodies_ignore_them) {
  using S = TypeParam;
  Coupled<S> game(0);
  const ParticleId pin = game.drop(game.grain(0.125), {0, 0, 0}, 1, {0, 0, 0}, true);
  BodyDefinition<S> d = moving<S>(add_box(game.bodies, 0.5, 0.5, 0.5), {-1, 0, 0}, {2, 0, 0});
  const BodyId body = game.bodies.create(d);
  game.bodies.create(still<S>(add_box(game.bodies, 0.5, 0.5, 0.5), {0.5, 0, 3}));
  game.drop(game.grain(0.125), {0.5, 0, 3}, 1, {0, 0, 0}, true);
  game.run(60);
  EXPECT_NEAR(game.speed(body).x, 0, 0.01);
  EXPECT_NEAR(game.at(body).x, -0.625, 0.01);
  expect_near(game.at(pin), {0, 0, 0}, 0);
  EXPECT_EQ(game.coupling.report().touches, 1u);
}

TYPED_TEST(CouplingOf, filters_and_sensors_are_heeded) {
  using S = TypeParam;
  CouplingSettings<S> how;
  how.filter = {2, 4, 0};
  Coupled<S> game(0, how);
  const ShapeId shape = add_box(game.bodies, 0.5, 0.5, 0.5);
  const ParticleMaterialId grain = game.grain(0.125);
  const Filter filters[] = {{4, 2, 0}, {4, 1, 0}, {1, 2, 0}};
  std::vector<ParticleId> shots;
  for (int i = 0; i < 5; ++i) {
    BodyDefinition<S> d = still<S>(shape, {0, 2.0 * i, 0});
    d.filter = filters[i < 3 ? i : 0];
    d.sensor = i == 3;
    d.collide = i != 4;
    game.bodies.create(d);
    shots.push_back(game.drop(grain, {-1, 2.0 * i, 0}, 1, {4, 0, 0}));
  }
  game.run(60);
  EXPECT_NEAR(game.at(shots[0]).x, -0.625, 0.01);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(game.at(shots[i]).x, 3, 0.01) << i;
}

// ---- sleep

TYPED_TEST(CouplingOf, a_sleeper_wakes_when_it_is_hit_and_not_before) {
  using S = TypeParam;
  Coupled<S> game;
  add_ground(game.bodies);
  const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0.5, 0}, 1);
  ASSERT_TRUE(settle(game.bodies));
  const ParticleId p = game.drop(game.grain(0.125), {0, 3, 0}, 0.5);
  while (game.at(p).y > 1.2) {
    ASSERT_FALSE(game.bodies.is_awake(body));
    game.step();
  }
  game.run(3);
  EXPECT_TRUE(game.bodies.is_awake(body));
}

TYPED_TEST(CouplingOf, a_crate_sleeps_under_grains_where_small_pushes_are_unfelt_and_else_never) {
  using S = TypeParam;
  for (const bool unfelt : {false, true}) {
    CouplingSettings<S> how;
    how.unfelt = unfelt ? num<S>(0.25) : S(0);
    Coupled<S> game(-10, how);
    add_ground(game.bodies);
    const D3 half = {0.5, 0.5, 0.5};
    const BodyId crate = game.box(half, {0, 0.5, 0}, 4);
    const ParticleMaterialId grain = game.grain(0.05, 0.6);
    for (int i = 0; i < 9; ++i) game.drop(grain, {0.3 * (i % 3) - 0.3, 1.5, 0.3 * (i / 3) - 0.3}, 0.0625);
    game.run(180);
    EXPECT_EQ(game.bodies.is_awake(crate), !unfelt);
    EXPECT_EQ(game.coupling.report().unfelt, unfelt ? 1u : 0u);
    EXPECT_LT(game.deepest_in(crate, half, 0.05), 0.005);
    EXPECT_LT(game.fastest_particle(), 0.02);
    game.drop(grain, {0, 1.2, 0.1}, 1, {0, -5, 0});
    game.run(6);
    EXPECT_TRUE(game.bodies.is_awake(crate));
  }
}

}  // namespace particle_coupling_test
}  // namespace isostep::test
