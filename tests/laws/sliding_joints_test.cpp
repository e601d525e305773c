// Laws of joints along which bodies slide - sliders, cylindrical, planar joints - and of one that holds angles alone.
// SPDX-License-Identifier: MIT

#include "random/joint_angles.hpp"

namespace isostep::test {
namespace sliding_joints_test {

const D3 kX = {1, 0, 0};

template <class S> class SlidingJoints : public ::testing::Test {
 protected:
  /// A frame whose z leans by `angle` from the horizontal x to y, and whose x is the world's z.
  static Quat<Unit<S>> leaning(double angle) {
    return normalise(turn<S>({0, 0, 1}, angle) * turn<S>({0, 1, 0}, kPi / 2));
  }
  JointId slide(JointType type, BodyId a, BodyId b, D3 at, double angle, const JointProperties<S>& settings = {}) {
    JointProperties<S> joint = w.joint_at(type, a, b, {vec<S>(at), leaning(angle)});
    joint.take_settings(settings);
    const JointId id = w.create(joint);
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  BodyId block(D3 at, double mass = 2) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.25), at);
    d.mass = num<S>(mass);
    return w.create(d);
  }
  D3 place(BodyId id) { return real(w.center_of_mass(id)); }
  D3 speed(BodyId id) { return real(w.velocity(id)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(SlidingJoints, AllScalars);

TYPED_TEST(SlidingJoints, a_slider_on_a_slope_falls_by_the_part_of_gravity_along_it) {
  using S = TypeParam;
  const double angle = -0.5, seconds = 1;
  const BodyId block = this->block({0, 5, 0});
  const JointId joint = this->slide(JointType::slider, {}, block, {0, 5.25, 0.25}, angle);
  run(this->w, 60);
  const double way = 0.5 * 10 * std::sin(-angle) * seconds * seconds;
  const D3 at = this->place(block);
  EXPECT_NEAR(length(at - D3{0, 5, 0}), way, 0.02 * way);
  EXPECT_NEAR(at.y - 5, at.x * std::tan(angle), pick<S>(1e-3, 1e-4, 1e-2, 1e-4));
  EXPECT_LT(to_double(this->w.joint_error(joint)), pick<S>(1e-3, 1e-4, 1e-2, 1e-4));
  EXPECT_LT(length(real(this->w.angular_velocity(block))), pick<S>(1e-3, 1e-6, 1e-2, 1e-5));
}

TYPED_TEST(SlidingJoints, limits_hold_what_slides_and_nothing_bounces) {
  using S = TypeParam;
  JointProperties<S> limits;
  limits.flags = joint_flag::kLimit;
  limits.lower = S(-1);
  limits.upper = S(1);
  for (const JointType type : {JointType::slider, JointType::cylindrical}) {
    const BodyId block = this->block({type == JointType::slider ? 0.0 : 4.0, 5, 0});
    this->slide(type, {}, block, this->place(block), kPi / 2, limits);
  }
  run(this->w, 180);
  for (const BodyId id : this->w.bodies()) {
    EXPECT_NEAR(this->place(id).y, 4, pick<S>(2e-3, 2e-3, 5e-3, 2e-3));
    EXPECT_NEAR(this->speed(id).y, 0, 1e-2);
  }
}

TYPED_TEST(SlidingJoints, a_motor_lifts_what_it_can_and_slips_under_more) {
  using S = TypeParam;
  JointProperties<S> motor;
  motor.flags = joint_flag::kMotor;
  motor.motor_speed = S(2);
  motor.max_force = S(30);  // 20 N is the weight
  const BodyId light = this->block({0, 5, 0}, 2), heavy = this->block({4, 25, 0}, 4);
  this->slide(JointType::slider, {}, light, {0, 5, 0}, kPi / 2, motor);
  this->slide(JointType::slider, {}, heavy, {4, 25, 0}, kPi / 2, motor);
  run(this->w, 60);
  EXPECT_NEAR(this->speed(light).y, 2, 0.02);
  EXPECT_NEAR(this->speed(heavy).y, -2.5, 0.05);  // (30 - 40) / 4 for a second
}

TYPED_TEST(SlidingJoints, a_spring_along_the_way_carries_its_load_where_hooke_says) {
  using S = TypeParam;
  JointProperties<S> spring;
  spring.flags = joint_flag::kSpring;
  spring.spring_frequency = S(1);
  spring.spring_damping = S(1);
  const BodyId block = this->block({0, 5, 0});
  this->slide(JointType::slider, {}, block, {0, 5, 0}, kPi / 2, spring);
  run(this->w, 300);
  EXPECT_NEAR(this->place(block).y, 5 - 10 / (4 * kPi * kPi), 0.01);
}

TYPED_TEST(SlidingJoints, what_slides_in_a_sleeve_keeps_its_spin) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 5, 0});
  d.angular_velocity = vec<S>(0, 8, 0);
  const BodyId bolt = this->w.create(d);
  const JointId joint = this->slide(JointType::cylindrical, {}, bolt, {0, 5, 0}, kPi / 2);
  run(this->w, 60);
  EXPECT_NEAR(real(this->w.angular_velocity(bolt)).y, 8, 0.02);
  EXPECT_NEAR(this->speed(bolt).y, -10, 0.05);
  EXPECT_LT(to_double(this->w.joint_error(joint)), pick<S>(1e-3, 1e-4, 1e-2, 1e-4));
}

