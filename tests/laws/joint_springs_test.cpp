// Laws of joints' springs: without damping they keep their swing, loaded they stretch by what they bear.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace joint_springs_test {

template <class S> class JointSprings : public ::testing::Test {
 protected:
  static Settings<S> settings_of(SolverName solver, int substeps, double gravity = 0) {
    Settings<S> s = settings<S>(gravity, 60, substeps);
    s.solver = solver;
    return s;
  }
  static BodyId add_bob(World<S>& w, D3 at) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), at);
    d.mass = S(1);
    return w.create(d);
  }
  /// Swings undamped and without weight, half a metre or radian from its rest. Returns the largest way from it in the
  /// last two swings of ten seconds over that in the first two.
  static double kept(SolverName solver, int substeps, JointType type, double frequency) {
    World<S> w(settings_of(solver, substeps));
    const BodyId bob = add_bob(w, {2, 0, 0});
    const bool turns = type == JointType::hinge;
    JointProperties<S> j = w.joint_at(type, {}, bob, {vec<S>(turns ? 1 : 0, 0, 0), Quat<Unit<S>>::identity()});
    if (!turns) j.frame_b.position = vec<S>(0, 0, 0);
    j.flags = joint_flag::kSpring;
    j.spring_target = num<S>(turns ? 0.5 : 1.5);
    j.spring_frequency = num<S>(frequency);
    EXPECT_TRUE(w.create(j)) << describe(w.fault());
    const int swings = std::max(2, static_cast<int>(2 * 60 / frequency));
    double first = 0, last = 0;
    for (int i = 0; i < 600; ++i) {
      EXPECT_TRUE(w.step().clean());
      const D3 at = real(w.center_of_mass(bob));
      const double way = std::fabs(turns ? std::atan2(at.y, at.x - 1) - 0.5 : length(at) - 1.5);
      if (i < swings) first = std::max(first, way);
      if (600 - swings <= i) last = std::max(last, way);
    }
    return last / first;
  }
};
TYPED_TEST_SUITE(JointSprings, AllScalars);

// At 1 Hz a third was lost in ten seconds, at 5 Hz all of it.
TYPED_TEST(JointSprings, undamped_keep_their_swing_for_ten_seconds) {
  for (const SolverName solver : built({SolverName::soft_step, SolverName::worst_first, SolverName::direct})) {
    // Q16.16 has four digits for how weak a spring is as a row that yields, and direct takes it as one.
    const bool coarse = std::is_same_v<TypeParam, Q16_16> && solver == SolverName::direct;
    EXPECT_NEAR(this->kept(solver, 8, JointType::distance, 1), 1, coarse ? 0.3 : 0.01);
    EXPECT_NEAR(this->kept(solver, 8, JointType::hinge, 1), 1, coarse ? 0.3 : 0.05);
    if (coarse) continue;
    EXPECT_NEAR(this->kept(solver, 8, JointType::distance, 5), 1, 0.05);
  }
  EXPECT_NEAR(this->kept(SolverName::soft_step, 8, JointType::hinge, 5), 1, 0.05);
  EXPECT_NEAR(this->kept(SolverName::soft_step, 4, JointType::distance, 5), 1, 0.05);
  EXPECT_NEAR(this->kept(SolverName::pgs, 8, JointType::distance, 1), 1, 0.01);
}

// Beyond kSpringLag, 0.25 rad a sub-step, a swing is damped and never grows.
TYPED_TEST(JointSprings, fast_ones_are_damped) {
  for (const double frequency : {20.0, 60.0, 120.0}) {
    for (const JointType type : {JointType::distance, JointType::hinge})
      EXPECT_LT(this->kept(SolverName::soft_step, 4, type, frequency), 0.01) << frequency;
  }
}

