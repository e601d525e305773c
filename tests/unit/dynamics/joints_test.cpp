// Joints of each kind against closed forms: pendulums, springs, motors, limits.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "isostep/dynamics/joints/symmetric_factors.hpp"
#include "unit/dynamics/joint_world.hpp"
#include "unit/dynamics/scalar_name.hpp"

namespace isostep {
namespace joints_test {

template <class S> class Joints : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Joints, Scalars, ScalarName);

// ---- the small solver

TYPED_TEST(Joints, InverseOfASymmetricMatrixAgreesWithEigen) {
  using S = TypeParam;
  std::mt19937 random(7);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (int i = 0; i < 500; ++i) {
    Eigen::Matrix3d a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = draw();
    const double floor = i % 2 == 0 ? 0.5 : 0.02;  // smallest eigenvalue at least this
    const Eigen::Matrix3d wanted = 0.3 * a * a.transpose() + floor * Eigen::Matrix3d::Identity();
    Mat3<S> m;
    Eigen::Matrix3d given;
    for (int r = 0; r < 3; ++r) m.rows[r] = JointWorld<S>::vector({wanted(r, 0), wanted(r, 1), wanted(r, 2)});
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) given(r, c) = to_double(m.rows[r][c]);
    }
    const Eigen::Matrix3d oracle = (given + 0.001953125 * Eigen::Matrix3d::Identity()).inverse();
    const Mat3<S> inverse = invert_symmetric(m, S(0.001953125));
    // Errors grow with the square of the inverse: a rounding of m by u moves m^-1 by |m^-1|^2 u.
    const double bound = 32 * to_double(resolution<S>()) * (1 + oracle.norm() * oracle.norm());
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(to_double(inverse.rows[r][c]), oracle(r, c), bound);
    }
  }
}

/// What elimination subtracts, b^T m^-1 b, where b is small along what m hardly moves. By the inverse of m it is wrong
/// by a hundred times as much in Q16.16, by ten thousand times in float.
TYPED_TEST(Joints, FactorsSubtractNoMoreThanABlockHoldsHoweverSoftItIs) {
  using S = TypeParam;
  std::mt19937 random(11);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  const double soft = std::max(0x1p-12, 256 * to_double(resolution<S>()));  // its smallest eigenvalue
  for (int i = 0; i < 500; ++i) {
    Eigen::Matrix3d a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = draw();
    const Eigen::Matrix3d axes = Eigen::HouseholderQR<Eigen::Matrix3d>(a).householderQ();
    const Eigen::Matrix3d wanted = axes * Eigen::Vector3d(16, 1, soft).asDiagonal() * axes.transpose();
    const Eigen::Vector3d x(draw(), draw(), draw()), b = wanted * x;
    Mat3<S> m, columns = Mat3<S>::diagonal(Vec3<S>::zero());
    for (int r = 0; r < 3; ++r) m.rows[r] = JointWorld<S>::vector({wanted(r, 0), wanted(r, 1), wanted(r, 2)});
    const Vec3<S> column = JointWorld<S>::vector({b(0), b(1), b(2)});
    for (int r = 0; r < 3; ++r) columns.rows[r].x = column[r];
    const Mat3<S> solved = factor_symmetric(m, S(0)).solve(columns);
    double left = b.dot(x);
    for (int r = 0; r < 3; ++r) left -= b(r) * to_double(solved.rows[r].x);
    EXPECT_NEAR(left, 0, 64 * to_double(resolution<S>()) * (1 + x.squaredNorm())) << i;
    EXPECT_EQ(solved.rows[0].y, S(0));
  }
}

TYPED_TEST(Joints, InverseOfZeroMovesNothingByMoreThanItsSoftness) {
  using S = TypeParam;
  const Mat3<S> inverse = invert_symmetric(Mat3<S>::diagonal({S(1), S(0), S(0)}), S(0.25));
  EXPECT_NEAR(to_double(inverse.rows[0].x), 0.8, 1e-4);
  EXPECT_EQ(to_double(inverse.rows[1].y), 4);
  EXPECT_EQ(to_double(inverse.rows[2].z), 4);
  EXPECT_EQ(to_double(inverse.rows[0].y), 0);
}

