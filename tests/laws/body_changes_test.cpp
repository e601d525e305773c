// Laws of bodies that become of another type or mass, are put to sleep, or told where to be.
// SPDX-License-Identifier: MIT

#include "laws/body_changes.hpp"

namespace isostep::test {
namespace body_changes_test {

TYPED_TEST_SUITE(BodyChanges, AllScalars);

// ---- type and mass

TYPED_TEST(BodyChanges, a_body_that_becomes_dynamic_is_one_that_was_made_so) {
  using S = TypeParam;
  World<S> other(settings<S>());
  const BodyMass<S> mass = {S(1), S(3), Vec3<S>::zero()};
  BodyDefinition<S> d = still<S>(add_box(this->w, 0.5, 0.25, 0.5), {0, 4, 0});
  const BodyId body = this->w.create(d);
  run(this->w, 3);
  ASSERT_TRUE(this->w.set_type(body, dynamic, mass)) << describe(this->w.fault());
  d.shape = add_box(other, 0.5, 0.25, 0.5);
  d.type = BodyType::dynamic;
  d.mass = S(3);
  const BodyId twin = other.create(d);
  for (int i = 0; i < 30; ++i) {
    this->w.step();
    other.step();
    ASSERT_EQ(this->w.pose(body).position, other.pose(twin).position);
  }
  EXPECT_EQ(this->w.mass(body), S(3));
}

TYPED_TEST(BodyChanges, a_body_that_becomes_static_bears_what_falls_on_it) {
  using S = TypeParam;
  const BodyId body = this->box({0, 2, 0}, {2, 0.25, 2});
  run(this->w, 6);
  ASSERT_TRUE(this->w.set_type(body, BodyType::static_));
  EXPECT_EQ(this->w.velocity(body), Vec3<S>::zero());
  EXPECT_EQ(this->w.mass(body), S(0));
  const double height = this->at(body).y;
  const BodyId load = this->box({0, 4, 0});
  EXPECT_TRUE(settle(this->w));
  EXPECT_EQ(this->at(body).y, height);
  EXPECT_NEAR(this->at(load).y, height + 0.75, 0.01);
  ASSERT_TRUE(this->w.set_type(body, dynamic));
  EXPECT_TRUE(this->w.is_awake(load));
  run(this->w, 30);
  EXPECT_LT(this->at(load).y, height - 0.5);
}

TYPED_TEST(BodyChanges, types_and_masses_that_cannot_be_are_refused_and_change_nothing) {
  using S = TypeParam;
  const BodyId ground = add_ground(this->w), body = this->box({0, 2, 0});
  const BodyId carried = this->mover({8, 0, 0});
  BodyDrag<S> drag;
  drag.body = body;
  ASSERT_TRUE(this->w.add(drag));
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](bool accepted, Fault fault, const char* field) {
    EXPECT_FALSE(accepted) << field;
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  refused(this->w.set_type(ground, dynamic), Fault::bad_mass, "shape");
  refused(this->w.set_type(body, static_cast<BodyType>(3)), Fault::bad_argument, "type");
  refused(this->w.set_type(body, kinematic), Fault::bad_argument, "type");  // it has drag
  refused(this->w.set_mass(body, {S(1), S(-1), Vec3<S>::zero()}), Fault::bad_mass, "mass");
  refused(this->w.set_mass(body, {S(0), S(0), Vec3<S>::zero()}), Fault::bad_mass, "density");
  refused(this->w.set_mass(carried, {S(1), S(1), Vec3<S>::zero()}), Fault::not_dynamic, "body");
  refused(this->w.apply(SetEnabled{body, 2}), Fault::bad_argument, "enabled");
  refused(this->w.sleep(carried), Fault::not_dynamic, "body");
  refused(this->w.move_to(body, this->w.pose(body)), Fault::bad_argument, "body");
  refused(this->w.move_to(carried, {vec<S>(0, 0, 0), {Unit<S>(0), Unit<S>(0), Unit<S>(0), Unit<S>(0)}}),
          Fault::bad_argument, "pose.orientation");
  EXPECT_TRUE(this->w.set_enabled(body, true));
  EXPECT_TRUE(this->w.set_type(body, dynamic));
  EXPECT_EQ(this->w.hash(), before) << "they are that already";
}

/// Momentum of an inelastic push is shared by the masses of the moment.
TYPED_TEST(BodyChanges, a_heavier_body_answers_less_to_the_same_impulse) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  const BodyId body = this->box({0, 0, 0});
  ASSERT_TRUE(this->w.set_mass(body, {S(1), S(4), Vec3<S>::zero()}));
  this->w.apply_impulse(body, vec<S>(2, 0, 0), vec<S>(0, 1, 0));
  EXPECT_NEAR(this->speed(body).x, 0.5, 16 * speed_grain<S>());
  const double turning = 1 / (4 * (1.0 / 6));  // of a cube, m a^2 / 6
  EXPECT_NEAR(to_double(this->w.angular_velocity(body).y), turning, 1e-3);
  ASSERT_TRUE(this->w.set_mass(body, {S(1), S(2), vec<S>(1, 2, 4)}));
  this->w.set_velocity(body, Vec3<S>::zero(), Vec3<S>::zero());
  this->w.apply_impulse(body, Vec3<S>::zero(), vec<S>(0, 1, 0));
  EXPECT_NEAR(to_double(this->w.angular_velocity(body).y), 0.5, 1e-3);
}

// ---- sleep

TYPED_TEST(BodyChanges, a_body_put_to_sleep_stops_with_its_island_and_wakes_as_others_do) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId low = this->box({0, 0.5, 0}), high = this->box({0, 1.5, 0}), apart = this->box({8, 4, 0});
  run(this->w, 3);
  this->w.apply_impulse(high, vec<S>(0.5, 0, 0));
  this->w.apply_force(low, vec<S>(5, 0, 0));
  ASSERT_TRUE(this->w.sleep(high)) << describe(this->w.fault());
  EXPECT_FALSE(this->w.is_awake(low));
  EXPECT_FALSE(this->w.is_awake(high));
  EXPECT_TRUE(this->w.is_awake(apart));
  EXPECT_EQ(this->w.velocity(high), Vec3<S>::zero());
  EXPECT_TRUE(this->w.sleep(high)) << "it is that already";
  const D3 there = this->at(high);
  run(this->w, 20);
  EXPECT_EQ(this->at(high), there);
  this->w.set_velocity(apart, vec<S>(0, 0, 0), vec<S>(0, 0, 0));
  this->w.set_pose(apart, {vec<S>(0, 2.6, 0), Quat<Unit<S>>::identity()});
  run(this->w, 30);
  EXPECT_TRUE(this->w.is_awake(low) || this->w.counts().awake == 0);
  EXPECT_TRUE(settle(this->w));
  EXPECT_NEAR(this->at(apart).y, 2.5, 0.02);
}

