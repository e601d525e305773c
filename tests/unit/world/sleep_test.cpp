// Sleep: islands fall asleep whole, cost nothing, and wake when anything that held them changes.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace sleep_test {

/// Two stacks of three boxes on a half-space, far apart.
template <class S> class WorldSleep : public ::testing::Test {
 protected:
  WorldSleep() : world(settings<S>()) {
    ground = add_ground(world);
    box = add_box(world, 0.5, 0.5, 0.5);
    for (int i = 0; i < 3; ++i) {
      left[i] = world.create(moving<S>(box, {0, 0.5 + i, 0}));
      right[i] = world.create(moving<S>(box, {20, 0.5 + i, 0}));
    }
  }
  void expect_left(bool awake) {
    for (const BodyId id : left) EXPECT_EQ(world.is_awake(id), awake);
  }
  void expect_right(bool awake) {
    for (const BodyId id : right) EXPECT_EQ(world.is_awake(id), awake);
  }

  World<S> world;
  ShapeId box;
  BodyId ground, left[3], right[3];
};
TYPED_TEST_SUITE(WorldSleep, AllScalars);

TYPED_TEST(WorldSleep, an_island_falls_asleep_whole_after_half_a_second_of_rest) {
  World<TypeParam>& w = this->world;
  run(w, 20);
  this->expect_left(true);
  ASSERT_TRUE(settle(w, 120));
  EXPECT_GE(w.tick(), 30u);
  EXPECT_EQ(w.counts().asleep, 6u);
  EXPECT_EQ(w.state().sleeping.size(), 2u);
  EXPECT_EQ(w.state().contacts.size(), 0u);
  EXPECT_EQ(w.counts().contacts, 6u);
  EXPECT_EQ(w.velocity(this->left[2]), Vec3<TypeParam>::zero());
}

TYPED_TEST(WorldSleep, one_restless_body_keeps_its_island_awake_and_no_other) {
  using S = TypeParam;
  World<S>& w = this->world;
  BodyDefinition<S> d = moving<S>(this->box, {0, 3.5, 0});
  d.allow_sleep = false;
  const BodyId restless = w.create(d);
  run(w, 180);
  this->expect_left(true);
  this->expect_right(false);
  EXPECT_TRUE(w.is_awake(restless));
}

TYPED_TEST(WorldSleep, nothing_sleeps_where_the_settings_forbid_it) {
  using S = TypeParam;
  Settings<S> s = settings<S>();
  s.allow_sleep = false;
  World<S> w(s);
  w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  w.set_gravity(Vec3<S>::zero());
  run(w, 120);
  EXPECT_EQ(w.counts().asleep, 0u);
}