TYPED_TEST(SlidingJoints, a_puck_stays_in_its_plane_and_keeps_its_course) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(add_box(this->w, 0.5, 0.25, 0.5), {0, 5, 0}, {1, 0, 0.5});
  d.angular_velocity = vec<S>(0, 3, 0);
  const BodyId puck = this->w.create(d);
  // z of the frame is up.
  const JointId joint = this->slide(JointType::planar, {}, puck, {0, 5, 0}, kPi / 2);
  run(this->w, 120);
  expect_near(this->place(puck), {2, 5, 1}, pick<S>(0.01, 0.01, 0.03, 0.01));
  EXPECT_NEAR(real(this->w.angular_velocity(puck)).y, 3, 0.02);
  EXPECT_LT(to_double(this->w.joint_error(joint)), pick<S>(1e-3, 1e-4, 1e-2, 1e-4));
}

TYPED_TEST(SlidingJoints, an_angular_joint_holds_the_attitude_of_what_falls) {
  using S = TypeParam;
  const BodyId block = this->block({0, 50, 0});
  this->slide(JointType::angular, {}, block, {0, 50, 0}, 0.3);
  for (int i = 0; i < 60; ++i) {
    this->w.apply_force_at(block, vec<S>(0, 0, 5), vec<S>(this->place(block) + D3{0.5, 0, 0}));
    ASSERT_TRUE(this->w.step().clean());
  }
  EXPECT_LT(length(real(this->w.angular_velocity(block))), 1e-2);
  expect_near(rotated<S>(this->w.pose(block).orientation, kX), kX, 5e-3);
  EXPECT_NEAR(this->speed(block).z, 2.5, 0.03);
  EXPECT_NEAR(this->speed(block).y, -10, 0.05);
}

/// Two bodies in space: what a slider's rows do to them keeps both momenta.
TYPED_TEST(SlidingJoints, two_bodies_on_a_slider_keep_their_momenta) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  BodyDefinition<S> d = moving<S>(add_box(this->w, 0.5, 0.25, 0.25), {0, 0, 0});
  d.collide = false;
  d.mass = S(2);
  const BodyId a = this->w.create(d);
  d.position = vec<S>(1, 0, 0);
  d.velocity = vec<S>(0.5, 0.5, 0);
  d.mass = S(1);
  const BodyId b = this->w.create(d);
  const JointId joint = this->slide(JointType::slider, a, b, {0.5, 0, 0}, 0);
  const auto angular = [&] {
    D3 sum = {0, 0, 0};
    for (const BodyId id : {a, b}) {
      const double mass = to_double(this->w.mass(id));
      const D3 kappa = real(this->w.view(id).properties->kappa), spin = real(this->w.angular_velocity(id));
      sum = sum + cross(this->place(id), this->speed(id)) * mass + D3{0, 0, mass * spin.z / kappa.z};
    }
    return sum;
  };
  const double before = angular().z;
  for (int i = 0; i < 120; ++i) ASSERT_TRUE(this->w.step().clean());
  const D3 momentum = this->speed(a) * 2.0 + this->speed(b) * 1.0;
  expect_near(momentum, {0.5, 0.5, 0}, pick<S>(1e-4, 1e-9, 1e-2, 1e-6));
  EXPECT_NEAR(angular().z, before, pick<S>(0.02, 0.02, 0.06, 0.02) * before);
  EXPECT_GT(length(this->place(b) - this->place(a)), 1.5);  // it slid
  EXPECT_LT(to_double(this->w.joint_error(joint)), pick<S>(5e-3, 5e-3, 2e-2, 5e-3));
}

}  // namespace sliding_joints_test
}  // namespace isostep::test