TYPED_TEST(BodyChanges, the_next_step_tells_who_was_put_to_sleep_and_of_two_changes_none) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId low = this->box({0, 0.5, 0}), high = this->box({0, 1.5, 0}), apart = this->box({8, 0.5, 0});
  run(this->w, 3);
  typename World<S>::Snapshot saved;
  const auto expect_told = [&](std::vector<BodyId> fell_asleep, std::vector<BodyId> woke) {
    this->w.save(saved);
    for (const bool again : {false, true}) {  // what is to be told is state
      if (again) this->w.load(saved);
      this->w.step();
      EXPECT_EQ(this->w.events().fell_asleep, fell_asleep);
      EXPECT_EQ(this->w.events().woke, woke);
    }
  };
  ASSERT_TRUE(this->w.sleep(high));
  expect_told({low, high}, {});
  expect_told({}, {});
  ASSERT_TRUE(this->w.wake(low));
  ASSERT_TRUE(this->w.sleep(low));
  ASSERT_TRUE(this->w.sleep(apart));
  expect_told({apart}, {});
  ASSERT_TRUE(this->w.wake(low));
  ASSERT_TRUE(this->w.sleep(high));
  ASSERT_TRUE(this->w.wake(low));
  expect_told({}, {low, high});
  ASSERT_TRUE(this->w.sleep(low));
  ASSERT_TRUE(this->w.destroy(low));
  this->w.step();
  EXPECT_TRUE(this->w.events().fell_asleep.empty());
}

