// Laws of energy: what collides, swings or lies in a pile does not gain any.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace particle_energy_test {

template <class S> class ParticleEnergyLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleEnergyLaws, AllScalars);

/// Particles of which each has its mass, in a world with gravity along y.
template <class S> struct Crowd {
  ParticleWorld<S> world;
  std::vector<ParticleId> ids;
  std::vector<double> masses;
  double gravity;

  explicit Crowd(const ParticleSettings<S>& settings) : world(settings), gravity(to_double(settings.gravity.y)) {}
  ParticleId add(D3 at, D3 v, double mass, ParticleMaterialId material = {}) {
    ids.push_back(world.create(point<S>(at, v, mass, material)));
    masses.push_back(mass);
    return ids.back();
  }
  void add_box(double half, bool lid) {
    world.add(plane<S>({0, 1, 0}, 0));
    for (const double side : {-1.0, 1.0}) {
      world.add(plane<S>({side, 0, 0}, -half));
      world.add(plane<S>({0, 0, side}, -half));
    }
    if (lid) world.add(plane<S>({0, -1, 0}, -2 * half));
  }
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const D3 v = real(world.state().velocity[ids[i].slot]);
      sum += masses[i] * (dot(v, v) / 2 - gravity * to_double(world.position(ids[i]).y));
    }
    return sum;
  }
  double fastest() const {
    double most = 0;
    for (const ParticleId id : ids) most = std::max(most, length(real(world.state().velocity[id.slot])));
    return most;
  }
};

// O33. Thirty balls fall into a box: 10 minutes, two of a sample, of 16 steps of four sub-steps, h = 1/64 s. While they
// fall, overlaps of contacts that one sweep does not close are pushed out again, which lifts what lies on them; once
// they lie, nothing.
TYPED_TEST(ParticleEnergyLaws, the_energy_of_a_pile_never_rises) {
  using S = TypeParam;
  for (const double e : {0.0, 0.5}) {
    Crowd<S> c(at_rate<S>(-10, 16, 4));
    c.add_box(0.875, false);
    const ParticleMaterialId ball = c.world.add(grain_of<S>(0.25, e, 0.5, true));
    for (int i = 0; i < 30; ++i) {
      const D3 at = {0.5625 * (i % 3 - 1) + 0.005 * (i % 7), 0.5 + 0.625 * (i / 9),
                     0.5625 * (i / 3 % 3 - 1) + 0.004 * (i % 5)};
      c.add(at, {0.5 * (i % 2), 0, 0.3}, 1 + i % 3, ball);
    }
    const double start = c.energy(), in_fall = 1e-3 * start, at_rest = pick<S>(1e-4, 1e-9, 1e-2, 1e-6);
    double before = start, settled = 0;
    constexpr int kFall = 16 * 10;
    for (int i = 0, end = 16 * sampled(600, 120); i < end; ++i) {
      ASSERT_TRUE(c.world.step().clean());
      const double now = c.energy();
      ASSERT_LE(now, before + (i < kFall ? in_fall : at_rest)) << "e " << e << " step " << i;
      ASSERT_LE(now, start) << "e " << e << " step " << i;
      if (i == kFall) settled = now;
      before = now;
    }
    EXPECT_LT(before, 0.75 * start) << "they fell";
    EXPECT_LE(before, settled + 10 * at_rest) << "many small rises";
    EXPECT_LT(c.fastest(), pick<S>(1e-3, 1e-3, 2e-2, 1e-3)) << "they lie";
  }
}

