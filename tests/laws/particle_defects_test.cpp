// One test for each defect of the book's own source (Cyclone) that concerns particles: it does not happen here.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace particle_defects_test {

template <class S> class ParticleDefects : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleDefects, AllScalars);

constexpr ParticleSolver kSolvers[] = {ParticleSolver::soft_step, ParticleSolver::worst_first};
const char* name_of(ParticleSolver solver) { return kParticleSolverNames[static_cast<int>(solver)]; }
constexpr Integrator kAll[] = {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
                               Integrator::rk4, Integrator::implicit_euler};
const char* name_of(Integrator integrator) { return kIntegratorNames[static_cast<int>(integrator)]; }

/// One particle at x = `at` on a spring from the origin, weightless, after one step of h = 1/64.
template <class S> double push_of(Spring<S> spring, double at, bool anchored) {
  ParticleWorld<S> w(at_rate<S>(0));
  spring.a = w.create(point<S>({at, 0, 0}));
  if (!anchored) spring.b = w.create(point<S>({0, 0, 0}));
  EXPECT_TRUE(w.add(spring));
  EXPECT_TRUE(w.step().clean());
  const double pushed = to_double(w.velocity(spring.a).x);
  // Newton's third law for the other end; a null id answers with zero.
  EXPECT_EQ(to_double(w.velocity(spring.b).x), anchored ? 0 : -pushed);
  return pushed * 64;
}

// An immovable body still fell under `acceleration`, 5 m in a second.
TYPED_TEST(ParticleDefects, what_is_pinned_stays_where_it_is_whatever_acts_on_it) {
  using S = TypeParam;
  for (const Integrator integrator : kAll) {
    for (const ParticleSolver solver : kSolvers) {
      ParticleSettings<S> settings = at_rate<S>(-10);
      settings.integrator = integrator;
      settings.solver = solver;
      ParticleWorld<S> w(settings);
      const ParticleMaterialId ball = w.add(grain_of<S>(0.5, 0.5, 0.5, true));
      const ParticleId id = w.create(fixed_point<S>({1, 2, 3}, ball));
      ParticleForce<S> f;
      f.particle = id;
      f.acceleration = vec<S>(1, 2, 3);
      EXPECT_TRUE(w.add(f));
      Spring<S> s;
      s.a = id;
      s.stiffness = S(10);
      EXPECT_TRUE(w.add(s));
      s.type = SpringType::stiff;
      EXPECT_TRUE(w.add(s));
      Link<S> l;
      l.a = id;
      EXPECT_TRUE(w.add(l));
      w.create(point<S>({1, 3.25, 3}, {0, -4, 0}, 8, ball));  // falls on it
      std::size_t hits = 0;
      for (int i = 0; i < 64; ++i) {
        w.step();
        hits += w.events().contact_begin.size();
      }
      EXPECT_GE(hits, 1u) << name_of(solver);
      EXPECT_EQ(w.position(id), vec<S>(1, 2, 3)) << name_of(integrator) << name_of(solver);
      EXPECT_EQ(w.velocity(id), Vec3<S>::zero()) << name_of(integrator) << name_of(solver);
    }
  }
}

// hasFiniteMass said yes to infinite mass, so that forces in proportion to it were infinite or no numbers.
TYPED_TEST(ParticleDefects, an_infinite_mass_is_no_number_that_forces_could_be_multiplied_by) {
  using S = TypeParam;
  ParticleWorld<S> w(at_rate<S>(-10));
  const ParticleId id = w.create(fixed_point<S>({0, 0, 0}));
  EXPECT_EQ(w.mass(id), S(0));
  EXPECT_FALSE(w.apply_force(id, vec<S>(0, 5, 0)));
  EXPECT_EQ(w.fault(), Fault::not_dynamic);
  EXPECT_FALSE(w.apply_impulse(id, vec<S>(0, 5, 0)));
  EXPECT_EQ(w.fault(), Fault::not_dynamic);
  for (const ForceType type : {ForceType::gravity, ForceType::drag, ForceType::buoyancy}) {
    ParticleForce<S> f;
    f.type = type;
    f.particle = id;
    f.acceleration = vec<S>(0, -10, 0);
    f.linear_drag = f.quadratic_drag = f.max_depth = f.volume = f.density = S(1);
    EXPECT_TRUE(w.add(f));
  }
  // Two immovable ends with something between them share nothing, by any share.
  Link<S> l;
  l.type = LinkType::rod;
  l.a = id;
  l.b = w.create(fixed_point<S>({3, 0, 0}));
  EXPECT_TRUE(w.add(l));
  run(w, 64);
  EXPECT_EQ(w.position(id), Vec3<S>::zero());
  EXPECT_EQ(w.velocity(id), Vec3<S>::zero());
  EXPECT_EQ(w.position(l.b), vec<S>(3, 0, 0));
}

