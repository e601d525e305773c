// Events of a step of particles: expiry, yielding springs, contacts that begin, impulses on what was touched; and how
// pinned particles behave.
// SPDX-License-Identifier: MIT
#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {
namespace particle_events_test {

template <class S> class ParticleHappenings : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleHappenings, AllScalars);

template <class S> std::vector<ParticleContactBegin<S>> told_in(ParticleWorld<S>& w, int steps) {
  std::vector<ParticleContactBegin<S>> told;
  for (int i = 0; i < steps; ++i) {
    w.step();
    told.insert(told.end(), w.events().contact_begin.begin(), w.events().contact_begin.end());
  }
  return told;
}

TYPED_TEST(ParticleHappenings, a_particle_lives_for_exactly_its_lifetime_and_is_told_as_it_was) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  const ParticleMaterialId spark = w.add(ParticleMaterial<S>{});
  w.step();
  ParticleDefinition<S> d = particle_at<S>({1, 2, 3}, {0, 60, 0});
  d.material = spark;
  d.lifetime = 3;
  const ParticleId third = w.create(d);
  d.lifetime = 1;
  const ParticleId first = w.create(d);
  d.lifetime = 0;
  const ParticleId eternal = w.create(d);
  w.step();
  ASSERT_EQ(w.events().expired.size(), 1u);
  EXPECT_EQ(w.events().expired[0].particle, first);
  EXPECT_FALSE(w.contains(first));
  w.step();
  EXPECT_TRUE(w.events().expired.empty());
  EXPECT_TRUE(w.contains(third));
  w.step();
  ASSERT_EQ(w.events().expired.size(), 1u);
  const ParticleExpired<S>& gone = w.events().expired[0];
  EXPECT_EQ(gone.particle, third);
  EXPECT_EQ(gone.material, spark);
  EXPECT_NEAR(to_double(gone.position.y), 5, 1e-3) << "three steps of a metre";
  EXPECT_EQ(gone.velocity, vec<S>(0, 60, 0));
  EXPECT_FALSE(w.contains(third));
  EXPECT_TRUE(w.contains(eternal));
  EXPECT_EQ(broken_rule(w), "");
}

TYPED_TEST(ParticleHappenings, those_that_expire_together_are_told_by_slot_and_take_their_springs) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  std::vector<ParticleId> ids;
  for (int i = 0; i < 5; ++i) {
    ParticleDefinition<S> d = particle_at<S>({1.0 * i, 0, 0});
    d.lifetime = i == 2 ? 9 : 2;
    ids.push_back(w.create(d));
  }
  // Two slots that were free before are taken in the other order.
  w.destroy(ids[0]);
  w.destroy(ids[3]);
  ParticleDefinition<S> d = particle_at<S>({0, 5, 0});
  d.lifetime = 2;
  for (const int i : {3, 0}) EXPECT_EQ((ids[i] = w.create(d)).slot, static_cast<std::uint32_t>(i));
  const SpringId spring = w.add(spring_of<S>(ids[2], ids[4], 1));
  w.step();
  w.step();
  ASSERT_EQ(w.events().expired.size(), 4u);
  const std::size_t order[] = {0, 1, 3, 4};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(w.events().expired[i].particle, ids[order[i]]);
  EXPECT_EQ(w.find(spring), nullptr);
  EXPECT_EQ(w.counts().particles, 1u);
  EXPECT_EQ(broken_rule(w), "");
}

TYPED_TEST(ParticleHappenings, a_spring_beyond_its_elastic_limit_stays_as_long_as_it_was_drawn_and_is_told_once) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  const ParticleId a = w.create(pinned_at<S>({0, 0, 0})), b = w.create(pinned_at<S>({1, 0, 0}));
  Spring<S> s = spring_of<S>(a, b, 10, 1);
  s.elastic_limit = num<S>(0.5);
  const SpringId yields = w.add(s);
  s.elastic_limit = S(0);
  const SpringId never = w.add(s);
  s.elastic_limit = S(8);
  const SpringId strong = w.add(s);
  w.place(b, vec<S>(1.5, 0, 0), vec<S>(0, 0, 0));
  w.step();
  EXPECT_TRUE(w.events().yielded.empty()) << "the limit itself is elastic";
  w.place(b, vec<S>(4, 0, 0), vec<S>(0, 0, 0));
  w.step();
  ASSERT_EQ(w.events().yielded.size(), 1u);
  EXPECT_EQ(w.events().yielded[0], yields);
  EXPECT_NEAR(to_double(w.find(yields)->rest_length), 3.5, 1e-4);
  EXPECT_EQ(w.find(never)->rest_length, S(1));
  EXPECT_EQ(w.find(strong)->rest_length, S(1));
  w.step();
  EXPECT_TRUE(w.events().yielded.empty());
  // Pressed together it yields the other way.
  w.place(b, vec<S>(1, 0, 0), vec<S>(0, 0, 0));
  w.step();
  ASSERT_EQ(w.events().yielded.size(), 1u);
  EXPECT_NEAR(to_double(w.find(yields)->rest_length), 1.5, 1e-4);
}