// ---- ball

/// Time of the last of `swings` full swings from rest, by the zeros of x.
template <class S> double period_of(JointWorld<S>& world, std::uint32_t bob, int swings) {
  double last = to_double(world.states[bob].centre.x), first_zero = 0;
  int zeros = 0;
  for (int frame = 1; frame < 4000; ++frame) {
    world.step();
    const double x = to_double(world.states[bob].centre.x);
    if (last > 0 && x <= 0) {
      const double at = (frame - x / (x - last)) / 60;
      if (zeros == 0) first_zero = at;
      if (zeros == swings) return (at - first_zero) / swings;
      ++zeros;
    }
    last = x;
  }
  return 0;
}
/// Source: the period's series in the amplitude.
double swing_factor(double amplitude) {
  const double a = amplitude * amplitude;
  return 1 + a / 16 + 11 * a * a / 3072;
}

TYPED_TEST(Joints, BallPendulumHasThePeriodOfAPhysicalPendulum) {
  using S = TypeParam;
  JointWorld<S> world;
  const double length = 1.5, amplitude = 0.4, inertia = 0.4 * 0.2 * 0.2;
  const std::uint32_t bob =
      world.add_body({length * std::sin(amplitude), -length * std::cos(amplitude), 0}, 2, {inertia, inertia, inertia});
  world.join(JointType::ball, kNoBody, bob, {0, 0, 0});
  const double period = 2 * kPi * std::sqrt((inertia + length * length) / (10 * length)) * swing_factor(amplitude);
  EXPECT_NEAR(period_of(world, bob, 4), period, tolerance<S>(0.005, 0.01) * period);
  EXPECT_LT(world.worst_separation(), tolerance<S>(1e-4, 5e-4));
}

TYPED_TEST(Joints, ConicalPendulumTurnsAtTheAngleOfItsSpeed) {
  using S = TypeParam;
  JointWorld<S> world;
  const double length = 1.5, angle = 0.6, inertia = 1e-2;
  const double turn = std::sqrt(10 / (length * std::cos(angle)));
  const std::uint32_t bob =
      world.add_body({length * std::sin(angle), -length * std::cos(angle), 0}, 1, {inertia, inertia, inertia});
  JointProperties<S>& rod = world.join(JointType::distance, kNoBody, bob, {0, 0, 0});
  rod.frame_b.position = Vec3<S>::zero();
  rod.lower = rod.upper = S(1.5);
  world.states[bob].velocity = JointWorld<S>::velocity({0, 0, turn * length * std::sin(angle)});
  for (int frame = 0; frame < 300; ++frame) {
    world.step();
    EXPECT_NEAR(to_double(world.states[bob].centre.y), -length * std::cos(angle), 0.03);
    EXPECT_NEAR(norm(world.between(0)), 1.5, tolerance<S>(1e-3, 2e-3));
  }
}

TYPED_TEST(Joints, ConeAndTwistLimitsAreNotPassed) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t arm = world.add_box({0, 0, 0.5}, 1, {0.1, 0.1, 0.5});
  JointProperties<S>& ball = world.join(JointType::ball, kNoBody, arm, {0, 0, 0});
  ball.flags = joint_flag::kCone | joint_flag::kLimit;
  ball.cone = S(0.5);
  ball.lower = S(-0.25);
  ball.upper = S(0.25);
  world.states[arm].angular_velocity = JointWorld<S>::velocity({0, 0, 3});
  double swing = 0, twist = 0;
  for (int frame = 0; frame < 240; ++frame) {
    world.step();
    swing = std::acos(std::min(1.0, world.axis(arm, 2).z));
    const Quat<Unit<S>> q = world.states[arm].orientation;
    twist = 2 * std::atan2(to_double(q.z), to_double(q.w));
    EXPECT_LT(swing, 0.51);
    EXPECT_LT(std::abs(twist), 0.27);
  }
  EXPECT_NEAR(swing, 0.5, 0.01);  // gravity holds it there
}

