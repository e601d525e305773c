// Laws of pendulums: periods of a ball joint, a rod, a hinge, and the cone that a bob draws.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace pendulum_test {

template <class S> class PendulumLaws : public ::testing::Test {
 protected:
  /// Time of `swings` whole swings [s], by interpolated crossings of x = 0 to the right.
  static double period(World<S>& w, BodyId bob, int swings) {
    double before = to_double(w.center_of_mass(bob).x), first = -1;
    int crossings = 0;
    for (int i = 1; i < 60 * 60; ++i) {
      w.step();
      const double now = to_double(w.center_of_mass(bob).x);
      if (before < 0 && now >= 0) {
        const double at = (i - 1 + before / (before - now)) / 60;
        if (first < 0) first = at;
        else if (++crossings == swings) return (at - first) / swings;
      }
      before = now;
    }
    ADD_FAILURE() << "it does not swing";
    return 0;
  }
  static double swing_time(double length_over_g, double angle) {
    return 2 * kPi * std::sqrt(length_over_g) * (1 + angle * angle / 16 + 11 * angle * angle * angle * angle / 3072);
  }
};
TYPED_TEST_SUITE(PendulumLaws, AllScalars);

// O15.
TYPED_TEST(PendulumLaws, a_bob_on_a_ball_joint_swings_in_the_time_of_its_inertia_about_the_pivot) {
  using S = TypeParam;
  for (const double angle : {0.1, 0.5}) {
    World<S> w(settings<S>());
    const double arm = 1.5, r = 0.5;
    const BodyId bob = w.create(moving<S>(add_ball(w, r), {arm * std::sin(angle), 5 - arm * std::cos(angle), 0}));
    const JointId pin = w.create(w.joint_at(JointType::ball, {}, bob, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()}));
    ASSERT_TRUE(pin);
    const double expected = this->swing_time((arm * arm + 0.4 * r * r) / (10 * arm), angle);
    EXPECT_NEAR(this->period(w, bob, 4), expected, pick<S>(0.005, 0.005, 0.01, 0.005) * expected) << angle;
    EXPECT_LT(to_double(w.joint_error(pin)), 0.005);
  }
}

TYPED_TEST(PendulumLaws, a_bar_on_a_hinge_swings_as_a_compound_pendulum) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const double angle = 0.3, arm = 1;
  BodyDefinition<S> d = moving<S>(add_box(w, 0.125, 1, 0.125), {arm * std::sin(angle), 5 - arm * std::cos(angle), 0});
  d.orientation = turn<S>({0, 0, 1}, angle);
  const BodyId bar = w.create(d);
  ASSERT_TRUE(w.create(w.joint_at(JointType::hinge, {}, bar, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()})));
  const double inertia = (1 + 0.125 * 0.125) / 3 + arm * arm;
  const double expected = this->swing_time(inertia / (10 * arm), angle);
  EXPECT_NEAR(this->period(w, bar, 4), expected, pick<S>(0.005, 0.005, 0.01, 0.005) * expected);
  EXPECT_NEAR(to_double(w.center_of_mass(bar).z), 0, 0.01);
}

TYPED_TEST(PendulumLaws, a_bob_on_a_rod_of_fixed_length_swings_as_a_point) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const double angle = 0.2, arm = 2;
  const BodyId bob = w.create(moving<S>(add_ball(w, 0.25), {arm * std::sin(angle), 5 - arm * std::cos(angle), 0}));
  JointProperties<S> rod = w.joint_at(JointType::distance, {}, bob, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()});
  rod.frame_b.position = Vec3<S>::zero();
  rod.lower = rod.upper = num<S>(arm);
  ASSERT_TRUE(w.create(rod));
  const double expected = this->swing_time(arm / 10, angle);
  EXPECT_NEAR(this->period(w, bob, 4), expected, pick<S>(0.005, 0.005, 0.01, 0.005) * expected);
}

// w^2 = g / (L cos(angle)).
TYPED_TEST(PendulumLaws, a_bob_sent_round_draws_a_cone_in_its_time) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const double angle = 0.6, arm = 2, rate = std::sqrt(10 / (arm * std::cos(angle)));
  const double radius = arm * std::sin(angle);
  const BodyId bob =
      w.create(moving<S>(add_ball(w, 0.25), {-0.001, 5 - arm * std::cos(angle), radius}, {radius * rate, 0, 0}));
  JointProperties<S> rod = w.joint_at(JointType::distance, {}, bob, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()});
  rod.frame_b.position = Vec3<S>::zero();
  rod.lower = rod.upper = num<S>(arm);
  ASSERT_TRUE(w.create(rod));
  EXPECT_NEAR(this->period(w, bob, 3), 2 * kPi / rate, 0.01 * 2 * kPi / rate);
  EXPECT_NEAR(to_double(w.center_of_mass(bob).y), 5 - arm * std::cos(angle), 0.03);
}

}  // namespace pendulum_test
}  // namespace isostep::test