// abs() made a compressed spring attract: -20 N where there should be +20 N.
TYPED_TEST(ParticleDefects, a_compressed_spring_pushes) {
  using S = TypeParam;
  Spring<S> s;
  s.stiffness = S(10);
  s.rest_length = S(3);
  for (const bool anchored : {true, false}) {
    EXPECT_NEAR(push_of(s, 1, anchored), 20, 1e-3) << anchored;
    EXPECT_NEAR(push_of(s, 5, anchored), -20, 1e-3) << anchored;
    EXPECT_NEAR(push_of(s, -1, anchored), -20, 1e-3) << anchored;
    EXPECT_EQ(push_of(s, 3, anchored), 0) << anchored;
  }
}

// The wrong sign made a stretched bungee push: +20 N where there should be -20 N.
TYPED_TEST(ParticleDefects, a_stretched_bungee_pulls_and_a_slack_one_does_nothing) {
  using S = TypeParam;
  Spring<S> s;
  s.type = SpringType::bungee;
  s.stiffness = S(10);
  s.rest_length = S(3);
  for (const bool anchored : {true, false}) {
    EXPECT_NEAR(push_of(s, 5, anchored), -20, 1e-3) << anchored;
    EXPECT_NEAR(push_of(s, -5, anchored), 20, 1e-3) << anchored;
    EXPECT_EQ(push_of(s, 1, anchored), 0) << anchored;
    EXPECT_EQ(push_of(s, 3, anchored), 0) << anchored;
  }
}

// Partly under water the force pointed down and grew to -rho V before it jumped to +rho V; gravity was not in it.
TYPED_TEST(ParticleDefects, buoyancy_points_up_and_grows_with_depth_without_a_jump) {
  using S = TypeParam;
  constexpr double kDepth = 0.5, kDensity = 8, kVolume = 0.25;
  double before = -1;
  for (int i = 0; i <= 16; ++i) {
    const double sunk = 2 * kDepth * (i - 2) / 12;  // from above the surface's reach to below it
    ParticleWorld<S> w(at_rate<S>(-10));
    ParticleMaterial<S> floating;
    floating.gravity_scale = S(0);
    const ParticleId id = w.create(point<S>({0, 2 + kDepth - sunk, 0}, {0, 0, 0}, 1, w.add(floating)));
    ParticleForce<S> f;
    f.type = ForceType::buoyancy;
    f.particle = id;
    f.max_depth = num<S>(kDepth);
    f.surface_height = S(2);
    f.density = num<S>(kDensity);
    f.volume = num<S>(kVolume);
    ASSERT_TRUE(w.add(f));
    run(w, 1);
    const double share = std::clamp(sunk / (2 * kDepth), 0.0, 1.0), up = to_double(w.velocity(id).y) * 64;
    EXPECT_NEAR(up, share * kDensity * kVolume * 10, 2e-3) << i;
    EXPECT_GE(up, before) << i;
    before = up;
  }
}

