// Laws of bodies that are disabled and come back: nothing of theirs acts until then.
// SPDX-License-Identifier: MIT

#include "laws/body_changes.hpp"

namespace isostep::test {
namespace disabled_bodies_test {

template <class S> class DisabledBodies : public BodyChanges<S> {};
TYPED_TEST_SUITE(DisabledBodies, AllScalars);

TYPED_TEST(DisabledBodies, a_disabled_body_takes_no_part_and_comes_back_as_it_was) {
  using S = TypeParam;
  add_ground(this->w);
  BodyDefinition<S> d = moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {0, 4, 0}, {1, 0, 0});
  const BodyId body = this->w.create(d);
  run(this->w, 6);
  const Pose<S> pose = this->w.pose(body);
  const Vec3<S> velocity = this->w.velocity(body);
  ASSERT_TRUE(this->w.set_enabled(body, false)) << describe(this->w.fault());
  EXPECT_FALSE(this->w.is_enabled(body));
  EXPECT_FALSE(this->w.is_awake(body));
  EXPECT_FALSE(this->w.cast_ray(vec<S>(0.1, 10, 0), vec<S>(0, -8, 0)));
  EXPECT_FALSE(this->w.apply_impulse(body, vec<S>(1, 0, 0)));
  EXPECT_STREQ(this->w.fault().expected, "one that is enabled");
  run(this->w, 30);
  EXPECT_EQ(this->w.pose(body).position, pose.position);
  EXPECT_EQ(this->w.velocity(body), velocity);
  ASSERT_TRUE(this->w.set_enabled(body, true));
  EXPECT_TRUE(this->w.cast_ray(vec<S>(0.1, 10, 0), vec<S>(0, -8, 0)));
  EXPECT_TRUE(settle(this->w));
  EXPECT_NEAR(this->at(body).y, 0.5, 0.01);
  EXPECT_GT(this->at(body).x, 0.1);
}

/// A world in which it was never made, but for the bits of its slot.
TYPED_TEST(DisabledBodies, what_lay_on_a_disabled_body_falls_as_if_it_were_gone) {
  using S = TypeParam;
  World<S> other(settings<S>());
  for (World<S>* world : {&this->w, &other}) {
    add_ground(*world);
    const ShapeId cube = add_box(*world, 0.5, 0.5, 0.5);
    for (int i = 0; i < 3; ++i) world->create(moving<S>(cube, {0, 0.5 + i, 0}));
    ASSERT_TRUE(settle(*world));
  }
  const BodyId below = this->w.bodies()[1], above = this->w.bodies()[3];
  ASSERT_TRUE(this->w.set_enabled(below, false));
  ASSERT_TRUE(other.destroy(below));
  EXPECT_TRUE(this->w.is_awake(above));
  for (int i = 0; i < 120; ++i) {
    this->w.step();
    other.step();
    ASSERT_EQ(this->w.pose(above).position, other.pose(above).position) << i;
    ASSERT_EQ(this->w.events().contact_begin.size(), other.events().contact_begin.size()) << i;
    ASSERT_EQ(this->w.events().contact_end.size(), other.events().contact_end.size()) << i;
  }
}

TYPED_TEST(DisabledBodies, a_sensor_sees_who_is_disabled_leave_and_who_is_enabled_come) {
  using S = TypeParam;
  BodyDefinition<S> d = still<S>(add_box(this->w, 4, 4, 4));
  d.sensor = true;
  this->w.create(d);
  BodyDefinition<S> floating = moving<S>(add_ball(this->w, 0.5), {0, 0, 0});
  floating.gravity_scale = S(0);
  const BodyId body = this->w.create(floating);
  this->w.step();
  ASSERT_EQ(this->w.events().sensor_begin.size(), 1u);
  this->w.set_enabled(body, false);
  this->w.step();
  EXPECT_EQ(this->w.events().sensor_end.size(), 1u);
  this->w.set_enabled(body, true);
  this->w.step();
  EXPECT_EQ(this->w.events().sensor_begin.size(), 1u);
}

TYPED_TEST(DisabledBodies, joints_of_a_disabled_body_hold_nothing_until_it_is_back) {
  using S = TypeParam;
  const BodyId hook = this->w.create(still<S>(add_ball(this->w, 0.25), {0, 4, 0}));
  const BodyId low = this->box({0, 2, 0}, {0.25, 0.25, 0.25});
  const Pose<S> frame = {vec<S>(0, 4, 0), Quat<Unit<S>>::identity()};
  const JointId joint = this->w.create(this->w.joint_at(JointType::ball, hook, low, frame));
  ASSERT_TRUE(joint);
  run(this->w, 30);
  EXPECT_NEAR(this->at(low).y, 2, 0.01);
  this->w.set_enabled(hook, false);
  run(this->w, 12);
  EXPECT_NEAR(this->at(low).y, 2 - 0.5 * 10 * 0.04, 0.05) << "free fall";
  this->w.set_enabled(hook, true);
  run(this->w, 120);
  EXPECT_NEAR(this->at(low).y, 2, 0.05);
  this->w.set_enabled(low, false);
  this->w.set_enabled(hook, false);
  run(this->w, 10);
  EXPECT_TRUE(this->w.contains(joint));
  ASSERT_TRUE(this->w.destroy(hook));
  EXPECT_FALSE(this->w.contains(joint));
}

/// Two wheels geared to each other and a bob on a spring, each of which comes and goes while the others sleep or not.
TYPED_TEST(DisabledBodies, couplings_and_springs_of_disabled_bodies_hold_nothing_and_are_state) {
  using S = TypeParam;
  BodyId wheels[2];
  JointId hinges[2];
  for (int i = 0; i < 2; ++i) {
    const double x = 2.0 * i;
    wheels[i] = this->box({x, 4, 0}, {0.5, 0.5, 0.125});
    const Pose<S> axle = {vec<S>(x, 4, 0), Quat<Unit<S>>::identity()};
    hinges[i] = this->w.create(this->w.joint_at(JointType::hinge, {}, wheels[i], axle));
  }
  Coupling<S> gear;
  gear.joint_a = hinges[0];
  gear.joint_b = hinges[1];
  gear.ratio_a = S(1);
  gear.ratio_b = S(2);
  ASSERT_TRUE(this->w.add(gear)) << describe(this->w.fault());
  const BodyId bob = this->box({-4, 2, 0}, {0.25, 0.25, 0.25});
  BodySpring<S> spring;
  spring.a = bob;
  spring.b = wheels[0];
  spring.rest_length = S(4);
  spring.stiffness = S(1);
  ASSERT_TRUE(this->w.add(spring)) << describe(this->w.fault());
  ASSERT_TRUE(this->w.set_enabled(wheels[1], false));
  this->w.apply_impulse(wheels[0], Vec3<S>::zero(), vec<S>(0, 0, 0.25));
  run(this->w, 10);
  EXPECT_GT(to_double(this->w.angular_velocity(wheels[0]).z), 0.5) << "nothing gears it";
  EXPECT_EQ(this->w.pose(wheels[1]).orientation, Quat<Unit<S>>::identity());
  expect_exact_rollback(this->w, 160, [&](World<S>& world, int i) {
    if (i % 20 == 5) world.set_enabled(wheels[1], i % 40 == 5);
    if (i % 30 == 12) world.sleep(wheels[0]);
    if (i % 50 == 9) world.set_enabled(bob, i % 100 == 59);
    if (i % 70 == 30) world.set_enabled(wheels[0], false);
    if (i % 70 == 45) world.set_enabled(wheels[0], true);
    if (i == 100) world.set_type(wheels[0], BodyType::static_);
  });
  EXPECT_EQ(this->w.type(wheels[0]), BodyType::static_);
  EXPECT_FALSE(this->w.set_type(bob, BodyType::static_)) << "its spring would tie nothing that moves";
  EXPECT_STREQ(this->w.fault().field, "type");
}

}  // namespace disabled_bodies_test
}  // namespace isostep::test
