// Laws of an articulation's joints: springs, dampers, motors, servos, limits; tops on balls and in flight.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/effects/articulations.hpp"

namespace isostep::test {
namespace articulation_joints_test {

constexpr double kPi = 3.14159265358979323846;

template <class S> class ArticulationJoints : public ::testing::Test {
 protected:
  /// A wheel of 2 kg m^2 on a hinge, without gravity.
  static ArticulationDefinition<S> wheel() {
    ArticulationDefinition<S> d;
    d.settings.gravity = Vec3<S>::zero();
    ArticulationLink<S> l;
    l.mass.inertia = vector<S>({1, 1, 2});
    d.links.push_back(l);
    return d;
  }
  static void set(Articulation<S>& a, double position, double speed = 0) {
    JointCoordinates<S> c;
    c.position.x = number<S>(position);
    c.velocity.x = number<S>(speed);
    EXPECT_TRUE(a.set_coordinates(0, c)) << describe(a.fault());
  }
  static double angle(const Articulation<S>& a) { return to_double(a.coordinates(0).position.x); }
  static double speed(const Articulation<S>& a) { return to_double(a.coordinates(0).velocity.x); }
  static void run(Articulation<S>& a, int steps) {
    for (int i = 0; i < steps; ++i) {
      const ArticulationReport report = a.step();
      ASSERT_EQ(report.clamped + report.lost, 0u);
    }
  }
};
TYPED_TEST_SUITE(ArticulationJoints, ArticulatedScalars);

TYPED_TEST(ArticulationJoints, a_spring_keeps_its_swing_for_a_minute) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].stiffness = number<S>(2 * 2 * 2 * kPi * kPi);  // 1 Hz
  Articulation<S> a = built(d);
  this->set(a, 0.5);
  this->run(a, 60 * 60);
  const double k = 8 * kPi * kPi, energy = k * 0.25 / 2;
  const double now = k * std::pow(this->angle(a), 2) / 2 + std::pow(this->speed(a), 2);
  EXPECT_NEAR(now, energy, 1e-3 * energy);
}

// No rate of sub-steps follows it: it holds the wheel, and does not ring.
TYPED_TEST(ArticulationJoints, a_spring_of_any_stiffness_comes_to_rest) {
  using S = TypeParam;
  for (const double stiffness : {1e4, 1e6, 1e8}) {
    ArticulationDefinition<S> d = this->wheel();
    d.links[0].stiffness = number<S>(stiffness);
    Articulation<S> a = built(d);
    this->set(a, 0, 5);
    double most = 0;
    for (int i = 0; i < 300; ++i) {
      this->run(a, 1);
      most = std::max(most, std::fabs(this->angle(a)));
    }
    EXPECT_LT(most, 1.01 * 5 * std::sqrt(2 / stiffness) + 5.0 / 480);
    if (stiffness > 1e6) {
      EXPECT_NEAR(this->speed(a), 0, 1e-3);
    }
  }
}

TYPED_TEST(ArticulationJoints, a_damper_brakes_as_the_exponential_function_says) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].damping = number<S>(1.0);
  Articulation<S> a = built(d);
  this->set(a, 0, 4);
  this->run(a, 120);
  EXPECT_NEAR(this->speed(a), 4 * std::exp(-0.5 * 2), 1e-4);
}

TYPED_TEST(ArticulationJoints, armature_resists_the_joint) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].armature = number<S>(3.0);
  Articulation<S> a = built(d);
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(a.apply_torque(0, vector<S>({0, 0, 10})));
    this->run(a, 1);
  }
  EXPECT_NEAR(this->speed(a), 2, 2e-5);
}

TYPED_TEST(ArticulationJoints, a_motor_speeds_up_by_its_torque_and_keeps_its_speed) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].drive.speed = vector<S>({6, 0, 0});
  d.links[0].drive.damping = number<S>(1e5);
  d.links[0].drive.max_force = number<S>(4.0);
  Articulation<S> a = built(d);
  this->run(a, 60);
  EXPECT_NEAR(this->speed(a), 2, 1e-4);
  double most = 0;
  for (int i = 0; i < 240; ++i) {
    this->run(a, 1);
    most = std::max(most, this->speed(a));
  }
  EXPECT_NEAR(this->speed(a), 6, 1e-3);
  EXPECT_LT(most, 6.001);
}

