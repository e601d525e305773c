// The frame of a game that has both worlds: its order, its state, and that all of it is two worlds' commands.
// SPDX-License-Identifier: MIT
#include "isostep/effects/particle_coupling.hpp"
#include "isostep/particles/recorder.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/state/composite.hpp"
#include "isostep/state/verify.hpp"
#include "unit/effects/coupled.hpp"

namespace isostep::test {
namespace coupled_frames_test {

template <class S> class CoupledFrames : public ::testing::Test {};
TYPED_TEST_SUITE(CoupledFrames, AllScalars);

TYPED_TEST(CoupledFrames, worlds_of_different_rates_are_refused) {
  using S = TypeParam;
  World<S> bodies(settings<S>(-10, 60));
  ParticleWorld<S> particles(ParticleSettings<S>{.hz = 120});
  add_ground(bodies);
  ParticleMaterial<S> material;
  material.radius = num<S>(0.5);
  particles.set(particles.default_material(), material);
  particles.create({});
  ParticleCoupling<S> coupling;
  const std::uint64_t before = particles.hash();
  EXPECT_FALSE(coupling.before_step(bodies, particles));
  EXPECT_EQ(particles.hash(), before);
  particles.step();
  EXPECT_FALSE(coupling.after_step(bodies, particles));
}

TYPED_TEST(CoupledFrames, after_step_wants_exactly_one_step_since_before_step) {
  using S = TypeParam;
  Coupled<S> game;
  const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0, 0}, 1);
  game.drop(game.grain(0.5), {0, 1, 0}, 1, {0, -1, 0});
  const std::uint64_t before = game.bodies.hash();
  EXPECT_FALSE(game.coupling.after_step(game.bodies, game.particles));
  ASSERT_TRUE(game.coupling.before_step(game.bodies, game.particles));
  EXPECT_FALSE(game.coupling.after_step(game.bodies, game.particles));
  ASSERT_TRUE(game.coupling.before_step(game.bodies, game.particles));
  game.particles.step();
  game.particles.step();
  EXPECT_FALSE(game.coupling.after_step(game.bodies, game.particles));
  EXPECT_EQ(game.bodies.hash(), before);
  game.step();
  EXPECT_FALSE(game.coupling.after_step(game.bodies, game.particles));
  EXPECT_GT(game.coupling.report().touches + game.coupling.report().bodies, 0u);
  EXPECT_TRUE(game.bodies.contains(body));
}

TYPED_TEST(CoupledFrames, touches_and_bodies_of_the_games_own_stay_apart) {
  using S = TypeParam;
  Coupled<S> game(0);
  const BodyId body = game.box({0.5, 0.5, 0.5}, {0, 0, 0}, 2);
  const ParticleMaterialId grain = game.grain(0.125);
  const ParticleId own = game.drop(grain, {0, 9, 0}, 1, {0, -1, 0});
  game.drop(grain, {-0.65, 0, 0}, 2, {4, 0, 0});
  ParticleTouch<S> touch = {};
  touch.particle = own;
  touch.normal = {Unit<S>(0), Unit<S>(-1), Unit<S>(0)};
  ASSERT_TRUE(game.particles.touch(touch));
  game.step();
  EXPECT_NEAR(game.speed(own).y, 0, 1e-4);
  EXPECT_NEAR(game.speed(body).y, 0, 1e-4);
  EXPECT_NEAR(game.speed(body).x, 2, 0.01);
}

template <class S> void build_mess(Coupled<S>& game) {
  add_ground(game.bodies);
  hang_cloth(game, 9, 0.1, 1, 0.03125, 150, 1);
  for (int i = 0; i < 3; ++i) game.box({0.15, 0.15, 0.15}, {0.2 * i - 0.2, 1.5 + 0.4 * i, 0.05 * i}, 0.5);
  const ParticleMaterialId grain = game.grain(0.06, 0.4, 0.2, true);
  for (int i = 0; i < 40; ++i) game.drop(grain, {0.13 * (i % 5) - 0.3, 2 + 0.15 * (i / 5), 0.1 * (i % 3) - 0.1}, 0.05);
}

TYPED_TEST(CoupledFrames, two_runs_agree_bit_for_bit) {
  using S = TypeParam;
  Coupled<S> first, second;
  build_mess(first);
  build_mess(second);
  for (int i = 0; i < 120; ++i) {
    first.step();
    second.step();
    ASSERT_EQ(first.hash(), second.hash()) << i;
  }
}

TYPED_TEST(CoupledFrames, the_composite_of_both_worlds_is_the_whole_state) {
  using S = TypeParam;
  Coupled<S> game;
  build_mess(game);
  auto both = composite(game.bodies, game.particles);
  typename decltype(both)::Snapshot frame;
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 120; ++i) {
    if (i == 50) both.save(frame);
    game.step();
    hashes.push_back(both.hash());
  }
  Coupled<S> other;  // that never saw the first half
  auto same = composite(other.bodies, other.particles);
  same.load(frame);
  for (std::size_t i = 50; i < 120; ++i) {
    other.step();
    ASSERT_EQ(same.hash(), hashes[i]) << i;
  }
  both.load(frame);  // and the one whose caches know the future
  for (std::size_t i = 50; i < 120; ++i) {
    game.step();
    ASSERT_EQ(both.hash(), hashes[i]) << i;
  }
}

TYPED_TEST(CoupledFrames, each_worlds_recording_replays_without_the_other) {
  using S = TypeParam;
  Coupled<S> game;
  build_mess(game);
  std::vector<std::uint8_t> bodies_file, particles_file;
  WorldRecorder<S> of_bodies(game.bodies, sink_to(bodies_file));
  ParticleRecorder<S> of_particles(game.particles, sink_to(particles_file));
  ASSERT_TRUE(of_bodies.begin("coupled").ok());
  ASSERT_TRUE(of_particles.begin("coupled").ok());
  for (int i = 0; i < 90; ++i) {
    game.step();
    ASSERT_TRUE(of_bodies.end_frame().ok());
    ASSERT_TRUE(of_particles.end_frame().ok());
  }
  ASSERT_TRUE(of_bodies.finish().ok());
  ASSERT_TRUE(of_particles.finish().ok());
  const ReplayReader bodies_replay(bodies_file), particles_replay(particles_file);
  World<S> bodies;
  ParticleWorld<S> particles;
  const VerifyResult a = verify_replay(bodies_replay, bodies, SameHeader{bodies_replay.header()});
  EXPECT_EQ(a.outcome, VerifyOutcome::verified) << describe(a);
  const VerifyResult b = verify_replay(particles_replay, particles, SameHeader{particles_replay.header()});
  EXPECT_EQ(b.outcome, VerifyOutcome::verified) << describe(b);
  EXPECT_EQ(a.frames + b.frames, 180u);
  EXPECT_EQ(bodies.hash(), game.bodies.hash());
  EXPECT_EQ(particles.hash(), game.particles.hash());
}

}  // namespace coupled_frames_test
}  // namespace isostep::test