TYPED_TEST(BodyChanges, an_island_of_one_that_may_not_sleep_stays_awake) {
  using S = TypeParam;
  add_ground(this->w);
  BodyDefinition<S> d = moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {0, 0.5, 0});
  d.allow_sleep = false;
  this->w.create(d);
  const BodyId high = this->box({0, 1.5, 0});
  run(this->w, 3);
  const std::uint64_t before = this->w.hash();
  EXPECT_FALSE(this->w.sleep(high));
  EXPECT_EQ(this->w.fault(), Fault::bad_argument);
  EXPECT_EQ(this->w.hash(), before);
}

// ---- targets

TYPED_TEST(BodyChanges, the_next_step_carries_a_kinematic_body_exactly_to_its_target_and_leaves_it_at_rest) {
  using S = TypeParam;
  const BodyId body = this->mover({0, 0, 0});
  const Pose<S> goals[] = {{vec<S>(0.125, 0.25, -0.0625), turn<S>({0, 1, 0}, 0.1)},
                           {vec<S>(0.25, 0.25, 0), turn<S>({0.6, 0, 0.8}, -0.2)},
                           {vec<S>(0.25, 0.25, 0), turn<S>({0.6, 0, 0.8}, -0.2)}};
  for (const Pose<S>& goal : goals) {
    ASSERT_TRUE(this->w.move_to(body, {vec<S>(5, 5, 5), goal.orientation}));
    ASSERT_TRUE(this->w.move_to(body, goal)) << describe(this->w.fault());
    run(this->w, 1);
    EXPECT_EQ(this->w.pose(body).position, goal.position);
    EXPECT_EQ(this->w.pose(body).orientation, normalise(goal.orientation));
    EXPECT_EQ(this->w.velocity(body), Vec3<S>::zero());
    EXPECT_EQ(this->w.angular_velocity(body), Vec3<S>::zero());
  }
  const Pose<S> there = this->w.pose(body);
  run(this->w, 5);
  EXPECT_EQ(this->w.pose(body).position, there.position);
  EXPECT_TRUE(this->w.state().moves.empty());
}

/// A lift of 0.5 m/s, up and then aside: what stands on it goes along, but for v^2 / 2 mu g until it has that speed.
TYPED_TEST(BodyChanges, what_stands_on_a_body_that_is_told_where_to_be_is_carried) {
  using S = TypeParam;
  const BodyId lift = this->mover({0, 0, 0});
  const BodyId load = this->box({0, 0.625, 0});
  run(this->w, 30);
  double y = 0, x = 0;
  for (int i = 0; i < 60; ++i) {
    y += 0.5 / 60;
    ASSERT_TRUE(this->w.move_to(lift, {vec<S>(0, y, 0), Quat<Unit<S>>::identity()}));
    run(this->w, 1);
  }
  EXPECT_NEAR(this->at(load).y, y + 0.625, 0.01);
  run(this->w, 20);  // it left the lift as that stopped
  for (int i = 0; i < 60; ++i) {
    x += 0.5 / 60;
    ASSERT_TRUE(this->w.move_to(lift, {vec<S>(x, y, 0), Quat<Unit<S>>::identity()}));
    run(this->w, 1);
  }
  EXPECT_NEAR(this->at(load).x, x - 0.25 / (2 * 0.6 * 10), 0.005);
  EXPECT_NEAR(this->at(load).y, y + 0.625, 0.01);
}