/// A 2 kg bar of 1 m, straight out.
template <class S> ArticulationDefinition<S> arm() {
  ArticulationDefinition<S> d;
  d.links.push_back(bar<S>(kArticulationBase, {0, 0, 0}, 1, 2));
  d.links[0].frame_a.orientation = turn_about<S>({0, 0, 1}, kPi / 2);
  return d;
}

TYPED_TEST(ArticulationJoints, a_servo_holds_an_arm_up_until_its_force_ends) {
  using S = TypeParam;
  for (const double most : {11.0, 9.0}) {  // the weight's torque is 10
    ArticulationDefinition<S> d = arm<S>();
    d.links[0].drive.stiffness = number<S>(1e4);
    d.links[0].drive.damping = number<S>(200);
    d.links[0].drive.max_force = number<S>(most);
    Articulation<S> a = built(d);
    double lowest = 0;
    for (int i = 0; i < 300; ++i) {
      this->run(a, 1);
      lowest = std::min(lowest, this->angle(a));
    }
    if (most < 10) {
      // It swings about where 10 cos(angle) is 9.
      EXPECT_LT(lowest, -std::acos(0.9));
      continue;
    }
    EXPECT_NEAR(this->angle(a), -1e-3, 2e-5);
    EXPECT_NEAR(to_double(a.joint_load(0).force.y), 20, 1e-2);
  }
}

TYPED_TEST(ArticulationJoints, what_falls_on_a_limit_stays_there) {
  using S = TypeParam;
  ArticulationDefinition<S> d = arm<S>();
  d.links[0].limited = true;
  d.links[0].lower = number<S>(-0.75);
  d.links[0].upper = number<S>(0.5);
  Articulation<S> a = built(d);
  this->set(a, 0.25);
  double least = 1, energy = motion_of(a).energy();
  for (int i = 0; i < 600; ++i) {
    const ArticulationReport report = a.step();
    least = std::min(least, this->angle(a));
    const double now = motion_of(a).energy();
    EXPECT_LT(now, energy + 2e-4);
    energy = std::min(energy, now);
    ASSERT_TRUE(i <= 60 || report.stopped == 1u);
  }
  EXPECT_GT(least, -0.75 - by_scalar<S>(1e-6, 1e-12, 1e-8));
  EXPECT_NEAR(this->angle(a), -0.75, by_scalar<S>(1e-5, 1e-9, 1e-7));
  EXPECT_NEAR(this->speed(a), 0, by_scalar<S>(1e-4, 1e-9, 1e-6));
  // Half of its weight and what the stop's torque bears.
  EXPECT_NEAR(to_double(a.joint_load(0).force.y), 20, 1e-2);
  EXPECT_NEAR(to_double(a.joint_load(0).torque.z), 10 * std::cos(0.75), 1e-2);
}

// Failure scenes 27 and 28: a motor into the stop gives no kick, and does not shiver.
TYPED_TEST(ArticulationJoints, a_strong_motor_against_a_limit_neither_passes_it_nor_shivers) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].limited = true;
  d.links[0].lower = S(0);
  d.links[0].upper = number<S>(1.5 * kPi);
  d.links[0].drive.speed = vector<S>({20, 0, 0});
  d.links[0].drive.damping = number<S>(1e6);
  d.links[0].drive.max_force = number<S>(1e6);
  Articulation<S> a = built(d);
  for (int i = 0; i < 3600; ++i) {
    this->run(a, 1);
    ASSERT_LT(this->angle(a), 1.5 * kPi + 1e-6);
    ASSERT_TRUE(i <= 30 || this->angle(a) > 1.5 * kPi - 1e-5);
  }
}

TYPED_TEST(ArticulationJoints, what_begins_beyond_a_limit_comes_back_slowly) {
  using S = TypeParam;
  ArticulationDefinition<S> d = this->wheel();
  d.links[0].limited = true;
  d.links[0].lower = number<S>(-0.5);
  d.links[0].upper = number<S>(0.5);
  Articulation<S> a = built(d);
  this->set(a, 1.5);
  double fastest = 0;
  for (int i = 0; i < 120; ++i) {
    this->run(a, 1);
    fastest = std::max(fastest, std::fabs(this->speed(a)));
  }
  EXPECT_LT(fastest, 2.001);
  EXPECT_LT(this->angle(a), 0.5 + 1e-6);
}

