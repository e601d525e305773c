// Gains of energy by methods that are stable alone: springs beside rods, stiff springs in planes, bounces under a
// spring's load, overlap at rest.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace particle_gains_test {

template <class S> class ParticleGains : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleGains, AllScalars);

constexpr Integrator kSecondStage[] = {Integrator::velocity_verlet, Integrator::rk4};
constexpr Integrator kBounded[] = {Integrator::semi_implicit_euler, Integrator::velocity_verlet, Integrator::rk4,
                                   Integrator::implicit_euler};

/// The book's ways and the default.
struct Way {
  ParticleSolver solver;
  Stepping stepping;
  const char* name;
};
constexpr Way kWays[] = {{ParticleSolver::soft_step, Stepping::fixed, "soft_step"},
                         {ParticleSolver::worst_first, Stepping::fixed, "worst_first"},
                         {ParticleSolver::worst_first, Stepping::time_division, "time_division"}};

template <class S>
ParticleSettings<S> settings_of(Way way, Integrator integrator, double gravity, int hz, int substeps) {
  ParticleSettings<S> s = at_rate<S>(gravity, hz, substeps);
  s.solver = way.solver;
  s.stepping = way.stepping;
  s.integrator = integrator;
  return s;
}

// Three particles side by side, the first two on a spring, the last two on a rod: k h^2 / m of 0.05 and 0.3 grew
// four-hundredfold and by 10^12 in a minute.
TYPED_TEST(ParticleGains, a_spring_beside_a_rod_keeps_its_energy_where_integrators_have_stages) {
  using S = TypeParam;
  for (const Way way : kWays) {
    for (const Integrator integrator : kSecondStage) {
      for (const double k : {2880.0, 17280.0}) {
        // What a rod does between positions and velocities is no stage of rk4: slow growth, which the page tells.
        if (integrator == Integrator::rk4 && way.solver == ParticleSolver::worst_first && k > 3000) continue;
        ParticleWorld<S> w(settings_of<S>(way, integrator, 0, 60, 4));
        const ParticleId ids[] = {w.create(point<S>({0, 0, 0}, {0, 1, 0})), w.create(point<S>({1, 0, 0}, {0, -1, 0})),
                                  w.create(point<S>({2, 0, 0}))};
        Spring<S> spring;
        spring.a = ids[0];
        spring.b = ids[1];
        spring.stiffness = num<S>(k);
        spring.rest_length = S(1);
        ASSERT_TRUE(w.add(spring));
        Link<S> rod;
        rod.type = LinkType::rod;
        rod.a = ids[1];
        rod.b = ids[2];
        ASSERT_TRUE(w.add(rod));
        double most = 0;
        for (int i = 0; i < 3600; ++i) {
          w.step();
          double energy = 0;
          for (const ParticleId id : ids) energy += dot(real(w.velocity(id)), real(w.velocity(id))) / 2;
          const double longer = length(real(w.position(ids[0])) - real(w.position(ids[1]))) - 1;
          most = std::max(most, energy + k * longer * longer / 2);
        }
        EXPECT_LT(most, 1.25) << "of 1 J: " << way.name << " " << kIntegratorNames[static_cast<int>(integrator)] << k;
        EXPECT_NEAR(length(real(w.position(ids[1])) - real(w.position(ids[2]))), 1, 0.01) << "the rod holds";
      }
    }
  }
}

