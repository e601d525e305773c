// Laws of presets that are six-axis joints: motors and wheels, and the drives that they leave.
// SPDX-License-Identifier: MIT

#include <cmath>

#include "laws/six_axis.hpp"

namespace isostep::test {
namespace six_axis_presets_test {

template <class S> class SixAxisPresets : public SixAxis<S> {};
TYPED_TEST_SUITE(SixAxisPresets, AllScalars);

TYPED_TEST(SixAxisPresets, a_motor_joint_brings_a_body_to_where_its_frame_is) {
  using S = TypeParam;
  for (const SolverName solver : {SolverName::soft_step, SolverName::direct}) {
    World<S> w(this->with(solver, -10));
    const BodyId b = this->box(w, {1, 2, 0});
    MotorJoint<S> servos;
    servos.b = b;
    servos.frame_a = {vec<S>(D3{0, 4, 1}), turn<S>({0, 1, 0}, 0.75)};
    servos.frame_b = this->at({1, 2, 0});
    servos.place = {.frequency = S(2), .damping = S(1), .max_force = S(60)};
    servos.turn = {.frequency = S(2), .damping = S(1), .max_force = S(20)};
    ASSERT_TRUE(w.create(motor(servos))) << describe(w.fault());
    for (int i = 0; i < 240; ++i) ASSERT_TRUE(w.step().clean());
    const D3 place = real(w.pose(b).position);
    EXPECT_NEAR(place.x, 0, 0.01);
    EXPECT_NEAR(place.y, 4 - 10 / (16 * kPi * kPi), 0.01);
    EXPECT_NEAR(place.z, 1, 0.01);
    EXPECT_NEAR(to_double(w.pose(b).orientation.y), std::sin(0.375), 0.01);
  }
}

TYPED_TEST(SixAxisPresets, a_wheel_bears_steers_and_spins) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step, -10));
  const BodyId b = this->box(w, {0, 4, 0}, 4, 0.25, 0.25, 0.125);
  WheelJoint<S> of;
  of.b = b;
  of.frame = this->at({0, 4, 0});
  of.suspension = {.frequency = S(2), .damping = S(1)};
  of.travel = {num<S>(-0.25), num<S>(0.25)};
  of.steer = JointServo<S>{.frequency = S(4), .damping = S(1), .target = num<S>(0.5), .max_force = S(20)};
  of.drive = JointMotor<S>{.speed = S(3), .max_force = S(2)};
  const JointId joint = w.create(wheel(of));
  ASSERT_TRUE(joint) << describe(w.fault());
  for (int i = 0; i < 240; ++i) ASSERT_TRUE(w.step().clean());
  EXPECT_NEAR(to_double(w.joint_position(joint, JointAxis::y)), -10 / (16 * kPi * kPi), 0.005);
  EXPECT_NEAR(to_double(w.joint_position(joint, JointAxis::swing_y)), 0.5, 0.02);
  EXPECT_NEAR(length(real(w.angular_velocity(b))), 3, 0.05);
  EXPECT_LT(to_double(w.joint_error(joint)), 0.005);
}

TYPED_TEST(SixAxisPresets, the_drives_of_a_preset_are_found_and_changed) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  const BodyId axle = this->box(w, {0, 4, 0}, 4, 0.25, 0.25, 0.125), other = this->box(w, {3, 4, 0});
  const JointId joint = w.create(wheel<S>({.b = axle,
                                           .frame = this->at({0, 4, 0}),
                                           .suspension = {.frequency = S(2), .damping = S(1)},
                                           .drive = JointMotor<S>{.speed = S(3), .max_force = S(2)}}));
  const JointId hinged = w.create(hinge<S>({.b = other}));
  ASSERT_TRUE(joint);
  const AxisDriveId id = w.axis_drive(joint, JointAxis::twist);
  ASSERT_TRUE(id);
  EXPECT_FALSE(w.axis_drive(joint, JointAxis::swing_y)) << "it does not steer";
  EXPECT_FALSE(w.axis_drive(hinged, JointAxis::twist));
  EXPECT_FALSE(w.axis_drive({}, JointAxis::twist));
  AxisDrive<S> backwards = *w.find(id);
  backwards.motor_speed = S(-3);
  ASSERT_TRUE(w.set(id, backwards));
  for (int i = 0; i < 240; ++i) ASSERT_TRUE(w.step().clean());
  EXPECT_NEAR(to_double(w.angular_velocity(axle).z), -3, 0.05);
  ASSERT_TRUE(w.destroy(joint));
  EXPECT_FALSE(w.axis_drive(joint, JointAxis::twist));
}

TYPED_TEST(SixAxisPresets, a_wheel_rolls_forwards_at_a_positive_speed) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step, -10));
  ASSERT_TRUE(add_ground(w));
  const BodyId chassis = this->box(w, {0, 1, 0}, 8, 0.5, 0.125, 0.5);
  ASSERT_TRUE(w.set_motion(chassis, S(1), S(0), S(0), body_flag::kAngularLocks));
  const BodyId ball = w.create(moving<S>(add_ball(w, 0.25), {0, 0.25, 0}));
  // Forwards is x of the world: y is up, so z of the frame, to the left, is -z, and x to the rear is -x.
  const Pose<S> frame = {vec<S>(0, 0.25, 0), turn<S>({0, 1, 0}, kPi)};
  ASSERT_TRUE(w.create(wheel<S>({.a = chassis,
                                 .b = ball,
                                 .frame = frame,
                                 .suspension = {.frequency = S(4), .damping = S(1)},
                                 .drive = JointMotor<S>{.speed = S(4), .max_force = S(20)}})));
  for (int i = 0; i < 60; ++i) w.step();
  EXPECT_GT(to_double(w.velocity(ball).x), 0.5);
}

}  // namespace six_axis_presets_test
}  // namespace isostep::test
