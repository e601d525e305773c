// Events of what commands end and wake, as the next step tells it: also where the world was saved and loaded in
// between; and what sensors see.
// SPDX-License-Identifier: MIT
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace events_test {

/// A box at rest on the ground, inside a sensor that nothing moves.
template <class S> class WorldEvents : public ::testing::Test {
 protected:
  WorldEvents() : world(settings<S>()) {
    ground = add_ground(world);
    shape = add_box(world, 0.5, 0.5, 0.5);
    box = world.create(moving<S>(shape, {0, 0.5, 0}));
    BodyDefinition<S> d = still<S>(add_box(world, 1, 1, 1), {0, 0.5, 0});
    d.sensor = true;
    sensor = world.create(d);
    for (int i = 0; i < 10; ++i) world.step();
    EXPECT_TRUE(world.is_awake(box));
    EXPECT_EQ(world.state().overlaps.size(), 1u);
  }
  void expect_both_ended(BodyId other = {}) {
    const Events<S>& events = world.events();
    ASSERT_EQ(events.contact_end.size(), 1u);
    EXPECT_EQ(events.contact_end[0].a, ground);
    EXPECT_EQ(events.contact_end[0].b, other ? other : box);
    ASSERT_EQ(events.sensor_end.size(), 1u);
    EXPECT_EQ(events.sensor_end[0].sensor, sensor);
    EXPECT_EQ(events.sensor_end[0].other, other ? other : box);
  }
  void expect_nothing_ends() {
    EXPECT_TRUE(world.events().contact_end.empty());
    EXPECT_TRUE(world.events().sensor_end.empty());
  }
  void fall_asleep() {
    ASSERT_TRUE(settle(world));
    ASSERT_FALSE(world.is_awake(box));
  }

  World<S> world;
  ShapeId shape;
  BodyId ground, box, sensor;
};
TYPED_TEST_SUITE(WorldEvents, AllScalars);

TYPED_TEST(WorldEvents, what_a_destroyed_body_touched_or_was_inside_of_ends_with_the_next_step) {
  ASSERT_TRUE(this->world.destroy(this->box));
  this->world.step();
  this->expect_both_ended();
  this->world.step();
  this->expect_nothing_ends();
}

TYPED_TEST(WorldEvents, a_destroyed_sleeper_ends_them_too) {
  this->fall_asleep();
  ASSERT_TRUE(this->world.destroy(this->box));
  this->world.step();
  this->expect_both_ended();
}

TYPED_TEST(WorldEvents, so_do_a_ground_and_a_sensor_that_are_destroyed) {
  this->fall_asleep();
  ASSERT_TRUE(this->world.destroy(this->ground));
  ASSERT_TRUE(this->world.destroy(this->sensor));
  this->world.step();
  this->expect_both_ended();
}

TYPED_TEST(WorldEvents, a_filter_that_lets_nothing_touch_any_more_ends_them) {
  for (const bool asleep : {false, true}) {
    if (asleep) this->fall_asleep();
    ASSERT_TRUE(this->world.set_filter(this->box, {1, 0, 0}));
    this->world.step();
    this->expect_both_ended();
    ASSERT_TRUE(this->world.set_filter(this->box, {}));
    ASSERT_TRUE(this->world.set_pose(this->box, {vec<TypeParam>(0, 0.5, 0), Quat<Unit<TypeParam>>::identity()}));
    ASSERT_TRUE(this->world.set_velocity(this->box, Vec3<TypeParam>::zero(), Vec3<TypeParam>::zero()));
    for (int i = 0; i < 10; ++i) this->world.step();
  }
}

TYPED_TEST(WorldEvents, ends_name_the_body_that_is_gone_and_not_the_one_that_took_its_slot) {
  using S = TypeParam;
  World<S>& w = this->world;
  ASSERT_TRUE(w.destroy(this->box));
  const BodyId next = w.create(moving<S>(this->shape, {0, 0.5, 0}));
  ASSERT_EQ(next.slot, this->box.slot);
  w.step();
  this->expect_both_ended();
  ASSERT_EQ(w.events().sensor_begin.size(), 1u);
  EXPECT_EQ(w.events().sensor_begin[0].other, next);
}

TYPED_TEST(WorldEvents, ends_ascend_whoever_made_them) {
  using S = TypeParam;
  World<S>& w = this->world;
  std::vector<BodyId> boxes = {this->box};
  for (int i = 1; i < 5; ++i) boxes.push_back(w.create(moving<S>(this->shape, {3.0 * i, 0.5, 0})));
  for (int i = 0; i < 5; ++i) w.step();
  ASSERT_TRUE(w.destroy(boxes[3]));
  ASSERT_TRUE(w.destroy(boxes[1]));
  ASSERT_TRUE(w.set_filter(boxes[2], {1, 0, 0}));
  ASSERT_TRUE(w.set_filter(boxes[0], {1, 0, 0}));
  w.step();
  ASSERT_EQ(w.events().contact_end.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(w.events().contact_end[i].b, boxes[i]);
}

template <class Event> std::vector<BodyId> bodies_of(const std::vector<Event>& events) {
  std::vector<BodyId> bodies;
  for (const Event& e : events) {
    if constexpr (std::is_same_v<Event, BodyId>) bodies.push_back(e);
    if constexpr (std::is_same_v<Event, ContactEnd>) bodies.insert(bodies.end(), {e.a, e.b});
    if constexpr (std::is_same_v<Event, SensorEvent>) bodies.insert(bodies.end(), {e.sensor, e.other});
  }
  return bodies;
}
template <class S> void expect_same_events(const Events<S>& a, const Events<S>& b) {
  EXPECT_EQ(bodies_of(a.woke), bodies_of(b.woke));
  EXPECT_EQ(bodies_of(a.contact_end), bodies_of(b.contact_end));
  EXPECT_EQ(bodies_of(a.sensor_end), bodies_of(b.sensor_end));
}

TYPED_TEST(WorldEvents, waking_and_ending_are_told_after_a_load_and_in_another_world_as_well) {
  using S = TypeParam;
  World<S>& w = this->world;
  const BodyId other = w.create(moving<S>(this->shape, {5, 0.5, 0}));
  this->fall_asleep();
  ASSERT_TRUE(w.wake(other));
  ASSERT_TRUE(w.destroy(this->box));
  typename World<S>::Snapshot saved;
  w.save(saved);
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  World<S> loaded(settings<S>()), read(settings<S>());
  w.step();
  EXPECT_EQ(bodies_of(w.events().woke), (std::vector<BodyId>{other, this->box}));
  this->expect_both_ended();
  const Events<S> told = w.events();

  w.load(saved);
  EXPECT_TRUE(w.events().woke.empty());
  w.step();
  expect_same_events(w.events(), told);
  loaded.load(saved);
  loaded.step();
  expect_same_events(loaded.events(), told);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader));
  read.step();
  expect_same_events(read.events(), told);
  EXPECT_EQ(read.hash(), w.hash());
}