// O33 at e = 1, where nothing hides a gain: balls in a closed box, without weight.
TYPED_TEST(ParticleEnergyLaws, a_gas_of_elastic_balls_does_not_heat_itself) {
  using S = TypeParam;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    for (const int count : {8, 48}) {
      ParticleSettings<S> settings = at_rate<S>(0, 60, 4);
      settings.solver = solver;
      Crowd<S> c(settings);
      c.add_box(1.5, true);
      const ParticleMaterialId ball = c.world.add(grain_of<S>(0.25, 1, 0, true));
      for (int i = 0; i < count; ++i) {
        const D3 at = {0.6 * (i % 4) - 0.9 + 0.01 * (i % 3), 0.6 * (i / 4 % 4) + 0.6, 0.6 * (i / 16) - 0.9};
        c.add(at, D3{(i * 7) % 5 - 2.0, (i * 3) % 7 - 3.0, (i * 5) % 3 - 1.0} * 2.0, 1, ball);
      }
      const double start = c.energy(), slack = pick<S>(1e-5, 1e-12, 1e-3, 1e-8) * start;
      double before = start;
      for (int i = 0; i < 600; ++i) {
        c.world.step();
        ASSERT_LE(c.energy(), before + slack) << kParticleSolverNames[static_cast<int>(solver)] << " step " << i;
        before = c.energy();
      }
      EXPECT_LE(before, start * 1.001) << kParticleSolverNames[static_cast<int>(solver)] << count;
      // One after another loses nothing; simultaneous impulses share out what meets at once.
      EXPECT_GT(before, start * (solver == ParticleSolver::worst_first ? 0.99 : 0.05)) << count;
    }
  }
}

// A glancing blow: one speed must not come back along two normals.
TYPED_TEST(ParticleEnergyLaws, two_elastic_balls_never_leave_with_more_than_they_brought) {
  using S = TypeParam;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    for (int i = 0; i < 60; ++i) {
      ParticleSettings<S> settings = at_rate<S>(0, 60, 4);
      settings.solver = solver;
      Crowd<S> c(settings);
      const ParticleMaterialId ball = c.world.add(grain_of<S>(0.25, 1, 0, true));
      const double aside = 0.5 * (i % 12) / 12.0, turn = 0.7 * i;
      const D3 v = D3{std::cos(turn), std::sin(turn), 0.3} * (2.0 + i % 5),
               off = D3{-v.y, v.x, 0} * (aside / length(v));
      c.add({0, 0, 0}, {0, 0, 0}, 1, ball);
      c.add(off - v * 0.3, v, 1 + i % 3, ball);
      const double start = c.energy();
      for (int k = 0; k < 40; ++k) ASSERT_TRUE(c.world.step().clean());
      EXPECT_LE(c.energy(), start * (1 + pick<S>(1e-5, 1e-12, 1e-3, 1e-8))) << i;
      EXPECT_GE(c.energy(), start * 0.9) << i;
      EXPECT_GT(length(real(c.world.velocity(c.ids[0]))), 0.1) << "it was hit: " << i;
    }
  }
}

// Rods turn with their ends: a chain that is let go from the horizontal falls, whips and swings. Its links are springs
// of the solver, which take up a whip's jerk and give it back, so that single steps may rise; the whole never does.
TYPED_TEST(ParticleEnergyLaws, a_falling_chain_of_rods_gains_nothing) {
  using S = TypeParam;
  for (const int substeps : {1, 4}) {
    Crowd<S> c(at_rate<S>(-10, 60, substeps));
    constexpr int kLinks = 16;
    for (int i = 0; i < kLinks; ++i) {
      Link<S> rod;
      rod.type = LinkType::rod;
      rod.a = c.add({0.25 * (i + 1), 0, 0}, {0, 0, 0}, i == kLinks - 1 ? 4 : 1);
      if (i > 0) rod.b = c.ids[static_cast<std::size_t>(i) - 1];
      rod.length = num<S>(0.25);
      ASSERT_TRUE(c.world.add(rod));
    }
    const double start = c.energy(), slack = pick<S>(1e-4, 1e-9, 1e-2, 1e-6);
    for (int i = 0; i < 60 * 20; ++i) {
      ASSERT_TRUE(c.world.step().clean());
      ASSERT_LE(c.energy(), start + slack) << "sub-steps " << substeps << " step " << i;
    }
    EXPECT_LT(c.energy(), -100) << "it fell";
    EXPECT_GT(c.energy(), -500) << "and hangs together";
  }
}

}  // namespace particle_energy_test
}  // namespace isostep::test
