// Laws of joints between shafts: Hooke's universal joint, the constant velocity joint, and a crank with its slider.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "random/joint_angles.hpp"

namespace isostep::test {
namespace shaft_joints_test {

template <class S> class ShaftJoints : public ::testing::Test {
 protected:
  BodyId shaft(D3 at, double lean) {
    BodyDefinition<S> d = moving<S>(w.add_shape(Cylinder<S>{num<S>(0.25), num<S>(0.5)}), at);
    d.orientation = normalise(turn<S>({0, 1, 0}, lean) * turn<S>({1, 0, 0}, kPi / 2));  // from y to z
    d.gravity_scale = S(0);
    d.collide = false;
    return w.create(d);
  }
  JointProperties<S> held(JointType type, BodyId a, BodyId b, D3 at, double lean) {
    return w.joint_at(type, a, b, {vec<S>(at), turn<S>({0, 1, 0}, lean)});
  }
  /// Two shafts through the origin, the second leaning by `bend`, each in a bearing; the first is driven. Ratios of
  /// their speeds over ten seconds, the first left out.
  struct Ratios {
    double least = 1e9, most = 0, apart = 0;
  };
  Ratios drive(JointType type, double bend) {
    const D3 along = {std::sin(bend), 0, std::cos(bend)};
    const BodyId first = shaft({0, 0, -1}, 0), second = shaft(along, bend);
    JointProperties<S> bearing = held(JointType::hinge, {}, first, {0, 0, -1}, 0);
    bearing.flags = joint_flag::kMotor;
    bearing.motor_speed = S(3);
    bearing.max_force = S(500);
    EXPECT_TRUE(w.create(bearing));
    EXPECT_TRUE(w.create(held(JointType::hinge, {}, second, along, bend)));
    // One frame for each shaft: z along it.
    JointProperties<S> joint = held(type, first, second, {0, 0, 0}, 0);
    joint.frame_b = held(type, first, second, {0, 0, 0}, bend).frame_b;
    const JointId id = w.create(joint);
    EXPECT_TRUE(id) << describe(w.fault());
    Ratios ratios;
    for (int i = 0; i < 600; ++i) {
      EXPECT_TRUE(w.step().clean());
      if (i < 60) continue;
      const double ratio = dot(real(w.angular_velocity(second)), along) / real(w.angular_velocity(first)).z;
      ratios.least = std::min(ratios.least, ratio);
      ratios.most = std::max(ratios.most, ratio);
      ratios.apart = std::max(ratios.apart, to_double(w.joint_error(id)));
    }
    return ratios;
  }
  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(ShaftJoints, AllScalars);

TYPED_TEST(ShaftJoints, hookes_joint_turns_its_second_shaft_unevenly) {
  using S = TypeParam;
  const double bend = kPi / 6;
  const auto ratios = this->drive(JointType::universal, bend);
  const double bar = pick<S>(0.005, 0.005, 0.02, 0.005);
  EXPECT_NEAR(ratios.least, std::cos(bend), bar);
  EXPECT_NEAR(ratios.most, 1 / std::cos(bend), bar);
  EXPECT_LT(ratios.apart, pick<S>(2e-3, 2e-3, 1e-2, 2e-3));
}

TYPED_TEST(ShaftJoints, a_constant_velocity_joint_turns_both_alike) {
  using S = TypeParam;
  const auto ratios = this->drive(JointType::constant_velocity, kPi / 6);
  const double bar = pick<S>(0.005, 0.005, 0.02, 0.005);
  EXPECT_NEAR(ratios.least, 1, bar);
  EXPECT_NEAR(ratios.most, 1, bar);
  EXPECT_LT(ratios.apart, pick<S>(2e-3, 2e-3, 1e-2, 2e-3));
}

/// S19 of the scenes: a crank of 0.5 m, a rod of 1.5 m, one turn a second.
TYPED_TEST(ShaftJoints, a_crank_moves_its_piston_as_geometry_says) {
  using S = TypeParam;
  World<S>& world = this->w;
  const double r = 0.5, l = 1.5;
  const auto body = [&](D3 half, D3 at, double mass) {
    BodyDefinition<S> d = moving<S>(add_box(world, half.x, half.y, half.z), at);
    d.gravity_scale = S(0);
    d.collide = false;
    d.mass = num<S>(mass);
    return world.create(d);
  };
  const BodyId crank = body({0.25, 0.125, 0.125}, {r / 2, 0, 0}, 1),
               rod = body({0.75, 0.125, 0.125}, {r + l / 2, 0, 0}, 1);
  const BodyId piston = body({0.25, 0.25, 0.25}, {r + l, 0, 0}, 1);
  JointProperties<S> motor = this->held(JointType::hinge, {}, crank, {0, 0, 0}, 0);
  motor.flags = joint_flag::kMotor;
  motor.motor_speed = num<S>(2 * kPi);
  motor.max_force = S(200);
  ASSERT_TRUE(world.create(motor));
  ASSERT_TRUE(world.create(this->held(JointType::hinge, crank, rod, {r, 0, 0}, 0)));
  ASSERT_TRUE(world.create(this->held(JointType::hinge, rod, piston, {r + l, 0, 0}, 0)));
  ASSERT_TRUE(world.create(this->held(JointType::slider, {}, piston, {r + l, 0, 0}, kPi / 2)));  // z along x
  double worst = 0, way = 0;
  for (int i = 0; i < 600; ++i) {
    ASSERT_TRUE(world.step().clean());
    const D3 arm = rotated<S>(world.pose(crank).orientation, {1, 0, 0}), at = real(world.center_of_mass(piston));
    worst = std::max(worst, std::fabs(at.x - r * arm.x - std::sqrt(l * l - r * r * arm.y * arm.y)));
    way = std::max(way, r + l - at.x);
  }
  EXPECT_NEAR(way, 2 * r, 0.02);
  EXPECT_LT(worst, pick<S>(5e-4, 5e-4, 1e-2, 5e-4));
}

}  // namespace shaft_joints_test
}  // namespace isostep::test