// m g / k = g / (2 pi f)^2 for a body on the world, and as much more as the bodies seem heavier: at most a sixteenth.
TYPED_TEST(JointSprings, stretch_by_the_weight_that_they_bear) {
  using S = TypeParam;
  for (const double frequency : {1.0, 5.0, 20.0}) {
    World<S> w(this->settings_of(SolverName::soft_step, 8, -10));
    const BodyId bob = this->add_bob(w, {0, -2, 0});
    JointProperties<S> j = w.joint_at(JointType::distance, {}, bob, {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()});
    j.frame_b.position = vec<S>(0, 0, 0);
    j.flags = joint_flag::kSpring;
    j.spring_target = S(2);
    j.spring_frequency = num<S>(frequency);
    j.spring_damping = S(1);
    ASSERT_TRUE(w.create(j));
    for (int i = 0; i < 600; ++i) w.step();
    const double angle = 2 * kPi * frequency / 480, stretch = 10 / std::pow(2 * kPi * frequency, 2);
    const double heavier = 1 + std::min(angle * angle, 1.0 / 16);
    const double slack = pick<S>(0.004, 0.004, 0.015, 0.004) * stretch + 4 * grain<S>(2);
    EXPECT_NEAR(-to_double(w.center_of_mass(bob).y) - 2, stretch * heavier, slack) << frequency;
  }
}

// A joint may become another kind of itself while it bears a load, by set_joint: what held it before is let go.
TYPED_TEST(JointSprings, replace_rods_and_ropes_without_a_jerk) {
  using S = TypeParam;
  using enum SolverName;
  for (const SolverName solver : {soft_step, pgs, worst_first, direct}) {
    World<S> w(this->settings_of(solver, 8, -10));
    const BodyId bob = this->add_bob(w, {0, -2, 0});
    JointProperties<S> rod = w.joint_at(JointType::distance, {}, bob, {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()});
    rod.frame_b.position = vec<S>(0, 0, 0);
    rod.flags = joint_flag::kLimit;
    rod.lower = rod.upper = S(2);
    const JointId joint = w.create(rod);
    ASSERT_TRUE(joint) << describe(w.fault());
    for (int i = 0; i < 60; ++i) w.step();
    JointProperties<S> rope = rod, spring = rod;
    rope.lower = S(0);
    spring.flags = joint_flag::kSpring;
    spring.spring_target = S(2);
    spring.spring_frequency = S(5);
    spring.spring_damping = S(1);
    for (const JointProperties<S>& next : {rope, spring, rod, spring, rope, rod}) {
      ASSERT_TRUE(w.set_joint(joint, next)) << describe(w.fault());
      double fastest = 0;
      for (int i = 0; i < 60; ++i) {
        w.step();
        fastest = std::max(fastest, length(real(w.velocity(bob))));
      }
      EXPECT_LT(fastest, 0.5) << static_cast<int>(solver);  // a spring falls by its stretch, a rod pulls it up again
      EXPECT_NEAR(-to_double(w.center_of_mass(bob).y), 2, 0.02) << static_cast<int>(solver);
    }
  }
}

// The shorter way round: an angle beyond half a turn from the target comes back from the other side. Its stretch once
// jumped by a turn at half a turn from zero, and a bob that swung across there was driven faster on every round.
TYPED_TEST(JointSprings, of_an_angle_pull_the_shorter_way_round) {
  using S = TypeParam;
  using enum SolverName;
  for (const SolverName solver : {soft_step, pgs, worst_first, direct}) {
    for (const double target : {2.9, -2.9, 4.0}) {
      World<S> w(this->settings_of(solver, 8));
      const BodyId bob = this->add_bob(w, {2, 0, 0});
      JointProperties<S> j = w.joint_at(JointType::hinge, {}, bob, {vec<S>(1, 0, 0), Quat<Unit<S>>::identity()});
      j.flags = joint_flag::kSpring;
      j.spring_target = num<S>(target);
      j.spring_frequency = S(1);
      j.spring_damping = num<S>(0.25);
      const JointId joint = w.create(j);
      ASSERT_TRUE(joint) << describe(w.fault());
      for (int i = 0; i < 600; ++i) ASSERT_TRUE(w.step().clean());
      const double off = std::remainder(to_double(w.joint_position(joint)) - target, 2 * kPi);
      EXPECT_NEAR(off, 0, 0.02) << kSolverNames[static_cast<int>(solver)] << target;
      EXPECT_LT(length(real(w.angular_velocity(bob))), 0.02) << kSolverNames[static_cast<int>(solver)] << target;
    }
  }
}

}  // namespace joint_springs_test
}  // namespace isostep::test