TYPED_TEST(WorldSleep, falling_asleep_and_waking_are_told_once_in_order_of_islands_and_slots) {
  World<TypeParam>& w = this->world;
  std::vector<BodyId> slept;
  for (int i = 0; i < 120; ++i) {
    w.step();
    EXPECT_TRUE(w.events().woke.empty());
    slept.insert(slept.end(), w.events().fell_asleep.begin(), w.events().fell_asleep.end());
  }
  ASSERT_EQ(slept.size(), 6u);
  for (const BodyId id : w.bodies()) EXPECT_EQ(std::count(slept.begin(), slept.end(), id), id == this->ground ? 0 : 1);
  ASSERT_TRUE(w.wake(this->left[1]));
  EXPECT_TRUE(w.events().woke.empty()) << "the next step tells";
  w.step();
  ASSERT_EQ(w.events().woke.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(w.events().woke[static_cast<std::size_t>(i)], this->left[i]);
  w.step();
  EXPECT_TRUE(w.events().woke.empty());
}

TYPED_TEST(WorldSleep, sleepers_keep_their_bits) {
  using S = TypeParam;
  World<S>& w = this->world;
  ASSERT_TRUE(settle(w));
  const SleepingIsland<S>* const island = w.state().sleeping[0].get();
  const std::uint64_t island_hash = island->hash;
  const Pose<S> pose = w.pose(this->left[2]);
  const std::uint64_t before = w.hash();
  run(w, 100);
  EXPECT_EQ(w.state().sleeping[0].get(), island) << "an island that nothing woke was built anew";
  EXPECT_EQ(island->hash, island_hash);
  EXPECT_EQ(w.pose(this->left[2]).position, pose.position);
  EXPECT_EQ(w.pose(this->left[2]).orientation, pose.orientation);
  EXPECT_NE(w.hash(), before) << "the tick is part of the hash";
}

TYPED_TEST(WorldSleep, a_snapshot_shares_sleepers_and_costs_the_same_for_any_number) {
  using S = TypeParam;
  World<S> few(settings<S>(0)), many(settings<S>(0));
  const ShapeId a = add_ball(few, 0.25), b = add_ball(many, 0.25);
  few.create(moving<S>(a, {0, 0, 0}));
  // One long chain of touching balls is one island.
  for (int i = 0; i < 100; ++i) many.create(moving<S>(b, {0.5 * i, 0, 0}));
  ASSERT_TRUE(settle(few));
  ASSERT_TRUE(settle(many));
  ASSERT_EQ(many.state().sleeping.size(), 1u);
  typename World<S>::Snapshot one, hundred;
  few.save(one);
  many.save(hundred);
  EXPECT_EQ(hundred.bytes(), one.bytes());
  EXPECT_EQ(many.state().sleeping[0].use_count(), 1) << "world and snapshot share the page that names the island";
}

TYPED_TEST(WorldSleep, a_step_has_nothing_to_solve_when_all_sleep) {
  World<TypeParam>& w = this->world;
  ASSERT_TRUE(settle(w));
  w.step();
  EXPECT_EQ(w.counts().awake, 0u);
  EXPECT_EQ(w.state().awake.states.size() + w.state().contacts.size() + w.state().joints.states.size(), 0u);
  EXPECT_TRUE(w.events().contact_begin.empty() && w.events().contact_end.empty());
  EXPECT_TRUE(w.events().fell_asleep.empty() && w.events().woke.empty());
}

TYPED_TEST(WorldSleep, contacts_do_not_end_when_they_fall_asleep_nor_begin_when_they_wake) {
  World<TypeParam>& w = this->world;
  run(w, 10);
  std::size_t events = 0;
  for (int i = 0; i < 120; ++i) {
    w.step();
    events += w.events().contact_begin.size() + w.events().contact_end.size();
  }
  ASSERT_EQ(w.counts().awake, 0u);
  w.wake(this->left[0]);
  for (int i = 0; i < 10; ++i) {
    w.step();
    events += w.events().contact_begin.size() + w.events().contact_end.size();
  }
  EXPECT_EQ(events, 0u);
}

TYPED_TEST(WorldSleep, every_command_on_a_sleeper_wakes_its_island_alone) {
  using S = TypeParam;
  World<S>& w = this->world;
  const BodyId top = this->left[2];
  const auto check = [&](const char* what, auto&& command) {
    ASSERT_TRUE(settle(w)) << what;
    this->expect_left(false);
    EXPECT_TRUE(static_cast<bool>(command())) << what;
    for (const BodyId id : this->left) EXPECT_TRUE(w.is_awake(id)) << what;
    this->expect_right(false);
  };
  check("wake", [&] { return w.wake(top); });
  check("pose", [&] { return w.set_pose(top, w.pose(top)); });
  check("velocity", [&] { return w.set_velocity(top, vec<S>(0, 0.01, 0), Vec3<S>::zero()); });
  check("force", [&] { return w.apply_force(top, vec<S>(0, 1, 0)); });
  check("impulse", [&] { return w.apply_impulse(top, vec<S>(0, 0.01, 0)); });
  check("material", [&] { return w.set_material(top, {}); });
  check("filter", [&] { return w.set_filter(top, {}); });
  check("motion", [&] { return w.set_motion(top, S(1), S(0), S(0), 0); });
  check("user data", [&] { return w.set_user_data(top, 1); });
  JointId joint;
  check("create joint", [&] {
    joint = w.create(w.joint_at(JointType::ball, {}, top, {vec<S>(0, 3, 0), Quat<Unit<S>>::identity()}));
    return joint;
  });
  check("set joint", [&] { return w.set_joint(joint, *w.joint(joint)); });
  check("destroy joint", [&] { return w.destroy(joint); });
  ASSERT_TRUE(settle(w));
  EXPECT_TRUE(w.set_gravity(vec<S>(0, -10, 0)));
  this->expect_left(true);
  this->expect_right(true);
}

TYPED_TEST(WorldSleep, removing_the_support_wakes_what_it_bore_and_lets_it_fall) {
  using S = TypeParam;
  World<S>& w = this->world;
  ASSERT_TRUE(settle(w));
  ASSERT_TRUE(w.destroy(this->left[0]));
  EXPECT_TRUE(w.is_awake(this->left[1]));
  EXPECT_TRUE(w.is_awake(this->left[2]));
  this->expect_right(false);
  run(w, 10);
  EXPECT_LT(to_double(w.velocity(this->left[2]).y), -1);
  ASSERT_TRUE(w.destroy(this->ground));
  this->expect_right(true);
}

TYPED_TEST(WorldSleep, a_support_moved_away_wakes_what_it_bore) {
  using S = TypeParam;
  for (const BodyType type : {BodyType::static_, BodyType::kinematic}) {
    World<S> w(settings<S>());
    const ShapeId cube = add_box(w, 0.5, 0.5, 0.5);
    BodyDefinition<S> d = still<S>(cube);
    d.type = type;
    const BodyId support = w.create(d);
    const BodyId load = w.create(moving<S>(cube, {0, 1, 0}));
    for (int i = 0; i < 120; ++i) w.step();
    ASSERT_FALSE(w.is_awake(load));
    ASSERT_TRUE(w.set_pose(support, {vec<S>(0, -5, 0), Quat<Unit<S>>::identity()}));
    EXPECT_TRUE(w.is_awake(load));
    run(w, 10);
    EXPECT_LT(to_double(w.velocity(load).y), -1);
  }
}

TYPED_TEST(WorldSleep, a_touch_wakes_the_island_touched_and_no_other) {
  using S = TypeParam;
  World<S>& w = this->world;
  ASSERT_TRUE(settle(w));
  w.create(moving<S>(this->box, {2, 1.5, 0}, {-6, 0, 0}));
  run(w, 6);
  this->expect_left(false);
  run(w, 8);
  this->expect_left(true);
  this->expect_right(false);
}

TYPED_TEST(WorldSleep, islands_that_touch_one_another_all_wake_at_once) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  std::vector<BodyId> row;
  // Each is asleep before the next arrives at its side: touching, yet islands of their own or of all.
  for (int i = 0; i < 4; ++i) {
    row.push_back(w.create(moving<S>(ball, {1.0 * i, 0, 0})));
    for (int k = 0; k < 60; ++k) w.step();
  }
  ASSERT_EQ(w.counts().awake, 0u);
  w.create(moving<S>(ball, {-2, 0, 0}, {6, 0, 0}));
  run(w, 20);
  for (const BodyId id : row) EXPECT_TRUE(w.is_awake(id));
}