// An anchor under the plane, at coarse steps: 27 km below it.
TYPED_TEST(ParticleGains, a_stiff_spring_presses_into_a_plane_at_any_stiffness_and_stays_there) {
  using S = TypeParam;
  for (const Way way : kWays) {
    for (const Integrator integrator : kBounded) {
      for (const int hz : {20, 30, 60}) {
        for (const double k : {50.0, 500.0, 5000.0, 20000.0}) {
          for (const double above : {0.0, 0.75}) {
            ParticleWorld<S> w(settings_of<S>(way, integrator, 0, hz, 1));
            w.add(plane<S>({0, 1, 0}, 0));
            Spring<S> spring;
            spring.type = SpringType::stiff;
            spring.a = w.create(point<S>({0.25, above, 0}, {0, 0, 0}, 1));
            spring.anchor = vec<S>(0, -0.5, 0);
            spring.stiffness = num<S>(k);
            ASSERT_TRUE(w.add(spring));
            const auto energy = [&] {
              const D3 v = real(w.velocity(spring.a)), d = real(w.position(spring.a)) - D3{0, -0.5, 0};
              return (dot(v, v) + k * dot(d, d)) / 2;
            };
            const double start = energy();
            double most = start;
            for (int i = 0; i < 10 * hz; ++i) {
              w.step();
              most = std::max(most, energy());
            }
            const std::string name = std::string(way.name) + " " + kIntegratorNames[static_cast<int>(integrator)] +
                                     " " + std::to_string(hz) + " Hz " + std::to_string(k);
            EXPECT_LT(most, 1.02 * start) << name;
            // The default solver's contacts give way by 1.6 h^2 of the acceleration that they hold back.
            const double depth = way.solver == ParticleSolver::soft_step ? 1.7 * k * 0.5 / (hz * hz) : 0;
            const double y = to_double(w.position(spring.a).y);
            EXPECT_GT(y, -std::min(depth, 0.5) - 0.01) << name;
            EXPECT_LT(y, 0.05) << name;
          }
        }
      }
    }
  }
}

// A ball that bounces without loss while a spring presses it into the plane had up to ten thousand times its energy
// after a minute.
TYPED_TEST(ParticleGains, a_spring_that_presses_makes_no_bounce_higher) {
  using S = TypeParam;
  for (const Way way : kWays) {
    for (const Integrator integrator : kBounded) {
      for (const SpringType type : {SpringType::spring, SpringType::stiff}) {
        for (int i = 0; i < 6; i += 2) {
          const double k = 200.0 + 700 * i, from = 0.15 * i, under = i % 4 == 0 ? 0.4 : 0.1;
          ParticleWorld<S> w(settings_of<S>(way, integrator, 0, 60, 4));
          w.add(plane<S>({0, 1, 0}, 0));
          Spring<S> spring;
          spring.type = type;
          spring.a = w.create(point<S>({0, 0.1 + from, 0}, {0, 0, 0}, 1, w.add(grain_of<S>(0.1, 1, 0, true))));
          spring.anchor = vec<S>(0, -under, 0);
          spring.stiffness = num<S>(k);
          ASSERT_TRUE(w.add(spring));
          const auto energy = [&] {
            const double v = to_double(w.velocity(spring.a).y), d = to_double(w.position(spring.a).y) + under;
            return (v * v + k * d * d) / 2;
          };
          const double start = energy();
          double most = start;
          for (int step = 0, steps = sampled(3600, 900); step < steps; ++step) {
            w.step();
            most = std::max(most, energy());
          }
          // A method of first order swings within 1 / (1 - sqrt(k) h / 2).
          EXPECT_LT(most, 1.2 * start + 0.01)
              << way.name << " " << kIntegratorNames[static_cast<int>(integrator)] << " " << i;
        }
      }
    }
  }
}

// A hundred particles in one place, or nearly: what parts them is no motion, however many sub-steps there are.
TYPED_TEST(ParticleGains, overlap_at_rest_becomes_no_motion) {
  using S = TypeParam;
  for (const Way way : kWays) {
    if (way.stepping == Stepping::time_division) continue;  // a fixed sub-step is as good: nothing moves
    for (const int substeps : {1, 4, 16}) {
      for (const double apart : {0.0, 0.1}) {
        if (!wants_whole() && (substeps == 4) == (apart == 0.0)) continue;
        ParticleWorld<S> w(settings_of<S>(way, Integrator::semi_implicit_euler, 0, 60, substeps));
        const ParticleMaterialId ball = w.add(grain_of<S>(0.1, 0, 0, true));
        for (int i = 0; i < 100; ++i)
          w.create(point<S>({apart * (i * 37 % 100) / 100, apart * (i * 53 % 100) / 100, apart * i / 100}, {0, 0, 0}, 1,
                            ball));
        double fastest = 0;
        for (int i = 0; i < 60; ++i) {
          w.step();
          for (const ParticleId id : w.particles()) fastest = std::max(fastest, length(real(w.velocity(id))));
        }
        EXPECT_LT(fastest, 0.05) << way.name << " " << substeps << " sub-steps, within " << apart;
        double widest = 0;
        for (const ParticleId id : w.particles())
          widest = std::max(widest, length(real(w.position(id)) - real(w.position(w.particles()[0]))));
        EXPECT_GT(widest, 0.3) << "they part: " << way.name << substeps;
      }
    }
  }
}

