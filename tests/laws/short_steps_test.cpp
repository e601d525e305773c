// Laws at the shortest steps that a world takes: what holds at 60 steps a second holds at 10 000.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace short_steps_test {

struct Rate {
  int hz, substeps;
};
constexpr Rate kRates[] = {{2500, 4}, {kMostHz, 1}};

template <class S> class ShortSteps : public ::testing::Test {
 protected:
  /// A world by every solver at every rate.
  template <class Law> static void in_all(Law law) {
    for (const Rate& rate : kRates) {
      for (std::uint32_t solver = 0; solver < kSolvers; ++solver) {
        Settings<S> s = settings<S>(-10, rate.hz, rate.substeps);
        s.solver = static_cast<SolverName>(solver);
        SCOPED_TRACE(std::string(kSolverNames[solver]) + ", " + std::to_string(rate.substeps) + " x " +
                     std::to_string(rate.hz));
        World<S> w(s);
        ASSERT_EQ(w.fault(), Fault::none);
        law(w, rate);
        EXPECT_EQ(w.fault(), Fault::none);
      }
    }
  }
};
TYPED_TEST_SUITE(ShortSteps, AllScalars);

TYPED_TEST(ShortSteps, a_body_falls_by_half_g_t_squared) {
  using S = TypeParam;
  this->in_all([](World<S>& w, const Rate& rate) {
    const BodyId id = w.create(moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 20, 0}));
    run(w, rate.hz);
    EXPECT_NEAR(to_double(w.center_of_mass(id).y), 15, pick<S>(0.01, 0.01, 0.05, 0.01));
    EXPECT_NEAR(to_double(w.velocity(id).y), -10, pick<S>(0.01, 0.001, 0.05, 0.001));
  });
}

TYPED_TEST(ShortSteps, three_boxes_stand_and_sleep) {
  using S = TypeParam;
  this->in_all([](World<S>& w, const Rate& rate) {
    add_ground(w);
    BodyId boxes[3];
    for (int i = 0; i < 3; ++i) boxes[i] = w.create(moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 0.25 + 0.5 * i, 0}));
    run(w, 2 * rate.hz);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(length(real(w.center_of_mass(boxes[i])) - D3{0, 0.25 + 0.5 * i, 0}), 0.005) << i;
      EXPECT_FALSE(w.is_awake(boxes[i])) << i;
    }
  });
}

TYPED_TEST(ShortSteps, a_block_stops_after_its_square_of_speed_over_twice_friction) {
  using S = TypeParam;
  this->in_all([](World<S>& w, const Rate& rate) {
    add_ground(w, 0.5);
    BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.125, 0.5), {0, 0.125, 0});
    d.material.friction = S(0.5);
    d.velocity = vec<S>(3, 0, 0);
    const BodyId id = w.create(d);
    run(w, rate.hz);
    EXPECT_NEAR(to_double(w.center_of_mass(id).x), 0.9, pick<S>(0.02, 0.02, 0.05, 0.02));
  });
}

TYPED_TEST(ShortSteps, a_perfect_ball_bounces_back_to_its_height) {
  using S = TypeParam;
  this->in_all([](World<S>& w, const Rate& rate) {
    add_ground(w);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 1.25, 0});
    d.material.restitution = S(1);
    const BodyId id = w.create(d);
    double highest = 0;
    for (int i = 0; i < 3 * rate.hz; ++i) {
      w.step();
      if (2 * rate.hz < i) highest = std::max(highest, to_double(w.center_of_mass(id).y));
    }
    EXPECT_NEAR(highest, 1.25, pick<S>(0.02, 0.02, 0.05, 0.02));
  });
}

TYPED_TEST(ShortSteps, a_pendulum_holds_its_pivot_and_comes_back) {
  using S = TypeParam;
  this->in_all([](World<S>& w, const Rate& rate) {
    const BodyId bob = w.create(moving<S>(add_ball(w, 0.25), {1, 5, 0}));
    const JointId pin = w.create(w.joint_at(JointType::ball, {}, bob, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()}));
    ASSERT_TRUE(pin);
    double highest = 0, apart = 0;
    for (int i = 0; i < 3 * rate.hz; ++i) {
      w.step();
      apart = std::max(apart, to_double(w.joint_error(pin)));
      if (2 * rate.hz < i) highest = std::max(highest, to_double(w.center_of_mass(bob).y));
    }
    EXPECT_NEAR(highest, 5, 0.05);
    EXPECT_LT(apart, 0.005);
  });
}

TYPED_TEST(ShortSteps, more_steps_than_a_world_takes_are_refused) {
  Settings<TypeParam> s = settings<TypeParam>(-10, kMostHz + 1, 1);
  EXPECT_EQ(World<TypeParam>(s).fault(), Fault::out_of_range);
  s.hz = kMostHz;
  s.substeps = 2;
  EXPECT_EQ(World<TypeParam>(s).fault(), Fault::out_of_range);
}

}  // namespace short_steps_test
}  // namespace isostep::test
