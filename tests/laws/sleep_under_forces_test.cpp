// Laws of sleep under force records: what nothing holds stays awake, however slow it is; what something holds rests.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace sleep_under_forces_test {

template <class S> class SleepUnderForces : public ::testing::Test {
 protected:
  /// A ball of 1 kg without gravity that comes with `speed` along y.
  static BodyId add_thrown(World<S>& w, double speed) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 2, 0}, {0, speed, 0});
    d.mass = S(1);
    return w.create(d);
  }
  static int steps_awake(World<S>& w, BodyId id, int most) {
    int steps = 0;
    for (; steps < most && w.is_awake(id); ++steps) w.step();
    return steps;
  }
};
TYPED_TEST_SUITE(SleepUnderForces, AllScalars);

constexpr double kPulls[] = {0.01, 0.05, 0.2, 1};  // [m/s^2]

/// Thrown up at a speed that the pull takes half a second to end: slower than bodies at rest are for twice as long.
TYPED_TEST(SleepUnderForces, what_a_zone_turns_back_stays_awake) {
  using S = TypeParam;
  for (const double pull : kPulls) {
    for (const double speed : {0.0, pull / 2}) {
      World<S> w(settings<S>(0));
      ForceZone<S> zone;
      zone.acceleration = vec<S>(0, -pull, 0);
      ASSERT_TRUE(w.add(zone));
      const BodyId id = this->add_thrown(w, speed);
      EXPECT_EQ(this->steps_awake(w, id, 180), 180) << pull << " m/s^2, " << speed << " m/s";
    }
  }
}
TYPED_TEST(SleepUnderForces, what_an_attractor_turns_back_stays_awake) {
  using S = TypeParam;
  for (const double pull : kPulls) {
    World<S> w(settings<S>(0));
    Attractor<S> attractor;
    attractor.point = vec<S>(0, -8, 0);
    attractor.strength = num<S>(pull * 100);  // 10 m away
    ASSERT_TRUE(w.add(attractor));
    const BodyId id = this->add_thrown(w, pull / 2);
    EXPECT_EQ(this->steps_awake(w, id, 150), 150) << pull;
  }
}
TYPED_TEST(SleepUnderForces, what_a_thruster_drives_or_turns_stays_awake) {
  using S = TypeParam;
  for (const bool turns : {false, true}) {
    for (const double pull : kPulls) {
      World<S> w(settings<S>(0));
      const BodyId id = this->add_thrown(w, 0);
      Thruster<S> thruster;
      thruster.body = id;
      thruster.force = vec<S>(0, 0, turns ? pull / 10 : pull);
      thruster.point = vec<S>(turns ? 0.25 : 0, 0, 0);
      ASSERT_TRUE(w.add(thruster));
      EXPECT_EQ(this->steps_awake(w, id, 150), 150) << pull << (turns ? " turns" : " drives");
    }
  }
}

TYPED_TEST(SleepUnderForces, what_lies_on_a_floor_under_a_zone_rests) {
  using S = TypeParam;
  for (const double pull : {0.2, 1.0, 10.0}) {
    World<S> w(settings<S>(0));
    add_ground(w);
    ForceZone<S> zone;
    zone.acceleration = vec<S>(0, -pull, 0);
    ASSERT_TRUE(w.add(zone));
    BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0});
    const BodyId id = w.create(d);
    EXPECT_LT(this->steps_awake(w, id, 240), 240) << pull;
  }
}
TYPED_TEST(SleepUnderForces, what_hangs_on_a_spring_or_hovers_in_balance_rests) {
  using S = TypeParam;
  World<S> w(settings<S>(-10));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 2, 0});
  d.mass = S(1);
  d.linear_damping = S(4);
  const BodyId hung = w.create(d);
  BodySpring<S> spring;
  spring.a = hung;
  spring.anchor_b = vec<S>(0, 4, 0);
  spring.rest_length = S(1);
  spring.stiffness = S(40);
  ASSERT_TRUE(w.add(spring));
  EXPECT_LT(this->steps_awake(w, hung, 600), 600);
  World<S> still(settings<S>(-10));
  const BodyId id = this->add_thrown(still, 0);
  ForceZone<S> lift;
  lift.acceleration = vec<S>(0, 10, 0);
  ASSERT_TRUE(still.add(lift));
  EXPECT_LT(this->steps_awake(still, id, 60), 60);
}

}  // namespace sleep_under_forces_test
}  // namespace isostep::test