TYPED_TEST(WorldSleep, a_kinematic_body_at_rest_lets_its_load_sleep_and_wakes_it_when_it_moves) {
  using S = TypeParam;
  for (const double speed : {1.0, 0.02}) {
    World<S> w(settings<S>());
    BodyDefinition<S> d = still<S>(add_box(w, 1, 0.25, 1), {0, 0, 0});
    d.type = BodyType::kinematic;
    const BodyId lift = w.create(d);
    const BodyId load = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.75, 0}));
    for (int i = 0; i < 120; ++i) w.step();
    ASSERT_FALSE(w.is_awake(load));
    ASSERT_TRUE(w.set_velocity(lift, vec<S>(0, speed, 0), Vec3<S>::zero()));
    for (int i = 0; i < 150; ++i) {
      w.step();
      ASSERT_TRUE(w.is_awake(load)) << "carried at " << speed << " m/s";
    }
    EXPECT_NEAR(to_double(w.center_of_mass(load).y) - to_double(w.center_of_mass(lift).y), 0.75, 0.02);
    EXPECT_NEAR(to_double(w.velocity(load).y), speed, 0.01);
    ASSERT_TRUE(w.set_velocity(lift, Vec3<S>::zero(), Vec3<S>::zero()));
    for (int i = 0; i < 120; ++i) w.step();
    EXPECT_FALSE(w.is_awake(load));
  }
}

