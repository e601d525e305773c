// Touches between bodies and particles: which ones the particles' step gets, and the speed with which they part.
// SPDX-License-Identifier: MIT
#include "unit/effects/coupled.hpp"

namespace isostep::test {
namespace coupling_touches_test {

template <class S> class CouplingTouches : public ::testing::Test {};
TYPED_TEST_SUITE(CouplingTouches, AllScalars);

/// What a turn rounds makes a component of a normal larger than 1 by a digit: such touches were refused.
TYPED_TEST(CouplingTouches, a_grain_rests_on_boxes_turned_by_quarters) {
  using S = TypeParam;
  for (const D3 axis : {D3{1, 0, 0}, D3{0, 1, 0}, D3{0, 0, 1}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      Coupled<S> game;
      BodyDefinition<S> d = still<S>(add_box(game.bodies, 0.5, 0.5, 0.5), {0, 0, 0});
      d.orientation = turn<S>(axis, quarters * kPi / 2);
      ASSERT_TRUE(game.bodies.create(d));
      const ParticleId grain = game.drop(game.grain(0.1), {0.01, 0.62, 0.02});
      game.run(60);
      EXPECT_NEAR(game.at(grain).y, 0.6, 0.01) << quarters << " about " << axis.x << axis.y << axis.z;
    }
  }
}

/// A ball and a particle on a stiff spring pass each other 17 mm apart: the plane at the end of the way has the start
/// behind it, which was taken for an overlap of 0.16 m.
TYPED_TEST(CouplingTouches, what_passes_a_ball_is_not_pushed_out_of_it) {
  using S = TypeParam;
  Settings<S> rigid = settings<S>(0);
  rigid.hz = 20;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    Coupled<S> game(0);
    game.bodies = World<S>(rigid);
    game.particles = ParticleWorld<S>({.hz = 20, .gravity = vec<S>(0, 0, 0), .solver = solver});
    BodyDefinition<S> d = moving<S>(add_ball(game.bodies, 0.3), {0, 0, 0}, {10, 0, 0});
    d.mass = S(0.5);
    const BodyId ball = game.bodies.create(d);
    const ParticleId grain = game.drop(game.grain(0.1), {0.28, 0.417, 0});
    for (int i = 0; i < 4; ++i) game.step();
    EXPECT_NEAR(length(game.speed(ball)), 10, 1e-3);
    EXPECT_LT(length(game.speed(grain)), 1e-3);
    EXPECT_LT(length(game.at(grain) - D3{0.28, 0.417, 0}), 1e-3);
  }
}

/// The speed at which a body leaves an overlap is none at which it came.
TYPED_TEST(CouplingTouches, a_bounce_does_not_count_the_way_out_of_an_overlap) {
  using S = TypeParam;
  for (const double bounce : {0.5, 1.0}) {
    Coupled<S> game(0);
    BodyDefinition<S> d = moving<S>(add_ball(game.bodies, 0.3), {0, 0, 0}, {1, 0, 0});
    d.mass = S(1);
    const BodyId ball = game.bodies.create(d);
    game.drop(game.grain(0.1, 0, bounce), {0.35, 0, 0}, 1, {0, 0, 0}, true);
    game.run(30);
    EXPECT_NEAR(game.speed(ball).x, -bounce, 0.01);
  }
}

}  // namespace coupling_touches_test
}  // namespace isostep::test
