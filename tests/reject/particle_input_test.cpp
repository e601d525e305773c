// Inputs to a particle world that no game should give: numbers at the end of the scalar, springs without length, forces
// that explode, a million contacts. Each ends in a fault or a report, and never in a NaN or a hang.
// SPDX-License-Identifier: MIT
#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {
namespace particle_input_test {

template <class S> class ParticleInput : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleInput, AllScalars);

template <class S> ParticleSettings<S> settings_with(Integrator integrator) {
  ParticleSettings<S> s = particle_settings<S>();
  s.integrator = integrator;
  return s;
}
constexpr Integrator kAll[] = {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
                               Integrator::rk4, Integrator::implicit_euler};

TYPED_TEST(ParticleInput, springs_without_length_push_nowhere) {
  using S = TypeParam;
  for (const Integrator integrator : kAll) {
    for (const SpringType type : {SpringType::spring, SpringType::bungee, SpringType::stiff}) {
      for (const double rest : {0.0, 1.0}) {
        if (type == SpringType::stiff && rest > 0) continue;
        ParticleWorld<S> w(settings_with<S>(integrator));
        const ParticleId a = w.create(particle_at<S>({1, 2, 3})), b = w.create(particle_at<S>({1, 2, 3}));
        const ParticleId c = w.create(particle_at<S>({4, 5, 6}));
        Spring<S> s = spring_of<S>(a, b, 100, rest);
        s.type = type;
        s.damping = S(1);
        ASSERT_TRUE(w.add(s)) << describe(w.fault());
        s.a = c;
        s.b = {};
        s.anchor = vec<S>(4, 5, 6);
        s.stiffness = S(0);
        s.damping = S(0);
        ASSERT_TRUE(w.add(s)) << describe(w.fault());
        for (int i = 0; i < 30; ++i) EXPECT_TRUE(w.step().clean());
        EXPECT_EQ(w.position(a), w.position(b));
        EXPECT_EQ(w.position(a).x, S(1));
        EXPECT_NEAR(to_double(w.position(a).y), 2 - 1.25, 0.05) << "both fall";
        EXPECT_NEAR(to_double(w.position(c).y), 5 - 1.25, 0.05);
        EXPECT_EQ(broken_rule(w), "");
      }
    }
  }
}

TYPED_TEST(ParticleInput, what_names_a_destroyed_particle_is_gone_before_the_next_step) {
  using S = TypeParam;
  for (const Integrator integrator : kAll) {
    ParticleWorld<S> w(settings_with<S>(integrator));
    std::vector<ParticleId> ids;
    for (int i = 0; i < 6; ++i) ids.push_back(w.create(particle_at<S>({1.0 * i, 0, 0})));
    for (int i = 0; i < 5; ++i) {
      w.add(spring_of<S>(ids[i], ids[i + 1], 50));
      w.add(link_of<S>(LinkType::cable, ids[i], ids[i + 1], 1.5));
    }
    w.step();
    for (const int i : {2, 0, 4}) {
      ASSERT_TRUE(w.destroy(ids[i]));
      EXPECT_TRUE(w.step().clean());
      EXPECT_EQ(broken_rule(w), "");
    }
    EXPECT_EQ(w.counts().springs, 0u);
    EXPECT_EQ(w.counts().links, 0u);
    const ParticleId born = w.create(particle_at<S>({0, 9, 0}));
    EXPECT_TRUE(w.step().clean());
    EXPECT_EQ(to_double(w.position(born).x), 0) << "the slot's past pulled at it";
  }
}

TYPED_TEST(ParticleInput, what_leaves_the_world_is_held_at_its_edge_and_reported) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  const S edge = ParticleLimits<S>::position(), speed = ParticleLimits<S>::speed();
  ParticleDefinition<S> d;
  d.position = {edge, -edge, S(0)};
  d.velocity = {speed, -speed, S(1)};
  const ParticleId id = w.create(d);
  const ParticleReport report = w.step();
  EXPECT_EQ(report.clamped_position, 1u);
  EXPECT_EQ(report.clamped_speed, 0u);
  EXPECT_EQ(w.position(id).x, edge);
  EXPECT_EQ(w.position(id).y, -edge);
  EXPECT_GT(w.position(id).z, S(0));
  EXPECT_EQ(w.velocity(id), vec<S>(0, 0, 1)) << "the other axis goes on";
  EXPECT_EQ(broken_rule(w), "");
  EXPECT_TRUE(w.step().clean());
}