TYPED_TEST(BodyChanges, a_target_wakes_what_sleeps_on_the_body_and_one_where_it_is_does_not) {
  using S = TypeParam;
  const BodyId lift = this->mover({0, 0, 0});
  const BodyId load = this->box({0, 0.625, 0});
  run(this->w, 120);
  ASSERT_FALSE(this->w.is_awake(load));
  const std::uint64_t before = this->w.hash();
  ASSERT_TRUE(this->w.move_to(lift, this->w.pose(lift)));
  EXPECT_EQ(this->w.hash(), before);
  ASSERT_TRUE(this->w.move_to(lift, {vec<S>(0, 0.125, 0), Quat<Unit<S>>::identity()}));
  EXPECT_TRUE(this->w.is_awake(load));
}

TYPED_TEST(BodyChanges, a_target_out_of_reach_is_approached_as_fast_as_bodies_may_be) {
  using S = TypeParam;
  const BodyId body = this->mover({0, 0, 0});
  const double far = std::min(to_double(Limits<S>::position()) / 2, to_double(Limits<S>::speed()));
  ASSERT_TRUE(this->w.move_to(body, {vec<S>(far, 0, 0), Quat<Unit<S>>::identity()}));
  this->w.step();
  EXPECT_NEAR(this->at(body).x, to_double(Limits<S>::speed()) / 60, far * 1e-3);
  EXPECT_EQ(this->w.velocity(body), Vec3<S>::zero());
}

// ---- rollback

TYPED_TEST(BodyChanges, all_of_it_is_state) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId lift = this->mover({0, 2, 0});
  const BodyId a = this->box({0, 3, 0}, {0.25, 0.25, 0.25}), b = this->box({0.5, 4, 0}, {0.25, 0.25, 0.25});
  const Pose<S> frame = {vec<S>(0.25, 3.5, 0), Quat<Unit<S>>::identity()};
  ASSERT_TRUE(this->w.create(this->w.joint_at(JointType::ball, a, b, frame)));
  expect_exact_rollback(this->w, 120, [&](World<S>& world, int i) {
    world.move_to(lift, {vec<S>(i / 256.0, 2 + i / 512.0, 0), Quat<Unit<S>>::identity()});
    if (i % 10 == 3) world.set_enabled(a, i % 20 == 13);
    if (i % 16 == 7) world.set_type(b, i % 32 == 7 ? BodyType::static_ : dynamic);
    if (i % 7 == 1) world.set_mass(b, {S(1), S(1 + i % 3), Vec3<S>::zero()});
    if (i % 40 == 39) world.sleep(a);
  });
}

TYPED_TEST(BodyChanges, no_lock_holds_a_body_that_is_told_where_to_be) {
  using S = TypeParam;
  double way[2] = {};
  for (const bool locked : {false, true}) {
    this->w = World<S>(settings<S>());
    const BodyId lift = this->mover({0, 0, 0});
    ASSERT_TRUE(!locked || this->w.set_motion(lift, S(1), S(0), S(0), body_flag::kAllLocks))
        << describe(this->w.fault());
    const BodyId load = this->box({0, 0.625, 0});
    run(this->w, 30);
    for (int i = 1; i <= 60; ++i) {
      ASSERT_TRUE(this->w.move_to(lift, {vec<S>(0.5 * i / 60, 0, 0), Quat<Unit<S>>::identity()}));
      run(this->w, 1);
    }
    way[locked ? 1 : 0] = this->at(load).x;
    const std::uint32_t locks = this->w.view(lift).properties->flags & body_flag::kAllLocks;
    EXPECT_EQ(locks, locked ? body_flag::kAllLocks : 0u);
  }
  EXPECT_GT(way[0], 0.4);
  EXPECT_EQ(way[0], way[1]);
}

}  // namespace body_changes_test
}  // namespace isostep::test