// Two seconds at 60 Hz: 2.3 x0 off for k = 100 without damping, 135 x0 for k = 1000, 0.45 x0 for k = 1000 at half of
// critical damping; and velocities were means of the step.
TYPED_TEST(ParticleDefects, a_stiff_spring_is_exact_at_any_stiffness) {
  using S = TypeParam;
  struct Case {
    double stiffness, part;  // of critical damping
  };
  for (const Case c : {Case{100, 0}, Case{1000, 0}, Case{1000, 0.5}, Case{30000, 0}, Case{30000, 0.5}}) {
    ParticleWorld<S> w(at_rate<S>(0, 60));
    Spring<S> s;
    s.type = SpringType::stiff;
    s.a = w.create(point<S>({1, 0, 0}));
    s.stiffness = num<S>(c.stiffness);
    s.damping = num<S>(2 * c.part * std::sqrt(c.stiffness));
    ASSERT_TRUE(w.add(s));
    const double b = held<S>(2 * c.part * std::sqrt(c.stiffness)) / 2, rate = std::sqrt(c.stiffness - b * b);
    for (int i = 1; i <= 120; ++i) {
      run(w, 1);
      const double t = i / 60.0, fall = std::exp(-b * t);
      const double x = fall * (std::cos(rate * t) + b / rate * std::sin(rate * t));
      const double v = -fall * c.stiffness / rate * std::sin(rate * t), bound = pick<S>(5e-5, 1e-12, 1e-3, 1e-7);
      ASSERT_NEAR(to_double(w.position(s.a).x), x, bound) << c.stiffness << " step " << i;
      ASSERT_NEAR(to_double(w.velocity(s.a).x), v, bound * std::sqrt(c.stiffness)) << c.stiffness << " step " << i;
    }
  }
}

// Position before velocity: an undamped oscillator of k = 100 at 60 Hz multiplies its energy by 1 + k h^2 every step,
// 1.4e7 in ten seconds. It is here as explicit_euler, by name, and no default.
TYPED_TEST(ParticleDefects, explicit_euler_explodes_by_its_law_and_the_default_does_not) {
  using S = TypeParam;
  const auto energy_after = [](ParticleSettings<S> settings, int seconds) {
    settings.gravity = vec<S>(0, 0, 0);
    ParticleWorld<S> w(settings);
    Spring<S> s;
    s.a = w.create(point<S>({0.25, 0, 0}));
    s.stiffness = S(100);
    EXPECT_TRUE(w.add(s));
    run(w, settings.hz * seconds);
    const double x = to_double(w.position(s.a).x) * 4, v = to_double(w.velocity(s.a).x) * 4;
    return (v * v + 100 * x * x) / 100;
  };
  ParticleSettings<S> book = at_rate<S>(0, 60, 1);
  book.integrator = Integrator::explicit_euler;
  // In ten seconds the swing would leave the range of Q16.16.
  const int seconds = kIsFixed<S> ? 4 : 10;
  const double gain = std::pow(1 + 100.0 / 3600, 60 * seconds);
  EXPECT_NEAR(energy_after(book, seconds) / gain, 1, pick<S>(1e-4, 1e-10, 1e-2, 1e-6));
  EXPECT_GT(gain, 700);
  const ParticleSettings<S> ours;
  EXPECT_EQ(ours.integrator, Integrator::semi_implicit_euler);
  const double half = 10.0 / (ours.hz * ours.substeps) / 2;
  EXPECT_NEAR(energy_after(ours, 10), 1, 1 / (1 - half) - 1 + pick<S>(1e-4, 1e-4, 1e-2, 1e-4));
}

// The same order threw a ball 0.083 to 0.33 m too high at 120 to 30 Hz: v h / 2. By velocity Verlet nothing is left of
// that, by the default it is v h / 2 too low, and an eighth of it at 60 Hz.
TYPED_TEST(ParticleDefects, a_toss_reaches_its_height_at_any_rate) {
  using S = TypeParam;
  const auto apex = [](Integrator integrator, int hz, int substeps) {
    ParticleSettings<S> settings = at_rate<S>(-10, hz, substeps);
    settings.integrator = integrator;
    ParticleWorld<S> w(settings);
    const ParticleId id = w.create(point<S>({0, 0, 0}, {0, 20, 0}));
    double most = 0;
    for (int i = 0; i < 3 * hz; ++i) {
      w.step();
      most = std::max(most, to_double(w.position(id).y));
    }
    return most;
  };
  const double bound = pick<S>(1e-4, 1e-10, 1e-2, 1e-6);
  for (const int hz : {30, 60, 120}) {
    EXPECT_NEAR(apex(Integrator::explicit_euler, hz, 1), 20 + 10.0 / hz, bound) << hz;
    EXPECT_NEAR(apex(Integrator::velocity_verlet, hz, 1), 20, bound) << hz;
    EXPECT_NEAR(apex(Integrator::semi_implicit_euler, hz, 4), 20 - 10.0 / (4 * hz), bound) << hz;
  }
}