// Between two ends in one place a rod had no direction to push in.
TYPED_TEST(ParticleGains, a_rod_between_two_particles_in_one_place_opens) {
  using S = TypeParam;
  for (const Way way : kWays) {
    ParticleWorld<S> w(settings_of<S>(way, Integrator::semi_implicit_euler, 0, 60, 4));
    Link<S> rod;
    rod.type = LinkType::rod;
    rod.a = w.create(point<S>({1, 2, 3}));
    rod.b = w.create(point<S>({1, 2, 3}));
    ASSERT_TRUE(w.add(rod));
    for (int i = 0; i < 120; ++i) w.step();
    EXPECT_NEAR(length(real(w.position(rod.a)) - real(w.position(rod.b))), 1, 0.01) << way.name;
    EXPECT_LT(length(real(w.velocity(rod.b))), 0.05) << way.name;
    EXPECT_NEAR(to_double(w.position(rod.a).y + w.position(rod.b).y), 4, 0.01) << "each its half: " << way.name;
  }
}

// A crowd beyond what a step may look at: it is told, it is the same again, and nobody falls through the floor.
TYPED_TEST(ParticleGains, a_crowd_beyond_the_steps_looks_is_told_and_loses_no_floor) {
  using S = TypeParam;
  for (const Way way : kWays) {
    if (way.solver == ParticleSolver::soft_step) continue;
    std::uint64_t hashes[2];
    for (std::uint64_t& hash : hashes) {
      ParticleSettings<S> settings = settings_of<S>(way, Integrator::semi_implicit_euler, -10, 60, 2);
      settings.looks = 5000;
      ParticleWorld<S> w(settings);
      const ParticleMaterialId ball = w.add(grain_of<S>(0.1, 0, 0.5, true));
      w.add(plane<S>({0, 1, 0}, 0));
      for (int i = 0; i < 60; ++i) w.create(point<S>({0, 0.125, 0}, {0, -3, 0}, 1, ball));
      std::uint32_t spent = 0;
      for (int i = 0; i < 120; ++i) {
        spent += w.step().spent;
      }
      EXPECT_GT(spent, 0u) << way.name;
      for (const ParticleId id : w.particles()) EXPECT_GT(to_double(w.position(id).y), 0.05) << way.name;
      hash = w.hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
  }
}

// A crowd beyond the pairs that settings allow.
TYPED_TEST(ParticleGains, pairs_beyond_the_settings_are_passed_over_and_told) {
  using S = TypeParam;
  ParticleSettings<S> settings = at_rate<S>(-10, 60, 2);
  settings.pairs = 100;
  ParticleWorld<S> w(settings);
  const ParticleMaterialId ball = w.add(grain_of<S>(0.1, 0, 0.5, true));
  w.add(plane<S>({0, 1, 0}, 0));
  for (int i = 0; i < 40; ++i) w.create(point<S>({0, 0.2, 0}, {0, -3, 0}, 1, ball));
  EXPECT_EQ(w.step().lost_pairs, 1u);
  for (int i = 0; i < 30; ++i) w.step();
  for (const ParticleId id : w.particles()) EXPECT_GT(to_double(w.position(id).y), 0.05);
  settings.pairs = kMostParticlePairs + 1;
  EXPECT_EQ(ParticleWorld<S>(settings).fault(), Fault::out_of_range);
}

}  // namespace particle_gains_test
}  // namespace isostep::test
