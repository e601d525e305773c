// Laws of SensorMount: a sensor goes with its carrier to the bit, sees at the right steps, and changes nothing.
// SPDX-License-Identifier: MIT

#include "laws/mounted_world.hpp"

namespace isostep::test {
namespace sensor_mounts_test {

template <class S> class SensorMounts : public MountedWorld<S> {
 protected:
  /// Flies along x by 1/16 m a step, with a sensor 4 m above and 1 m before it: exact in every scalar.
  BodyId flier() {
    const BodyId body = this->w.create(moving<S>(add_ball(this->w, 0.5), {0, 0, 0}, {4, 0, 0}));
    this->feel(body, {1, 4, 0});
    return body;
  }
  /// A ball of half a metre, as the sensors are.
  BodyId mark(D3 at) { return this->w.create(still<S>(add_ball(this->w, 0.5), at)); }
};
TYPED_TEST_SUITE(SensorMounts, AllScalars);

// The step that begins with the carrier at x = n / 16 is step n + 1. They overlap for 2.03125 < x < 4.03125.
TYPED_TEST(SensorMounts, see_what_their_carrier_passes_at_the_exact_step) {
  this->begin(0);
  this->flier();
  const BodyId mark = this->mark({4.03125, 4, 0});
  for (int step = 1; step <= 80; ++step) {
    this->w.step();
    ASSERT_EQ(this->begun(), step == 34 ? 1u : 0u) << step;
    ASSERT_EQ(this->ended(), step == 66 ? 1u : 0u) << step;
    if (step != 34) continue;
    EXPECT_EQ(this->w.events().sensor_begin[0].sensor, this->sensor);
    EXPECT_EQ(this->w.events().sensor_begin[0].other, mark);
  }
}

TYPED_TEST(SensorMounts, see_where_their_carrier_was_put_in_the_next_step) {
  using S = TypeParam;
  this->begin(0);
  const BodyId body = this->flier();
  this->mark({50, 4, 0});
  run(this->w, 3);
  this->w.set_pose(body, {vec<S>(49, 0, 0), Quat<Unit<S>>::identity()});
  this->w.step();
  EXPECT_EQ(this->begun(), 1u);
  this->w.set_pose(body, {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()});
  this->w.step();
  EXPECT_EQ(this->ended(), 1u);
  EXPECT_EQ(this->begun(), 0u);
}

TYPED_TEST(SensorMounts, see_at_once_what_is_there_when_they_are_mounted) {
  using S = TypeParam;
  this->begin(0);
  this->mark({1, 4, 0});
  const BodyId body = this->flier();
  this->w.step();
  EXPECT_EQ(this->begun(), 1u);
  SensorMount<S> record = *this->w.find(this->mount);
  record.frame.position = vec<S>(0, -4, 0);
  ASSERT_TRUE(this->w.set(this->mount, record));
  this->w.step();
  EXPECT_EQ(this->ended(), 1u);
  this->expect_in_place(body);
}

/// Two metres above a carrier that sleeps on the ground a ball comes by.
TYPED_TEST(SensorMounts, see_who_comes_and_goes_while_their_carrier_sleeps) {
  using S = TypeParam;
  this->begin(-10);
  add_ground(this->w);
  const BodyId body = this->w.create(moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  this->feel(body, {0, 2, 0});
  for (int i = 0; i < 300 && this->w.is_awake(body); ++i) this->w.step();
  ASSERT_FALSE(this->w.is_awake(body));
  BodyDefinition<S> d = moving<S>(add_ball(this->w, 0.5), {-2.03125, 2.5, 0}, {4, 0, 0});
  d.gravity_scale = S(0);
  const BodyId passer = this->w.create(d);
  for (int step = 1; step <= 60; ++step) {  // within 1 m for -1 < x < 1, but for a hair of height
    this->w.step();
    ASSERT_EQ(this->begun(), step == 18 ? 1u : 0u) << step;
    ASSERT_EQ(this->ended(), step == 50 ? 1u : 0u) << step;
    if (step == 18) {
      EXPECT_EQ(this->w.events().sensor_begin[0].other, passer);
    }
    ASSERT_FALSE(this->w.is_awake(body)) << step;
    this->expect_in_place(body);
  }
}

/// A sleeper inside is no news when the carrier falls asleep, is woken, or is put to sleep.
TYPED_TEST(SensorMounts, keep_what_is_inside_whoever_sleeps_and_wakes) {
  using S = TypeParam;
  this->begin(-10);
  add_ground(this->w);
  const BodyId body = this->w.create(moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  this->w.create(moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {2, 0.5, 0}));
  this->feel(body, {1.5, 0.25, 0});
  this->w.step();
  ASSERT_EQ(this->begun(), 1u);
  for (int step = 0; step < 240; ++step) {
    if (step == 120) this->w.wake(body);
    if (step == 130) {
      EXPECT_TRUE(this->w.sleep(body));
    }
    if (step == 140) this->w.apply_impulse(body, vec<S>(0, 0.5, 0));
    this->w.step();
    ASSERT_EQ(this->begun() + this->ended(), 0u) << step;
    this->expect_in_place(body);
  }
}

TYPED_TEST(SensorMounts, do_not_see_their_carrier_nor_what_the_filter_hides) {
  this->begin(0);
  BodyDefinition<TypeParam> hidden = moving<TypeParam>(add_ball(this->w, 0.5), {0.75, 0, 0});
  hidden.filter = {2, 0xffffffffu, 0};
  this->w.create(hidden);
  const BodyId seen = this->mark({-0.75, 0, 0});
  const BodyId body = this->w.create(moving<TypeParam>(add_ball(this->w, 0.125), {0, 0, 0}));
  this->feel(body, {0, 0, 0});
  ASSERT_TRUE(this->w.set_filter(this->sensor, {1, 1, 0}));
  this->w.step();
  ASSERT_EQ(this->begun(), 1u);
  EXPECT_EQ(this->w.events().sensor_begin[0].other, seen);
}

TYPED_TEST(SensorMounts, see_nothing_while_their_carrier_is_disabled_and_wait_while_they_are) {
  using S = TypeParam;
  this->begin(0);
  this->mark({1, 4, 0});
  const BodyId body = this->w.create(moving<S>(add_ball(this->w, 0.5), {0, 0, 0}));
  this->feel(body, {1, 4, 0});
  this->w.step();
  ASSERT_EQ(this->begun(), 1u);
  const auto switch_and_step = [&](BodyId id, bool enabled) {
    ASSERT_TRUE(this->w.set_enabled(id, enabled));
    this->w.step();
  };
  switch_and_step(body, false);
  EXPECT_EQ(this->ended(), 1u);
  this->w.step();
  EXPECT_EQ(this->begun() + this->ended(), 0u);
  switch_and_step(body, true);
  EXPECT_EQ(this->begun(), 1u);
  switch_and_step(this->sensor, false);
  EXPECT_EQ(this->ended(), 1u);
  this->w.set_pose(body, {vec<S>(0.25, 0, 0), Quat<Unit<S>>::identity()});
  switch_and_step(this->sensor, true);
  EXPECT_EQ(this->begun(), 1u);
  this->expect_in_place(body);
}

TYPED_TEST(SensorMounts, end_with_either_body_and_leave_the_sensor_where_it_is) {
  using S = TypeParam;
  this->begin(0);
  const BodyId mark = this->mark({2, 4, 0}), body = this->flier();
  run(this->w, 12);
  ASSERT_TRUE(this->w.destroy(body));
  EXPECT_EQ(this->w.find(this->mount), nullptr);
  const Vec3<S> at = this->w.pose(this->sensor).position;
  run(this->w, 5);
  EXPECT_EQ(this->w.pose(this->sensor).position, at) << "it stands still";
  ASSERT_TRUE(this->w.destroy(mark));
  this->w.step();
  EXPECT_EQ(this->ended(), 1u);
  ASSERT_TRUE(this->w.destroy(this->sensor));
  const BodyId other = this->flier();
  this->mark({1, 4, 0});
  this->w.step();
  ASSERT_EQ(this->begun(), 1u);
  ASSERT_TRUE(this->w.destroy(this->sensor));
  EXPECT_EQ(this->w.find(this->mount), nullptr);
  this->w.step();
  EXPECT_EQ(this->ended(), 1u);
  EXPECT_TRUE(this->w.contains(other));
}

TYPED_TEST(SensorMounts, are_taken_off_by_removing_the_record) {
  this->begin(0);
  const BodyId body = this->flier();
  run(this->w, 8);
  ASSERT_TRUE(this->w.remove(this->mount));
  const auto at = this->w.pose(this->sensor).position;
  run(this->w, 8);
  EXPECT_EQ(this->w.pose(this->sensor).position, at);
  EXPECT_GT(this->w.pose(body).position.x, at.x - num<TypeParam>(1));
  EXPECT_TRUE(this->w.set_pose(this->sensor, this->w.pose(body)));
}

}  // namespace sensor_mounts_test
}  // namespace isostep::test