// An early return left the last move standing, and neighbours were moved by it again: a penetration of 0.8 m became one
// of -0.2 m without motion.
TYPED_TEST(ParticleDefects, a_contact_that_rests_lends_its_last_move_to_no_neighbour) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    ParticleSettings<S> settings = at_rate<S>(0, 60, 4);
    settings.solver = solver;
    ParticleWorld<S> w(settings);
    const ParticleMaterialId ball = w.add(grain_of<S>(0.5, 0, 0, true));
    ASSERT_TRUE(w.add(plane<S>({0, 1, 0}, 0)));
    const ParticleId a = w.create(point<S>({0, -0.3, 0}, {0, 0, 0}, 1, ball));
    run(w, 60);  // lifted by 0.8 m
    EXPECT_NEAR(to_double(w.position(a).y), 0.5, 2e-3) << name_of(solver);
    const double resting = to_double(w.position(a).y);
    // Now the floor has nothing to do, and a neighbour comes to be 0.8 m deep in.
    const ParticleId b = w.create(point<S>({0.2, resting, 0}, {0, 0, 0}, 1, ball));
    run(w, 60);
    const D3 apart = real(w.position(b)) - real(w.position(a));
    EXPECT_NEAR(apart.x, 1, 2e-3) << name_of(solver);
    EXPECT_NEAR(apart.y, 0, 2e-3) << name_of(solver);
    EXPECT_NEAR(to_double(w.position(a).y), resting, 2e-3) << name_of(solver);
    EXPECT_NEAR(to_double(w.position(a).x + w.position(b).x), 0.2, 2e-3) << "each its half: " << name_of(solver);
    EXPECT_LT(length(real(w.velocity(b))), 1e-2) << name_of(solver);
  }
}

// The registries' remove and clear were declared and never written.
TYPED_TEST(ParticleDefects, what_was_added_can_be_removed_and_is_gone) {
  using S = TypeParam;
  ParticleWorld<S> w(at_rate<S>(0));
  const ParticleMaterialId sticky = w.add(grain_of<S>(0.5, 0, 0, true));
  const ParticleId a = w.create(point<S>({-1, 0.25, 0}, {0, 0, 0}, 1, sticky));
  const ParticleId b = w.create(point<S>({1, 0.25, 0}, {0, 0, 0}, 1, sticky));
  Spring<S> s;
  s.a = a;
  s.b = b;
  s.stiffness = S(10);
  const SpringId spring = w.add(s);
  ParticleForce<S> f;
  f.particle = a;
  f.acceleration = vec<S>(0, 0, 5);
  const ForceId force = w.add(f);
  Cohesion<S> c;
  c.material = sticky;
  c.repel_distance = S(3);
  c.repel_force = S(7);
  c.attract_start = c.attract_end = S(3);
  const CohesionId cohesion = w.add(c);
  Link<S> l;
  l.a = a;
  l.b = b;
  l.length = S(1);
  const LinkId link = w.add(l);
  const ColliderId ground = w.add(plane<S>({0, 1, 0}, 0));
  ASSERT_TRUE(spring && force && cohesion && link && ground);
  run(w, 2);
  EXPECT_NE(w.velocity(a), Vec3<S>::zero());
  EXPECT_FALSE(w.remove(sticky)) << "particles have it";
  EXPECT_TRUE(w.remove(spring) && w.remove(force) && w.remove(cohesion) && w.remove(link) && w.remove(ground));
  EXPECT_FALSE(w.remove(spring) || w.remove(force) || w.remove(cohesion) || w.remove(link) || w.remove(ground));
  EXPECT_EQ(w.fault(), Fault::stale_id);
  const ParticleCounts left = w.counts();
  EXPECT_EQ(left.springs + left.forces + left.links + left.colliders, 0u);
  ASSERT_TRUE(w.place(a, vec<S>(-1, 0.25, 0), vec<S>(0, 0, 0)));
  ASSERT_TRUE(w.place(b, vec<S>(1, 0.25, 0), vec<S>(0, 0, 0)));
  run(w, 16);
  EXPECT_EQ(w.position(a), vec<S>(-1, 0.25, 0)) << "nothing acts any more";
  EXPECT_EQ(w.position(b), vec<S>(1, 0.25, 0));
  // A slot that is taken again does not answer to the old id, and what named a particle goes with it.
  s.rest_length = S(2);
  const SpringId again = w.add(s);
  EXPECT_TRUE(again);
  EXPECT_EQ(w.find(spring), nullptr);
  ASSERT_TRUE(w.destroy(b));
  EXPECT_EQ(w.find(again), nullptr);
  EXPECT_EQ(w.counts().springs, 0u);
}