// ---- hinge

TYPED_TEST(Joints, HingeKeepsItsAxisUnderLoadAcrossIt) {
  using S = TypeParam;
  JointWorld<S> world;
  world.gravity = {3, -10, 4};
  const std::uint32_t door = world.add_box({0.5, 0, 0}, 3, {0.5, 1, 0.05});
  JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, door, {0, 0.3, 0});
  hinge.frame_a.orientation = hinge.frame_b.orientation =
      rotation<S>({Unit<S>(1), Unit<S>(0), Unit<S>(0)}, S(-kPi / 2));
  world.states[door].angular_velocity = JointWorld<S>::velocity({0, 4, 0});
  double turned = 0;
  for (int frame = 0; frame < 240; ++frame) {
    world.step();
    EXPECT_GT(world.axis(door, 1).y, std::cos(tolerance<S>(0.002, 0.004)));
    EXPECT_LT(world.worst_separation(), tolerance<S>(3e-4, 6e-4));
    turned = std::max(turned, std::abs(world.axis(door, 0).z));
  }
  EXPECT_GT(turned, 0.9);  // and it does swing
}

TYPED_TEST(Joints, HingePendulumHasThePeriodOfAPhysicalPendulum) {
  using S = TypeParam;
  JointWorld<S> world;
  const double amplitude = 0.3, half = 0.5;
  const std::uint32_t bar = world.add_box({0, -half, 0}, 1, {0.05, half, 0.05});
  world.join(JointType::hinge, kNoBody, bar, {0, 0, 0});
  world.states[bar].orientation = rotation<S>({Unit<S>(0), Unit<S>(0), Unit<S>(1)}, JointWorld<S>::number(amplitude));
  world.states[bar].centre = JointWorld<S>::vector({half * std::sin(amplitude), -half * std::cos(amplitude), 0});
  const double inertia = (0.05 * 0.05 + half * half) / 3 + half * half;
  const double period = 2 * kPi * std::sqrt(inertia / (10 * half)) * swing_factor(amplitude);
  EXPECT_NEAR(period_of(world, bar, 4), period, tolerance<S>(0.005, 0.01) * period);
}

TYPED_TEST(Joints, HingeLimitStopsAFallingBarAndHoldsIt) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t bar = world.add_box({0.5, 0, 0}, 1, {0.5, 0.05, 0.05});
  JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, bar, {0, 0, 0});
  hinge.flags = joint_flag::kLimit;
  hinge.lower = S(-0.75);
  hinge.upper = S(0.5);
  double angle = 0, lowest = 0;
  for (int frame = 0; frame < 240; ++frame) {
    world.step();
    const D3 x = world.axis(bar, 0);
    angle = std::atan2(x.y, x.x);
    lowest = std::min(lowest, angle);
  }
  EXPECT_GT(lowest, -0.76);
  EXPECT_NEAR(angle, -0.75, 0.004);
  EXPECT_LT(norm(JointWorld<S>::wide_of(world.states[bar].angular_velocity)), 1e-2);
}

TYPED_TEST(Joints, MotorGathersSpeedByItsTorqueAndThenKeepsIt) {
  using S = TypeParam;
  JointWorld<S> world;
  world.gravity = {0, 0, 0};
  const std::uint32_t bar = world.add_box({0.5, 0, 0}, 2, {0.5, 0.1, 0.1});
  JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, bar, {0, 0, 0});
  hinge.flags = joint_flag::kMotor;
  hinge.motor_speed = S(4);
  hinge.max_force = S(1.5);
  const double inertia = 2 * ((0.25 + 0.01) / 3 + 0.25);  // about the hinge
  for (int frame = 0; frame < 30; ++frame) world.step();
  EXPECT_NEAR(to_double(world.states[bar].angular_velocity.z), 1.5 / inertia * 0.5, 0.02);
  for (int frame = 0; frame < 90; ++frame) world.step();
  EXPECT_NEAR(to_double(world.states[bar].angular_velocity.z), 4, tolerance<S>(5e-3, 1e-2));
}

