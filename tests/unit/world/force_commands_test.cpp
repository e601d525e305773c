// The commands that push bodies: what an accepted one does, and that a refused one names its fault and changes nothing.
// SPDX-License-Identifier: MIT
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace force_commands_test {

template <class S> class ForceCommands : public CommandedWorld<S> {};
TYPED_TEST_SUITE(ForceCommands, AllScalars);

TYPED_TEST(ForceCommands, forces_and_impulses_on_what_no_force_moves_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> v = vec<S>(0, 1, 0);
  for (const BodyId id : {this->ground, this->watcher, this->kinematic}) {
    this->expect_refused(Fault::not_dynamic, [&] { return w.apply_force(id, v); });
    this->expect_refused(Fault::not_dynamic, [&] { return w.apply_impulse(id, v); });
  }
  this->expect_refused(Fault::not_dynamic, [&] { return w.set_velocity(this->ground, v, v); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.set_motion(this->ground, S(1), S(0), S(0), 0); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.wake(this->ground); });
}

TYPED_TEST(ForceCommands, an_impulse_changes_velocity_by_itself_over_mass) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 1), {0, 0, 0});
  d.mass = S(4);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_impulse(id, vec<S>(8, 0, -2)));
  EXPECT_EQ(w.velocity(id), vec<S>(2, 0, -0.5));
  EXPECT_EQ(w.angular_velocity(id), Vec3<S>::zero());
  // Off centre: w = I^-1 (r x J), I_y = m (x^2 + z^2) / 3 with half extents x = 1/2, z = 1.
  ASSERT_TRUE(w.apply_impulse_at(id, vec<S>(0, 0, 2), vec<S>(0.5, 0, 0)));
  expect_near(real(w.angular_velocity(id)), {0, -0.5 * 2 / (4 * 1.25 / 3), 0}, 32 * grain<S>());
  expect_near(real(w.velocity(id)), {2, 0, 0}, 4 * grain<S>());
}

TYPED_TEST(ForceCommands, a_force_acts_over_one_step_alone_and_forces_add_up) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 4));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(2);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_force(id, vec<S>(64, 0, 0)));
  ASSERT_TRUE(w.apply_force(id, vec<S>(64, 0, 32), vec<S>(0, 2, 0)));
  EXPECT_EQ(w.velocity(id), Vec3<S>::zero());
  w.step();
  // I = 2/5 m r^2 = 1/5.
  expect_near(real(w.velocity(id)), {1, 0, 0.25}, 8 * grain<S>());
  expect_near(real(w.angular_velocity(id)), {0, 2 / 0.2 / 64, 0}, 8 * grain<S>());
  const Vec3<S> kept = w.velocity(id);
  w.step();
  EXPECT_EQ(w.velocity(id), kept);
}

// v = f h / m, w = I^-1 (p - x) x f h.
TYPED_TEST(ForceCommands, a_force_at_a_point_pushes_and_turns) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 4));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {1, 2, 3});
  d.mass = S(2);
  d.orientation = turn<S>({0.6, 0, 0.8}, 1);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_force_at(id, vec<S>(0, 32, 0), vec<S>(1.5, 2, 3)));
  w.step();
  expect_near(real(w.velocity(id)), {0, 0.25, 0}, 8 * grain<S>());
  expect_near(real(w.angular_velocity(id)), {0, 0, 0.5 * 32 / 0.2 / 64}, 32 * grain<S>());
}

TYPED_TEST(ForceCommands, impulses_one_after_another_never_turn_a_velocity_round) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(1);
  const BodyId id = w.create(d);
  const S most = Limits<S>::speed();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(w.apply_impulse(id, {most, S(0), S(0)}));
    EXPECT_GT(to_double(w.velocity(id).x), 0) << "after impulse " << i;
  }
  w.step();
  EXPECT_GT(to_double(w.velocity(id).x), 0);
  EXPECT_LE(w.velocity(id).x, most);
}

TYPED_TEST(ForceCommands, a_force_too_large_for_the_scalar_still_pushes_its_own_way) {
  using S = TypeParam;
  for (const double force : {1000.0, 4000.0, 7000.0, 12000.0, 30000.0}) {
    World<S> w(settings<S>(0));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
    d.mass = num<S>(0.5);
    const BodyId id = w.create(d);
    ASSERT_TRUE(w.apply_force(id, vec<S>(force, 0, 0)));
    w.step();
    EXPECT_GT(to_double(w.velocity(id).x), 0) << force << " N";
    EXPECT_GT(to_double(w.center_of_mass(id).x), 0) << force << " N";
  }
}

TYPED_TEST(ForceCommands, gravity_set_anew_is_what_bodies_fall_by) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 64, 4));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  ASSERT_TRUE(w.set_gravity(vec<S>(0, 0, 16)));
  run(w, 64);
  expect_near(real(w.velocity(id)), {0, 0, 16}, 1024 * speed_grain<S>(16));
}

}  // namespace force_commands_test
}  // namespace isostep::test