TYPED_TEST(WorldSleep, what_hangs_from_a_body_wakes_when_that_body_is_moved) {
  using S = TypeParam;
  for (const BodyType type : {BodyType::kinematic, BodyType::static_}) {
    for (const bool teleport : {true, false}) {
      if (type == BodyType::static_ && !teleport) continue;
      World<S> w(settings<S>());
      const ShapeId ball = add_ball(w, 0.25);
      BodyDefinition<S> d = still<S>(ball, {0, 10, 0});
      d.type = type;
      const BodyId hook = w.create(d);
      const BodyId bob = w.create(moving<S>(ball, {0, 6, 0}));
      JointProperties<S> rope =
          w.joint_at(JointType::distance, hook, bob, {vec<S>(0, 10, 0), Quat<Unit<S>>::identity()});
      rope.frame_b.position = Vec3<S>::zero();
      rope.lower = rope.upper = S(4);
      ASSERT_TRUE(w.create(rope));
      for (int i = 0; i < 120; ++i) w.step();
      ASSERT_FALSE(w.is_awake(bob));
      if (teleport) ASSERT_TRUE(w.set_pose(hook, {vec<S>(1, 10, 0), Quat<Unit<S>>::identity()}));
      else ASSERT_TRUE(w.set_velocity(hook, vec<S>(1, 0, 0), Vec3<S>::zero()));
      run(w, 30);
      EXPECT_TRUE(w.is_awake(bob));
      EXPECT_GT(to_double(w.center_of_mass(bob).x), 0.02);
    }
  }
}

TYPED_TEST(WorldSleep, a_body_joined_to_a_kinematic_that_creeps_stays_awake) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const ShapeId ball = add_ball(w, 0.25);
  BodyDefinition<S> d = still<S>(ball, {0, 10, 0});
  d.type = BodyType::kinematic;
  d.velocity = vec<S>(0, 0.02, 0);
  const BodyId hook = w.create(d);
  const BodyId bob = w.create(moving<S>(ball, {0, 6, 0}));
  JointProperties<S> rope = w.joint_at(JointType::distance, hook, bob, {vec<S>(0, 10, 0), Quat<Unit<S>>::identity()});
  rope.frame_b.position = Vec3<S>::zero();
  rope.lower = rope.upper = S(4);
  ASSERT_TRUE(w.create(rope));
  run(w, 240);
  EXPECT_NEAR(to_double(w.center_of_mass(hook).y) - to_double(w.center_of_mass(bob).y), 4, 0.01);
}

TYPED_TEST(WorldSleep, a_body_made_inside_sleepers_wakes_them_whatever_its_kind) {
  using S = TypeParam;
  for (const BodyType type : {BodyType::static_, BodyType::kinematic, BodyType::dynamic}) {
    World<S> w(settings<S>());
    add_ground(w);
    const ShapeId cube = add_box(w, 0.5, 0.5, 0.5);
    const BodyId sleeper = w.create(moving<S>(cube, {0, 0.5, 0}));
    ASSERT_TRUE(settle(w));
    BodyDefinition<S> d = moving<S>(cube, {0.9, 0.5, 0});
    d.type = type;
    ASSERT_TRUE(w.create(d));
    w.step();
    EXPECT_TRUE(w.is_awake(sleeper)) << static_cast<int>(type);
  }
}