TYPED_TEST(Joints, MotorTooWeakForTheLoadLetsItFall) {
  using S = TypeParam;
  for (const double torque : {4.0, 6.0}) {  // the bar's weight asks for 1 * 10 * 0.5 = 5 N m
    JointWorld<S> world;
    const std::uint32_t bar = world.add_box({0.5, 0, 0}, 1, {0.5, 0.05, 0.05});
    JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, bar, {0, 0, 0});
    hinge.flags = joint_flag::kMotor;
    hinge.max_force = JointWorld<S>::number(torque);
    for (int frame = 0; frame < 60; ++frame) world.step();
    if (torque < 5) {
      EXPECT_LT(world.axis(bar, 0).y, -0.5);
    } else {
      EXPECT_NEAR(world.axis(bar, 0).y, 0, 0.005);
    }
  }
}

TYPED_TEST(Joints, HingeSpringSwingsAtItsFrequency) {
  using S = TypeParam;
  JointWorld<S> world;
  world.gravity = {0, 0, 0};
  const std::uint32_t bar = world.add_box({0, -0.5, 0}, 1, {0.05, 0.5, 0.05});
  JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, bar, {0, 0, 0});
  hinge.flags = joint_flag::kSpring;
  hinge.spring_frequency = S(2);
  hinge.spring_damping = S(0);
  hinge.spring_target = S(0);
  world.states[bar].orientation = rotation<S>({Unit<S>(0), Unit<S>(0), Unit<S>(1)}, S(0.2));
  world.states[bar].centre = JointWorld<S>::vector({0.5 * std::sin(0.2), -0.5 * std::cos(0.2), 0});
  EXPECT_NEAR(period_of(world, bar, 3), 0.5, 0.01);
}

// ---- fixed

TYPED_TEST(Joints, WeldedBoxesTumbleAsOne) {
  using S = TypeParam;
  JointWorld<S> world;
  world.gravity = {0, 0, 0};
  const std::uint32_t a = world.add_box({-0.5, 0, 0}, 1, {0.5, 0.3, 0.2});
  const std::uint32_t b = world.add_box({0.5, 0, 0}, 4, {0.5, 0.3, 0.2});
  world.join(JointType::fixed, a, b, {0, 0.1, 0});
  world.states[a].velocity = JointWorld<S>::velocity({0, 1.5, 0});
  world.states[b].angular_velocity = JointWorld<S>::velocity({1, 2, 3});
  for (int frame = 0; frame < 240; ++frame) {
    world.step();
    EXPECT_LT(world.worst_separation(), tolerance<S>(1e-3, 2e-3));
    for (int i = 0; i < 3; ++i) EXPECT_LT(norm(world.axis(a, i) - world.axis(b, i)), tolerance<S>(2e-3, 4e-3));
  }
  EXPECT_GT(norm(JointWorld<S>::wide_of(world.states[a].angular_velocity)), 0.5);
}

TYPED_TEST(Joints, CantileverOfEightWeldedBoxesStaysStraight) {
  using S = TypeParam;
  JointWorld<S> world;
  std::uint32_t last = kNoBody;
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t box = world.add_box({0.25 + 0.5 * i, 0, 0}, 1, {0.25, 0.1, 0.1});
    world.join(JointType::fixed, last, box, {0.5 * i, 0, 0});
    last = box;
  }
  for (int frame = 0; frame < 120; ++frame) world.step();
  EXPECT_NEAR(world.centre(last).y, 0, tolerance<S>(2e-3, 0.3));
}

// ---- distance