TYPED_TEST(WorldEvents, a_force_an_impulse_or_a_velocity_of_zero_wakes_nobody) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  this->fall_asleep();
  const std::uint64_t before = w.hash();
  EXPECT_TRUE(w.apply_force(this->box, zero));
  EXPECT_TRUE(w.apply_force_at(this->box, zero, vec<S>(1, 1, 0)));
  EXPECT_TRUE(w.apply_impulse(this->box, zero));
  EXPECT_TRUE(w.set_velocity(this->box, zero, zero));
  EXPECT_FALSE(w.is_awake(this->box));
  EXPECT_EQ(w.hash(), before);
  EXPECT_TRUE(w.apply_impulse(this->box, zero, vec<S>(0, 1, 0)));
  EXPECT_TRUE(w.is_awake(this->box));
}

TYPED_TEST(WorldEvents, who_is_told_so_every_frame_falls_asleep_and_so_does_a_load_on_a_platform_at_rest) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  BodyDefinition<S> d = still<S>(this->shape, {5, 0.5, 0});
  d.type = BodyType::kinematic;
  const BodyId platform = w.create(d), load = w.create(moving<S>(this->shape, {5, 1.5, 0}));
  for (int i = 0; i < 240; ++i) {
    ASSERT_TRUE(w.apply_force(this->box, zero));
    ASSERT_TRUE(w.set_velocity(platform, zero, zero));
    w.step();
  }
  EXPECT_FALSE(w.is_awake(this->box));
  EXPECT_FALSE(w.is_awake(load));
}

TYPED_TEST(WorldEvents, a_sensor_sees_kinematic_bodies_come_and_go) {
  using S = TypeParam;
  for (const BodyType sensor_type : {BodyType::static_, BodyType::kinematic, BodyType::dynamic}) {
    World<S> w(settings<S>(0));
    const ShapeId ball = add_ball(w, 0.5);
    BodyDefinition<S> d = still<S>(ball);
    d.type = sensor_type;
    d.sensor = true;
    const BodyId seer = w.create(d);
    d = moving<S>(ball, {-3, 0, 0}, {6, 0, 0});
    d.type = BodyType::kinematic;
    const BodyId mover = w.create(d);
    std::vector<BodyId> began, ended;
    for (int i = 0; i < 60; ++i) {
      w.step();
      for (const BodyId body : bodies_of(w.events().sensor_begin)) began.push_back(body);
      for (const BodyId body : bodies_of(w.events().sensor_end)) ended.push_back(body);
      EXPECT_EQ(w.counts().contacts, 0u);
    }
    EXPECT_EQ(began, (std::vector<BodyId>{seer, mover}));
    EXPECT_EQ(ended, (std::vector<BodyId>{seer, mover}));
    EXPECT_EQ(w.velocity(mover), vec<S>(6, 0, 0));
  }
}

TYPED_TEST(WorldEvents, a_sensor_that_is_moved_sees_what_stands_and_sees_no_sensor) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId post = w.create(still<S>(ball));
  BodyDefinition<S> d = still<S>(ball);
  d.sensor = true;
  w.create(d);
  d = moving<S>(ball, {-3, 0, 0}, {6, 0, 0});
  d.type = BodyType::kinematic;
  d.sensor = true;
  const BodyId mover = w.create(d);
  std::vector<BodyId> began;
  for (int i = 0; i < 60; ++i) {
    w.step();
    for (const BodyId body : bodies_of(w.events().sensor_begin)) began.push_back(body);
  }
  EXPECT_EQ(began, (std::vector<BodyId>{mover, post}));
}

}  // namespace events_test
}  // namespace isostep::test