TYPED_TEST(ParticleInput, what_grows_too_fast_is_cut_to_the_speed_limit_and_reported) {
  using S = TypeParam;
  for (const Integrator integrator : kAll) {
    ParticleSettings<S> s = settings_with<S>(integrator);
    s.hz = 10;
    s.gravity = vec<S>(0, 0, 0);
    ParticleWorld<S> w(s);
    const S speed = ParticleLimits<S>::speed();
    ParticleDefinition<S> d;
    d.velocity = {speed, S(0), -speed};
    const ParticleId id = w.create(d), other = w.create(d);
    ASSERT_TRUE(w.apply_force(id, {speed, S(0), -speed}));
    const ParticleReport report = w.step();
    EXPECT_EQ(report.clamped_speed, 1u) << kIntegratorNames[static_cast<int>(integrator)];
    EXPECT_EQ(w.velocity(id).x, speed);
    EXPECT_EQ(w.velocity(id).z, -speed);
    EXPECT_EQ(w.velocity(other), d.velocity);
    EXPECT_EQ(broken_rule(w), "");
  }
}

TYPED_TEST(ParticleInput, what_commands_push_too_hard_is_cut_and_reported_once) {
  using S = TypeParam;
  const S most = ParticleLimits<S>::acceleration(), speed = ParticleLimits<S>::speed();
  const Vec3<S> none = {S(0), S(0), S(0)};
  const auto cut_by = [&](const auto& push) {
    ParticleSettings<S> s = particle_settings<S>(0);
    s.hz = 1000;
    ParticleWorld<S> w(s);
    const ParticleId id = w.create(particle_at<S>({0, 0, 0}));
    push(w, id);
    const ParticleReport report = w.step();
    EXPECT_EQ(broken_rule(w), "");
    EXPECT_TRUE(w.step().clean());
    return report.clamped_force;
  };
  EXPECT_EQ(cut_by([&](auto& w, ParticleId id) { w.apply_force(id, {most, most, -most}); }), 0u);
  EXPECT_EQ(cut_by([&](auto& w, ParticleId id) {
              for (int i = 0; i < 2; ++i) w.apply_force(id, {most, S(0), S(0)});
            }),
            1u);
  EXPECT_EQ(cut_by([&](auto& w, ParticleId id) {
              w.apply_force(id, {S(0), highest<S>(), S(0)});
              w.apply_force(id, none);
            }),
            1u);
  EXPECT_EQ(cut_by([&](auto& w, ParticleId id) { w.apply_impulse(id, {speed, S(0), -speed}); }), 0u);
  EXPECT_EQ(cut_by([&](auto& w, ParticleId id) {
              w.apply_impulse(id, {speed, S(0), S(0)});
              w.apply_impulse(id, {S(1), S(0), S(0)});
            }),
            1u);
}

/// k h^2 / m of 10^4 where 4 explodes.
template <class S> std::vector<std::uint64_t> explode(ParticleReport& sum) {
  ParticleSettings<S> s = settings_with<S>(Integrator::explicit_euler);
  s.hz = 10;
  s.substeps = 1;
  ParticleWorld<S> w(s);
  std::vector<ParticleId> ids;
  for (int i = 0; i < 16; ++i) {
    const D3 at = {1.0 * (i % 4), 1.0 * (i / 4), 0.1 * (i % 3)};
    ids.push_back(w.create(particle_at<S>(at, {0, 0, 0}, 0.015625)));
  }
  for (int i = 0; i < 16; ++i) {
    for (const int next : {1, 4, 5}) {
      if (i + next >= 16) continue;
      EXPECT_TRUE(w.add(spring_of<S>(ids[i], ids[i + next], 15625))) << describe(w.fault());
    }
  }
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 600; ++i) {
    const ParticleReport report = w.step();
    sum.clamped_speed += report.clamped_speed;
    sum.clamped_position += report.clamped_position;
    sum.stopped += report.stopped;
    EXPECT_EQ(broken_rule(w), "") << "step " << i;
    hashes.push_back(w.hash());
  }
  return hashes;
}

TYPED_TEST(ParticleInput, springs_that_explode_are_cut_and_reported_and_explode_the_same_way_again) {
  ParticleReport sum, again;
  const std::vector<std::uint64_t> hashes = explode<TypeParam>(sum);
  EXPECT_GT(sum.clamped_speed, 1000u);
  EXPECT_EQ(sum.stopped, 0u) << "all of it was numbers";
  EXPECT_EQ(explode<TypeParam>(again), hashes);
  EXPECT_EQ(again.clamped_speed, sum.clamped_speed);
  EXPECT_EQ(again.clamped_position, sum.clamped_position);
}