TYPED_TEST(Joints, RopeHoldsAtItsLengthAndNotBefore) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t weight = world.add_box({0, -0.5, 0}, 5, {0.2, 0.2, 0.2});
  JointProperties<S>& rope = world.join(JointType::distance, kNoBody, weight, {0, 0, 0});
  rope.frame_b.position = Vec3<S>::zero();
  rope.upper = S(2);
  for (int frame = 0; frame < 20; ++frame) world.step();
  EXPECT_NEAR(world.centre(weight).y, -0.5 - 5 * (1 / 9.0), 0.05);  // falls freely for a third of a second
  double longest = 0;
  for (int frame = 0; frame < 200; ++frame) {
    world.step();
    longest = std::max(longest, norm(world.between(0)));
  }
  EXPECT_LT(longest, 2.005);
  EXPECT_NEAR(norm(world.between(0)), 2, 0.002);
}

TYPED_TEST(Joints, SpringHangsAtGravityOverItsFrequencySquared) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t weight = world.add_box({0, -1, 0}, 3, {0.2, 0.2, 0.2});
  JointProperties<S>& spring = world.join(JointType::distance, kNoBody, weight, {0, 0, 0});
  spring.frame_b.position = Vec3<S>::zero();
  spring.flags = joint_flag::kSpring;
  spring.spring_target = S(1);
  spring.spring_frequency = S(1);
  spring.spring_damping = S(0.5);
  double deepest = 0;
  for (int frame = 0; frame < 600; ++frame) {
    world.step();
    deepest = std::max(deepest, norm(world.between(0)) - 1);
  }
  const double stretch = 10 / (4 * kPi * kPi);
  EXPECT_NEAR(norm(world.between(0)) - 1, stretch, 0.01 * stretch);
  // The step response of a damping ratio of one half overshoots by exp(-pi / sqrt(3)).
  EXPECT_NEAR(deepest / stretch, 1 + std::exp(-kPi / std::sqrt(3.0)), 0.05);
}

// ---- what is stored

TYPED_TEST(Joints, AJointThatHangsStillKeepsItsLoadAsImpulse) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t weight = world.add_box({0, -1, 0}, 3, {0.2, 0.2, 0.2});
  world.join(JointType::ball, kNoBody, weight, {0, 0, 0});
  for (int frame = 0; frame < 10; ++frame) world.step();
  EXPECT_NEAR(to_double(world.impulses[0].point.y), 10.0 / 240, 1e-4);  // weight h over the reduced mass
  EXPECT_NEAR(to_double(world.impulses[0].point.x), 0, 1e-5);
}

TYPED_TEST(Joints, WhatHangsOnAKinematicBodyFollowsIt) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t carrier = world.add_body({0, 2, 0}, 0, {0, 0, 0});
  const std::uint32_t box = world.add_box({0.5, 2, 0}, 2, {0.25, 0.25, 0.25});
  world.join(JointType::fixed, box, carrier, {0.25, 2, 0});
  world.states[carrier].velocity = JointWorld<S>::velocity({1, 0, 0.5});
  for (int frame = 0; frame < 120; ++frame) world.step();
  EXPECT_NEAR(world.centre(carrier).x, 2, 0.002);
  EXPECT_NEAR(world.centre(box).x, 2.5, 0.004);
  EXPECT_NEAR(world.centre(box).y, 2, 0.002);
  EXPECT_NEAR(world.centre(box).z, 1, 0.004);
}

TYPED_TEST(Joints, JointsBetweenThingsThatDoNotMoveAreIdle) {
  using S = TypeParam;
  JointWorld<S> world;
  world.add_body({1, 0, 0}, 0, {0, 0, 0});
  world.join(JointType::fixed, kNoBody, 0, {0, 0, 0});
  world.states[0].centre.y = S(1);
  for (int frame = 0; frame < 10; ++frame) world.step();
  EXPECT_EQ(world.centre(0).y, 1);
  EXPECT_EQ(to_double(world.impulses[0].point.y), 0);
}

}  // namespace joints_test
}  // namespace isostep