TYPED_TEST(ArticulationJoints, a_slider_falls_along_its_rail_onto_its_stop) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  ArticulationLink<S> l;
  l.type = ArticulationJoint::slider;
  l.axis = vector<Unit<S>>({0.6, -0.8, 0});
  l.mass.mass = number<S>(3);
  l.limited = true;
  l.lower = number<S>(-1);
  l.upper = number<S>(9);
  d.links.push_back(l);
  Articulation<S> a = built(d);
  this->run(a, 60);
  EXPECT_NEAR(this->angle(a), 4, 1e-4);
  this->run(a, 120);
  EXPECT_NEAR(this->angle(a), 9, 1e-5);
  EXPECT_NEAR(to_double(a.link_centre(0).x), 5.4, 1e-5);
}

/// A disc of 1 kg, 0.5 m from a ball at the origin, along local y.
template <class S> ArticulationDefinition<S> top() {
  ArticulationDefinition<S> d;
  ArticulationLink<S> l;
  l.type = ArticulationJoint::ball;
  l.mass.centre = vector<S>({0, 0.5, 0});
  l.mass.inertia = vector<S>({0.0625, 0.125, 0.0625});
  d.links.push_back(l);
  return d;
}

// O14: W = m g r / (I3 w3), fast limit; with the exact root of I1 cos W^2 - I3 w3 W + m g r = 0.
TYPED_TEST(ArticulationJoints, a_heavy_top_goes_round_in_its_time) {
  using S = TypeParam;
  Articulation<S> a = built(top<S>());
  const double tilt = 0.4, spin = 120, i1 = 0.0625 + 0.25, i3 = 0.125;
  const double b = i3 * spin, c = i1 * std::cos(tilt);
  const double rate = (b - std::sqrt(b * b - 4 * c * 5)) / (2 * c);
  JointCoordinates<S> start;
  start.rotation = turn_about<S>({0, 0, 1}, -tilt);
  const D3 axis = {std::sin(tilt), std::cos(tilt), 0};
  // w3 is the spin along the axis, the round's share in it.
  start.angular_velocity = vector<S>(axis * (spin - rate * std::cos(tilt)) + D3{0, rate, 0});
  ASSERT_TRUE(a.set_coordinates(0, start));
  const int steps = 600;
  double round = 0, before = 0, highest = 0;
  for (int i = 0; i < steps; ++i) {
    this->run(a, 1);
    const D3 at = doubles(a.link_centre(0));
    const double now = std::atan2(-at.z, at.x);
    round += std::remainder(now - before, 2 * kPi);
    before = now;
    highest = std::max(highest, std::fabs(at.y - 0.5 * std::cos(tilt)));
  }
  EXPECT_NEAR(round, rate * steps / 60, 0.01 * rate * steps / 60);
  EXPECT_LT(highest, 0.002);
}

// O13: I = (1, 2, 3), spin about the middle axis: flips at 2.633 + 5.266 k s; four in 20 s.
TYPED_TEST(ArticulationJoints, a_free_body_tumbles_with_its_momentum_and_energy) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  d.settings.gravity = Vec3<S>::zero();
  ArticulationLink<S> l;
  l.type = ArticulationJoint::free;
  l.mass.inertia = vector<S>({1, 2, 3});
  d.links.push_back(l);
  Articulation<S> a = built(d);
  JointCoordinates<S> start;
  start.angular_velocity = vector<S>({0.01, 5, 0});
  ASSERT_TRUE(a.set_coordinates(0, start));
  const Motion before = motion_of(a);
  double worst = 0, momentum = 0, first = 0;
  int flips = 0;
  bool up = true;
  for (int i = 1; i <= 1200; ++i) {
    this->run(a, 1);
    const Motion now = motion_of(a);
    worst = std::max(worst, std::fabs(now.kinetic - before.kinetic));
    momentum = std::max(momentum, size(now.angular - before.angular));
    const D3 axis = to_matrix(doubles(a.link_pose(0).orientation)).column(1);
    const bool is_up = axis.y > 0;
    if (is_up != up && ++flips == 1) first = i / 60.0;
    up = is_up;
  }
  EXPECT_EQ(flips, 4);
  EXPECT_NEAR(first, 2.633, by_scalar<S>(0.05, 0.02, 0.02));
  EXPECT_LT(worst / before.kinetic, by_scalar<S>(2.5e-4, 2.5e-4, 2.5e-4));
  EXPECT_LT(momentum / size(before.angular), by_scalar<S>(3e-5, 1e-12, 1e-8));
}