TYPED_TEST(WorldSleep, joined_bodies_sleep_and_wake_together) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const ShapeId ball = add_ball(w, 0.25);
  BodyId previous;
  std::vector<BodyId> chain;
  for (int i = 0; i < 5; ++i) {
    chain.push_back(w.create(moving<S>(ball, {0, 9.0 - i, 0})));
    const Pose<S> frame = {vec<S>(0, 9.5 - i, 0), Quat<Unit<S>>::identity()};
    ASSERT_TRUE(w.create(w.joint_at(JointType::ball, previous, chain.back(), frame)));
    previous = chain.back();
  }
  ASSERT_TRUE(settle(w));
  EXPECT_EQ(w.state().sleeping.size(), 1u);
  EXPECT_EQ(w.state().sleeping[0]->joints.states.size(), 5u);
  EXPECT_EQ(w.counts().joints, 5u);
  EXPECT_LT(to_double(w.joint_error(w.joints()[2])), 0.01);
  ASSERT_TRUE(w.destroy(w.joints()[4]));
  for (const BodyId id : chain) EXPECT_TRUE(w.is_awake(id));
  run(w, 10);
  EXPECT_LT(to_double(w.velocity(chain[4]).y), -1);
  EXPECT_NEAR(to_double(w.velocity(chain[3]).y), 0, 0.1);
}

TYPED_TEST(WorldSleep, a_slow_drifter_with_no_force_on_it_is_not_put_to_sleep_above_the_threshold) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}, {0.06, 0, 0}));
  run(w, 600);
  EXPECT_TRUE(w.is_awake(id));
  EXPECT_NEAR(to_double(w.center_of_mass(id).x), 0.6, 0.01);
}

/// Slower than what rests: half a turn a minute.
TYPED_TEST(WorldSleep, a_slow_motor_stays_awake_and_one_at_its_stop_does_not) {
  using S = TypeParam;
  for (const bool stops : {false, true}) {
    World<S> w(settings<S>(0));
    const BodyId hand = w.create(moving<S>(add_ball(w, 0.5), {1, 0, 0}));
    JointProperties<S> p = w.joint_at(JointType::hinge, {}, hand, Pose<S>::identity());
    p.flags = joint_flag::kMotor | (stops ? joint_flag::kLimit : 0u);
    p.upper = num<S>(0.03);
    p.motor_speed = num<S>(0.03);
    p.max_force = S(50);
    const JointId joint = w.create(p);
    ASSERT_TRUE(joint) << describe(w.fault());
    run(w, 600);
    EXPECT_EQ(w.is_awake(hand), !stops);
    EXPECT_NEAR(to_double(w.joint_position(joint)), stops ? 0.03 : 0.3, 0.01);
  }
}

TYPED_TEST(WorldSleep, a_fast_kinematic_body_takes_sleepers_along_as_it_does_others) {
  using S = TypeParam;
  double way[2] = {};
  for (const bool asleep : {false, true}) {
    World<S> w(settings<S>());
    add_ground(w);
    BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 0.25, 0});
    d.allow_sleep = asleep;
    const BodyId crate = w.create(d);
    run(w, 60);
    EXPECT_EQ(w.is_awake(crate), !asleep);
    BodyDefinition<S> blade = still<S>(add_box(w, 0.05, 0.5, 1), {-1, 0.5, 0});
    blade.type = BodyType::kinematic;
    blade.velocity = vec<S>(45, 0, 0);
    w.create(blade);
    run(w, 6);
    way[asleep ? 1 : 0] = to_double(w.center_of_mass(crate).x);
  }
  EXPECT_GT(way[0], 2);
  EXPECT_NEAR(way[1], way[0], 0.05);
}

}  // namespace sleep_test
}  // namespace isostep::test