TYPED_TEST(ParticleInput, forces_without_bound_stop_a_particle_at_worst_and_nobody_else) {
  using S = TypeParam;
  std::uint32_t mended = 0;
  for (const Integrator integrator : kAll) {
    for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
      ParticleSettings<S> s = settings_with<S>(integrator);
      s.solver = solver;
      ParticleWorld<S> w(s);
      w.set(w.default_material(), ball_material<S>(0.25, 1, 1));
      add_plane(w, -20);
      const S least = ParticleLimits<S>::least_mass(), most = highest<S>();
      ParticleDefinition<S> d;
      d.mass = least;
      const ParticleId light = w.create(d);
      d.position = vec<S>(0.375, 0, 0.25);
      d.mass = ParticleLimits<S>::mass();
      const ParticleId heavy = w.create(d);
      d = particle_at<S>({9, 0, 0});
      d.material = w.add(ParticleMaterial<S>{});
      const ParticleId far_off = w.create(d);
      // Two that pull without end in opposite directions, and one that pushes.
      for (const double x : {-3.0, 3.0, 0.125}) {
        Spring<S> spring = spring_of<S>(light, {}, 0, x > 0 ? 1 : 0);
        spring.anchor = vec<S>(x, x, 0);
        spring.stiffness = most;
        spring.damping = most;
        ASSERT_TRUE(w.add(spring));
      }
      Spring<S> between = spring_of<S>(light, heavy, 0, 0);
      between.type = SpringType::stiff;
      between.stiffness = most;
      ASSERT_TRUE(w.add(between));
      ParticleForce<S> force = force_of<S>(ForceType::buoyancy, light);
      force.volume = force.density = force.linear_drag = force.quadratic_drag = most;
      force.max_depth = resolution<S>();
      ASSERT_TRUE(w.add(force));
      force.type = ForceType::drag;
      ASSERT_TRUE(w.add(force));
      ASSERT_TRUE(w.add(Cohesion<S>{w.default_material(), S(1), most, S(1), S(1), most}));
      ASSERT_TRUE(w.add(link_of<S>(LinkType::rod, heavy, {}, 1)));
      for (int i = 0; i < 40; ++i) {
        const ParticleReport report = w.step();
        mended += report.clean() ? 0u : 1u;
        ASSERT_EQ(broken_rule(w), "") << kIntegratorNames[static_cast<int>(integrator)] << " step " << i;
      }
      EXPECT_NEAR(to_double(w.position(far_off).y), -10 * (2.0 / 3) * (2.0 / 3) / 2, 0.05);
    }
  }
  EXPECT_GT(mended, 100u);
}

/// Particles in one place: every pair of them is a contact.
template <class S> ParticleReport crowd(int count, ParticleSolver solver, std::uint64_t* hash) {
  ParticleSettings<S> s = particle_settings<S>(-10, 1);
  s.solver = solver;
  ParticleWorld<S> w(s);
  w.set(w.default_material(), ball_material<S>(0.25, 0, 0.5));
  for (int i = 0; i < count; ++i) w.create(particle_at<S>({0, 0, 0}));
  const ParticleReport report = w.step();
  EXPECT_EQ(broken_rule(w), "");
  EXPECT_EQ(w.counts().particles, static_cast<std::uint32_t>(count));
  *hash = w.hash();
  return report;
}

TEST(ParticleCrowd, a_million_contacts_are_found_and_solved) {
  std::uint64_t hash = 0;
  EXPECT_TRUE(crowd<float>(1420, ParticleSolver::soft_step, &hash).clean());
  EXPECT_TRUE(crowd<Q32_32>(1420, ParticleSolver::soft_step, &hash).clean());
}

TEST(ParticleCrowd, more_pairs_than_there_is_room_for_are_reported) {
  std::uint64_t hash = 0, again = 0;
  EXPECT_EQ(crowd<float>(2100, ParticleSolver::soft_step, &hash).lost_pairs, 1u);
  EXPECT_EQ(crowd<float>(2100, ParticleSolver::soft_step, &again).lost_pairs, 1u);
  EXPECT_EQ(hash, again) << "which pairs are lost depends on the state alone";
}

TEST(ParticleCrowd, the_worst_first_resolver_gives_up_in_time_and_says_so) {
  std::uint64_t hash = 0;
  EXPECT_GT(crowd<float>(460, ParticleSolver::worst_first, &hash).unresolved, 0u);
}

}  // namespace particle_input_test
}  // namespace isostep::test