TYPED_TEST(ParticleHappenings, a_slack_bungee_does_not_yield) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  const ParticleId a = w.create(pinned_at<S>({0, 0, 0}));
  Spring<S> s = spring_of<S>(a, {}, 10, 4);
  s.type = SpringType::bungee;
  s.elastic_limit = num<S>(0.5);
  s.anchor = vec<S>(1, 0, 0);
  const SpringId id = w.add(s);
  w.step();
  EXPECT_TRUE(w.events().yielded.empty());
  EXPECT_EQ(w.find(id)->rest_length, S(4));
}

TYPED_TEST(ParticleHappenings, a_spring_drawn_across_the_world_yields_to_a_length_that_its_world_can_hold) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  const S edge = ParticleLimits<S>::position();
  ParticleDefinition<S> corner = pinned_at<S>({0, 0, 0});
  corner.position = {edge, edge, edge};
  const ParticleId a = w.create(corner);
  corner.position = {-edge, -edge, -edge};
  Spring<S> s = spring_of<S>(a, w.create(corner), 1);
  s.elastic_limit = S(1);
  const SpringId id = w.add(s);
  w.step();
  EXPECT_EQ(w.events().yielded.size(), 1u);
  EXPECT_EQ(w.find(id)->rest_length, edge);
  EXPECT_EQ(broken_rule(w), "");
  w.step();
  EXPECT_TRUE(w.events().yielded.empty());
}

TYPED_TEST(ParticleHappenings, a_contact_is_told_when_it_begins_and_not_again_while_it_lasts) {
  using S = TypeParam;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    ParticleSettings<S> settings = particle_settings<S>();
    settings.solver = solver;
    ParticleWorld<S> w(settings);
    w.set(w.default_material(), ball_material<S>(0.25));
    const ColliderId ground = add_plane(w);
    const ParticleId low = w.create(particle_at<S>({0, 0.75, 0})), high = w.create(particle_at<S>({2, 3.5, 0}));
    const std::vector<ParticleContactBegin<S>> told = told_in(w, 120);
    ASSERT_EQ(told.size(), 2u) << static_cast<unsigned>(solver);
    EXPECT_EQ(told[0].a, low);
    EXPECT_FALSE(told[0].b);
    EXPECT_EQ(told[0].collider, ground);
    EXPECT_NEAR(to_double(told[0].speed), std::sqrt(2 * 10 * 0.5), 0.3);
    EXPECT_EQ(told[1].a, high);
    EXPECT_NEAR(to_double(told[1].speed), std::sqrt(2 * 10 * 3.25), 0.3);
    // Parted and met again: told again.
    w.place(high, vec<S>(2, 1, 0), vec<S>(0, 0, 0));
    EXPECT_EQ(told_in(w, 90).size(), 1u);
  }
}

TYPED_TEST(ParticleHappenings, a_contact_of_two_particles_is_told_with_both_and_with_the_speed_at_which_they_closed) {
  using S = TypeParam;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    ParticleSettings<S> settings = particle_settings<S>(0);
    settings.solver = solver;
    ParticleWorld<S> w(settings);
    w.set(w.default_material(), ball_material<S>(0.25, 0.5));
    const ParticleId a = w.create(particle_at<S>({0, 0, 0}, {3, 0, 0})),
                     b = w.create(particle_at<S>({1, 0, 0}, {-2, 0, 0}));
    const std::vector<ParticleContactBegin<S>> told = told_in(w, 60);
    ASSERT_EQ(told.size(), 1u) << static_cast<unsigned>(solver);
    EXPECT_EQ(told[0].a, a);
    EXPECT_EQ(told[0].b, b);
    EXPECT_FALSE(told[0].collider);
    EXPECT_NEAR(to_double(told[0].speed), 5, 1e-3);
    EXPECT_EQ(w.counts().contacts, 0u) << "they bounced";
  }
}

TYPED_TEST(ParticleHappenings, what_is_touched_gets_what_the_particle_loses) {
  using S = TypeParam;
  for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
    ParticleSettings<S> settings = particle_settings<S>(0);
    settings.solver = solver;
    ParticleWorld<S> w(settings);
    const ParticleId fast = w.create(particle_at<S>({0, 0, 0}, {3, -4, 0}, 2));
    const ParticleId free = w.create(particle_at<S>({5, 0, 0}, {0, 4, 0}, 2));
    ParticleTouch<S> touch = {};
    touch.particle = fast;
    touch.normal.y = Unit<S>(-1);
    touch.inverse_mass = num<InverseMass<S>>(0.25);  // 4 kg that give way
    touch.friction = num<S>(0.5);
    touch.restitution = num<S>(0.5);
    ASSERT_TRUE(w.touch(touch));
    touch.particle = free;
    ASSERT_TRUE(w.touch(touch));
    w.step();
    ASSERT_EQ(w.events().touch_impulses.size(), 2u) << "one a touch";
    const D3 given = real(w.events().touch_impulses[0]), lost = real(w.velocity(fast));
    // Restitution 1/2 of 4 m/s against 2 and 4 kg: 6 m/s of relative velocity, 2/3 of it the particle's.
    const double slack = 64 * speed_grain<S>(8);
    EXPECT_NEAR(given.y, -8, 4 * slack);
    EXPECT_NEAR(lost.y, 0, slack);
    EXPECT_NEAR(given.x, 2 * (3 - lost.x), 4 * slack) << "momentum along the surface";
    EXPECT_GT(given.x, 0.5);
    EXPECT_EQ(real(w.events().touch_impulses[1]), (D3{0, 0, 0})) << "it goes away";
    EXPECT_TRUE(w.state().touches.empty()) << "a touch is of one step";
    w.step();
    EXPECT_TRUE(w.events().touch_impulses.empty());
  }
}