// A blob's repulsion was nothing where particles touch, and its fractions were divided as integers.
TYPED_TEST(ParticleDefects, a_blob_pushes_apart_the_harder_the_nearer) {
  using S = TypeParam;
  constexpr double kRepel = 1, kForce = 8, kStart = 1.5, kEnd = 2.5, kPull = 4;
  for (int i = 1; i <= 24; ++i) {
    const double d = i / 8.0;
    ParticleWorld<S> w(at_rate<S>(0));
    ParticleMaterial<S> m;
    const ParticleMaterialId jelly = w.add(m);
    const ParticleId a = w.create(point<S>({0, 0, 0}, {0, 0, 0}, 2, jelly));
    const ParticleId b = w.create(point<S>({0, 0, d}, {0, 0, 0}, 2, jelly));
    Cohesion<S> c;
    c.material = jelly;
    c.repel_distance = num<S>(kRepel);
    c.repel_force = num<S>(kForce);
    c.attract_start = num<S>(kStart);
    c.attract_end = num<S>(kEnd);
    c.attract_force = num<S>(kPull);
    ASSERT_TRUE(w.add(c));
    run(w, 1);
    double away = 0;
    if (d < kRepel) away = kForce * (kRepel - d) / kRepel;
    if (d > kStart && d <= kEnd) away = -kPull * (d - kStart) / (kEnd - kStart);
    EXPECT_NEAR(to_double(w.velocity(b).z) * 64 * 2, away, 5e-3) << "at " << d;
    EXPECT_NEAR(to_double(w.velocity(a).z) * 64 * 2, -away, 5e-3) << "at " << d;
  }
}

// A contact buffer of 256 lost 23 bodies of 100 through the floor.
TYPED_TEST(ParticleDefects, no_number_of_contacts_is_too_large_for_the_floor) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    ParticleSettings<S> settings = at_rate<S>(-10, 60, 2);
    settings.solver = solver;
    ParticleWorld<S> w(settings);
    const ParticleMaterialId sand = w.add(grain_of<S>(0.125, 0, 0.5, true));
    ASSERT_TRUE(w.add(plane<S>({0, 1, 0}, 0)));
    constexpr int kSide = 24;
    for (int i = 0; i < 3 * kSide * kSide; ++i) {
      const int layer = i / (kSide * kSide), row = i / kSide % kSide, column = i % kSide;
      const D3 at = {0.25 * column, 0.125 + 0.25 * layer, 0.25 * row};
      ASSERT_TRUE(w.create(point<S>(at, {0, layer == 2 ? -2.0 : 0.0, 0}, 1, sand)));
    }
    for (int i = 0; i < 20; ++i) {
      const ParticleReport report = w.step();
      EXPECT_EQ(report.lost_pairs, 0u);
      EXPECT_EQ(report.stopped, 0u);
    }
    EXPECT_GE(w.counts().contacts, static_cast<std::uint32_t>(kSide * kSide)) << name_of(solver);
    for (const ParticleId id : w.particles()) ASSERT_GT(to_double(w.position(id).y), 0.1) << name_of(solver);
  }
}

}  // namespace particle_defects_test
}  // namespace isostep::test