// O15: w^2 = g / (L cos(angle)).
TYPED_TEST(ArticulationJoints, a_bob_on_a_ball_draws_a_cone_in_its_time) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  d.links.push_back(bob<S>(kArticulationBase, {0, 0, 0}, 2, 1));
  d.links[0].type = ArticulationJoint::ball;
  Articulation<S> a = built(d);
  const double tilt = 0.6, rate = std::sqrt(10 / (2 * std::cos(tilt)));
  JointCoordinates<S> start;
  start.rotation = turn_about<S>({0, 0, 1}, tilt);
  start.angular_velocity = vector<S>({0, rate, 0});
  ASSERT_TRUE(a.set_coordinates(0, start));
  double round = 0, before = 0;
  for (int i = 0; i < 600; ++i) {
    this->run(a, 1);
    const D3 at = doubles(a.link_centre(0));
    EXPECT_NEAR(at.y, -2 * std::cos(tilt), 1e-3);
    const double now = std::atan2(-at.z, at.x);
    round += std::remainder(now - before, 2 * kPi);
    before = now;
  }
  EXPECT_NEAR(round, rate * 10, 0.001 * rate * 10);
}

TYPED_TEST(ArticulationJoints, a_ball_stays_within_its_cone) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  d.links.push_back(bar<S>(kArticulationBase, {0, 0, 0}, 1, 1, 0.1));
  ArticulationLink<S>& l = d.links[0];
  l.type = ArticulationJoint::ball;
  l.axis = vector<Unit<S>>({0, -1, 0});
  l.limited = true;
  l.upper = number<S>(0.5);
  l.frame_a.orientation = turn_about<S>({0, 0, 1}, 1.0);  // the cone stands aside of straight down
  Articulation<S> a = built(d);
  JointCoordinates<S> start;
  start.angular_velocity = vector<S>({6, 0, 2});
  ASSERT_TRUE(a.set_coordinates(0, start));
  const D3 middle = {std::sin(1.0), -std::cos(1.0), 0};
  double energy = motion_of(a).energy(), angle = 0;
  for (int i = 0; i < 600; ++i) {
    this->run(a, 1);
    const D3 way = doubles(a.link_centre(0)) * 2.0;
    angle = std::atan2(size(cross(middle, way)), dot(middle, way));
    // The edge is round: a straight sub-step along it leads outside by the square of what it turns.
    ASSERT_LT(angle, 0.5 + 1e-3);
    const double now = motion_of(a).energy();
    ASSERT_LT(now, energy + 2e-3) << i;
    energy = std::min(energy, now);
  }
  EXPECT_NEAR(angle, 0.5, 1e-3);
}

TYPED_TEST(ArticulationJoints, a_ball_is_driven_to_its_pose) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  d.links.push_back(bar<S>(kArticulationBase, {0, 0, 0}, 1, 1, 0.1));
  d.links[0].type = ArticulationJoint::ball;
  ArticulationDrive<S>& drive = d.links[0].drive;
  drive.pose = turn_about<S>({0.6, 0, 0.8}, 2.0);
  drive.stiffness = number<S>(1e5);
  drive.damping = number<S>(1e3);
  drive.max_force = number<S>(50);
  Articulation<S> a = built(d);
  this->run(a, 300);
  const Quat<double> q = doubles(a.coordinates(0).rotation), p = doubles(drive.pose);
  EXPECT_NEAR(std::fabs(q.x * p.x + q.y * p.y + q.z * p.z + q.w * p.w), 1, 1e-7);
}

}  // namespace articulation_joints_test
}  // namespace isostep::test