TYPED_TEST(ParticleHappenings, a_pinned_particle_goes_its_way_whatever_acts_on_it) {
  using S = TypeParam;
  for (std::uint32_t integrator = 0; integrator < kIntegrators; ++integrator) {
    for (const ParticleSolver solver : {ParticleSolver::soft_step, ParticleSolver::worst_first}) {
      ParticleSettings<S> settings = particle_settings<S>();
      settings.integrator = static_cast<Integrator>(integrator);
      settings.solver = solver;
      ParticleWorld<S> w(settings);
      ParticleMaterial<S> m = ball_material<S>(0.5, 0, 0.5);
      m.damping = num<S>(0.5);
      m.linear_drag = S(1);
      w.set(w.default_material(), m);
      add_plane(w);
      const ParticleId pinned = w.create(particle_at<S>({0, 0.25, 0}, {1, 0, 0}));
      const ParticleId loose = w.create(particle_at<S>({0, 1, 0}));
      w.add(spring_of<S>(pinned, loose, 100, 3));
      w.add(link_of<S>(LinkType::rod, loose, pinned, 2));
      w.add(link_of<S>(LinkType::cable, pinned, {}, 0.125));
      w.add(force_of<S>(ForceType::drag, pinned));
      w.add(Cohesion<S>{w.default_material(), S(2), S(9), S(2), S(4), S(9)});
      ASSERT_TRUE(w.apply_force(pinned, vec<S>(0, 500, 0)));
      ASSERT_TRUE(w.set_mass(pinned, S(1), true)) << "with a force on it";
      ParticleTouch<S> touch = {};
      touch.particle = pinned;
      touch.normal.x = Unit<S>(1);
      touch.separation = S(-1);
      ASSERT_TRUE(w.touch(touch));
      for (int i = 0; i < 60; ++i) w.step();
      EXPECT_EQ(w.velocity(pinned), vec<S>(1, 0, 0)) << kIntegratorNames[integrator];
      expect_near(real(w.position(pinned)), {1, 0.25, 0}, 512 * grain<S>(2), kIntegratorNames[integrator]);
      EXPECT_GT(length(real(w.position(loose)) - D3{0, 1, 0}), 0.25) << "nothing happened";
    }
  }
}

TYPED_TEST(ParticleHappenings, what_held_pinned_particles_together_does_not_fling_them_when_they_are_let_go) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>(0));
  w.set(w.default_material(), ball_material<S>(0.5));
  const ParticleId a = w.create(pinned_at<S>({0, 0, 0})), b = w.create(pinned_at<S>({0.75, 0, 0}));
  const LinkId cable = w.add(link_of<S>(LinkType::cable, a, b, 0.5));
  std::size_t told = 0;
  for (int i = 0; i < 100; ++i) {
    w.step();
    told += w.events().contact_begin.size();
  }
  EXPECT_EQ(told, 0u) << "pinned particles press on nobody";
  w.remove(cable);
  w.set_mass(a, S(1));
  w.set_mass(b, S(1));
  w.step();
  // At most the speed with which overlaps are pushed apart.
  EXPECT_LT(std::fabs(to_double(w.velocity(a).x)), 4.5);
}

TYPED_TEST(ParticleHappenings, a_link_set_anew_forgets_what_it_bore) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>());
  const ParticleId low = w.create(particle_at<S>({0, -1, 0})), other = w.create(particle_at<S>({5, 0, 0}));
  const LinkId id = w.add(link_of<S>(LinkType::rod, low, {}, 1));
  for (int i = 0; i < 30; ++i) w.step();
  ASSERT_FALSE(w.state().link_impulses[id.slot] == Velocity<S>(0));
  Link<S> same = *w.find(id);
  same.length = num<S>(1.5);
  ASSERT_TRUE(w.set(id, same));
  EXPECT_FALSE(w.state().link_impulses[id.slot] == Velocity<S>(0)) << "a cable that is reeled in keeps its tension";
  same.a = other;
  ASSERT_TRUE(w.set(id, same));
  EXPECT_EQ(w.state().link_impulses[id.slot], Velocity<S>(0));
}

}  // namespace particle_events_test
}  // namespace isostep::test
