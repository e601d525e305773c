// Laws of couplings between joints: gears, racks, screws, pulleys, differentials; in every scalar, with every solver.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "laws/single_joints.hpp"

namespace isostep::test {
namespace couplings_test {

constexpr double kTurn = 2 * kPi;

template <class S> class Couplings : public ::testing::Test {
 protected:
  explicit Couplings(SolverName solver = SolverName::soft_step) : w(with(solver)) {}
  static Settings<S> with(SolverName solver) {
    Settings<S> s = settings<S>(-10, 60, 8);
    s.solver = solver;
    return s;
  }
  /// A disc of 10 kg and 0.5 m on an axle along z.
  JointId disc(World<S>& world, double x, const JointProperties<S>& settings = {}) {
    BodyDefinition<S> d = moving<S>(add_box(world, 0.5, 0.5, 0.25), {x, 0, 0});
    d.mass = S(10);
    const BodyId body = world.create(d);
    JointProperties<S> joint = world.joint_at(JointType::hinge, {}, body, {vec<S>(x, 0, 0), Quat<Unit<S>>::identity()});
    joint.take_settings(settings);
    return world.create(joint);
  }
  /// A block of `mass` on a slider straight up.
  JointId lift(World<S>& world, double x, double mass, const JointProperties<S>& settings = {}) {
    BodyDefinition<S> d = moving<S>(add_box(world, 0.25, 0.25, 0.25), {x, 0, 0});
    d.mass = num<S>(mass);
    const BodyId body = world.create(d);
    const Quat<Unit<S>> up = turn<S>({1, 0, 0}, -kPi / 2);  // z to y
    JointProperties<S> joint = world.joint_at(JointType::slider, {}, body, {vec<S>(x, 0, 0), up});
    joint.take_settings(settings);
    return world.create(joint);
  }
  static JointProperties<S> motor(double speed, double torque) {
    JointProperties<S> p;
    p.flags = joint_flag::kMotor;
    p.motor_speed = num<S>(speed);
    p.max_force = num<S>(torque);
    return p;
  }
  BodyId body_of(JointId joint) { return {w.joint(joint)->body_b, w.joint(joint)->generation_b}; }
  double spin(JointId joint) { return to_double(w.angular_velocity(body_of(joint)).z); }
  double at(JointId joint) { return to_double(w.joint_position(joint)); }
  /// [1] The error of the sum, in turns.
  double off(std::initializer_list<std::pair<double, JointId>> terms) {
    double sum = 0;
    for (const auto& [ratio, joint] : terms) sum += ratio * at(joint) / kTurn;
    return sum - std::round(sum);
  }

  World<S> w;
};
TYPED_TEST_SUITE(Couplings, AllScalars);

TYPED_TEST(Couplings, gears_turn_as_their_teeth_and_stay_in_mesh_under_load) {
  using S = TypeParam;
  const JointId a = this->disc(this->w, 0, this->motor(10, 2000)), b = this->disc(this->w, 4),
                c = this->disc(this->w, 8);
  ASSERT_TRUE(this->w.add(gears<S>(a, 20, b, 40))) << describe(this->w.fault());
  ASSERT_TRUE(this->w.add(gears<S>(b, 40, c, 10)));
  double worst = 0;
  for (int frame = 0; frame < 60 * 60; ++frame) {
    this->w.apply_force(this->body_of(c), Vec3<S>::zero(), vec<S>(0, 0, -10));
    this->w.step();
    if (frame < 60) continue;
    worst = std::max({worst, std::abs(this->off({{20, a}, {40, b}})), std::abs(this->off({{40, b}, {10, c}}))});
  }
  EXPECT_NEAR(this->spin(a), 10, 0.05);
  EXPECT_NEAR(this->spin(b), -5, 0.025);
  EXPECT_NEAR(this->spin(c), 20, 0.1);
  EXPECT_LT(worst, pick<S>(0.02, 0.02, 0.05, 0.02)) << "teeth";
}

TYPED_TEST(Couplings, what_stands_in_mesh_stands_there_after_a_thousand_turns) {
  using S = TypeParam;
  const JointId a = this->disc(this->w, 0, this->motor(30, 2000)), b = this->disc(this->w, 4);
  this->w.add(gears<S>(a, 40, b, 20));
  run(this->w, 60 * 210);  // 6300 rad of a
  EXPECT_LT(std::abs(this->off({{40, a}, {20, b}})), pick<S>(0.02, 0.02, 0.05, 0.02));
  EXPECT_NEAR(this->spin(a), 30, 0.1);
  EXPECT_NEAR(this->spin(b), -60, 0.2);
}

TYPED_TEST(Couplings, a_rack_moves_by_the_pinions_radius_however_often_that_turns) {
  using S = TypeParam;
  const JointId pinion = this->disc(this->w, 0, this->motor(4, 2000)), rack = this->lift(this->w, 4, 5);
  ASSERT_TRUE(this->w.add(rack_and_pinion<S>(pinion, num<S>(0.25), rack))) << describe(this->w.fault());
  run(this->w, 60 * 8);
  const double angle = 4 * 8.0;  // five turns
  EXPECT_NEAR(this->at(rack), 0.25 * angle, 0.02);
  EXPECT_NEAR(to_double(this->w.velocity(this->body_of(rack)).y), 1, 0.01);
}

TYPED_TEST(Couplings, a_nut_sinks_as_fast_as_its_screw_lets_it) {
  using S = TypeParam;
  const double pitch = 2, mass = 20;
  const JointId shaft = this->disc(this->w, 0), nut = this->lift(this->w, 4, mass);
  ASSERT_TRUE(this->w.add(screw<S>(shaft, num<S>(pitch), nut)));
  run(this->w, 60);
  const double inertia = 10.0 / 12 * 2;  // of a box of 1 x 1 m about z
  const double acceleration = 10 / (1 + inertia * (kTurn / pitch) * (kTurn / pitch) / mass);
  EXPECT_NEAR(to_double(this->w.velocity(this->body_of(nut)).y), -acceleration, 0.01 * acceleration);
}

/// Two weights on ropes from two wheels, the rope between them.
template <class S> struct Weights {
  World<S>& w;
  BodyId light, heavy;
  JointId rope_a, rope_b;

  Weights(World<S>& world, double mass_a, double mass_b) : w(world) {
    const auto hang = [&](double x, double mass) {
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {x, -2, 0});
      d.mass = num<S>(mass);
      return w.create(d);
    };
    light = hang(-1, mass_a);
    heavy = hang(1, mass_b);
    rope_a = rope(-1, light);
    rope_b = rope(1, heavy);
  }
  JointId rope(double x, BodyId weight) {
    JointProperties<S> joint =
        w.joint_at(JointType::distance, {}, weight, {vec<S>(x, -2, 0), Quat<Unit<S>>::identity()});
    joint.frame_a.position = vec<S>(x, 0, 0);
    joint.flags = joint_flag::kLimit;
    joint.upper = S(20);
    return w.create(joint);
  }
};

TYPED_TEST(Couplings, a_pulley_accelerates_two_weights_as_atwood_has_it) {
  using S = TypeParam;
  Weights<S> weights(this->w, 1, 2);
  ASSERT_TRUE(this->w.add(pulley<S>(weights.rope_a, weights.rope_b, S(1), S(4)))) << describe(this->w.fault());
  run(this->w, 30);
  const double speed = 10.0 / 3 * 0.5;
  EXPECT_NEAR(to_double(this->w.velocity(weights.light).y), speed, 0.005 * speed);
  EXPECT_NEAR(to_double(this->w.velocity(weights.heavy).y), -speed, 0.005 * speed);
  EXPECT_NEAR(this->at(weights.rope_a) + this->at(weights.rope_b), 4, 1e-3);
}

TYPED_TEST(Couplings, a_pulley_of_ratio_two_balances_twice_the_weight) {
  using S = TypeParam;
  Weights<S> weights(this->w, 1, 2);
  this->w.add(pulley<S>(weights.rope_a, weights.rope_b, S(2), S(6)));
  run(this->w, 120);
  EXPECT_NEAR(this->at(weights.rope_a), 2, pick<S>(2e-3, 1e-3, 1e-2, 1e-3));
  EXPECT_NEAR(this->at(weights.rope_b), 2, pick<S>(2e-3, 1e-3, 1e-2, 1e-3));
}

TYPED_TEST(Couplings, a_rope_that_is_slack_pulls_at_nothing) {
  using S = TypeParam;
  Weights<S> weights(this->w, 1, 2);
  this->w.add(pulley<S>(weights.rope_a, weights.rope_b, S(1), S(8)));
  run(this->w, 30);
  EXPECT_NEAR(to_double(this->w.velocity(weights.light).y), -5, 0.02);
  run(this->w, 270);
  EXPECT_LT(this->at(weights.rope_a) + this->at(weights.rope_b), 8 + pick<S>(2e-3, 1e-3, 1e-2, 1e-3));
}

TYPED_TEST(Couplings, a_differential_turns_one_wheel_twice_as_fast_where_the_other_stands) {
  using S = TypeParam;
  const JointId shaft = this->disc(this->w, 0, this->motor(5, 2000));
  const JointId left = this->disc(this->w, 4, this->motor(0, 2000)), right = this->disc(this->w, 8);
  ASSERT_TRUE(this->w.add(differential<S>(shaft, left, right)));
  run(this->w, 120);
  EXPECT_NEAR(this->spin(left), 0, 0.05);
  EXPECT_NEAR(this->spin(right), 10, 0.1);
}

TYPED_TEST(Couplings, hold_with_every_solver) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    World<S> world(this->with(solver));
    const JointId a = this->disc(world, 0, this->motor(4, 2000)), b = this->disc(world, 4);
    ASSERT_TRUE(world.add(gears<S>(a, 1, b, 2)));
    run(world, 120);
    const BodyId turned = {world.joint(b)->body_b, world.joint(b)->generation_b};
    EXPECT_NEAR(to_double(world.angular_velocity(turned).z), -2, 0.02) << kSolverNames[static_cast<int>(solver)];
  }
}

TYPED_TEST(Couplings, what_is_coupled_falls_asleep_and_wakes_together) {
  using S = TypeParam;
  const JointId a = this->disc(this->w, 0), b = this->disc(this->w, 4);
  this->w.add(gears<S>(a, 1, b, 1));
  run(this->w, 120);
  ASSERT_EQ(this->w.counts().awake, 0u);
  this->w.apply_impulse(this->body_of(a), Vec3<S>::zero(), vec<S>(0, 0, 10));
  run(this->w, 10);
  EXPECT_EQ(this->w.counts().awake, 2u);
  EXPECT_LT(this->spin(b), -0.5);
  EXPECT_NEAR(this->spin(b), -this->spin(a), pick<S>(1e-3, 1e-3, 2e-2, 1e-3));
}

TYPED_TEST(Couplings, end_with_a_joint_and_are_rolled_back) {
  using S = TypeParam;
  const JointId a = this->disc(this->w, 0, this->motor(3, 500)), b = this->disc(this->w, 4);
  const CouplingId coupling = this->w.add(gears<S>(a, 1, b, 1));
  run(this->w, 30);
  typename World<S>::Snapshot snapshot;
  this->w.save(snapshot);
  std::vector<std::uint64_t> hashes;
  const auto play = [&](bool first) {
    for (int frame = 0; frame < 40; ++frame) {
      if (frame == 20) this->w.destroy(b);
      this->w.step();
      if (first) hashes.push_back(this->w.hash());
      else EXPECT_EQ(this->w.hash(), hashes[static_cast<std::size_t>(frame)]) << frame;
    }
  };
  play(true);
  EXPECT_EQ(this->w.find(coupling), nullptr);
  this->w.load(snapshot);
  EXPECT_NE(this->w.find(coupling), nullptr);
  play(false);
}

TYPED_TEST(Couplings, refuse_what_has_no_position_and_teeth_that_are_not_whole) {
  using S = TypeParam;
  const JointId a = this->disc(this->w, 0), b = this->disc(this->w, 4), c = this->lift(this->w, 8, 1);
  const JointId ball = this->w.create(this->w.joint_at(JointType::ball, this->body_of(a), {}, Pose<S>::identity()));
  const auto refused = [&](const Coupling<S>& coupling, const char* field) {
    const std::uint64_t before = this->w.hash();
    EXPECT_FALSE(this->w.add(coupling));
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before);
  };
  refused(gears<S>(a, 1, a, 1), "joint_b");
  refused(gears<S>(a, 1, ball, 1), "joint_b");
  refused(gears<S>(a, 1, {}, 1), "joint_b");
  Coupling<S> coupling = gears<S>(a, 1, b, 1);
  coupling.ratio_b = num<S>(1.5);
  refused(coupling, "ratio_b");
  refused(gears<S>(a, kMostTeeth<S> + 1, b, 1), "ratio_a");
  coupling = gears<S>(a, 1, b, 1);
  coupling.ratio_c = S(1);
  refused(coupling, "ratio_c");
  coupling = gears<S>(a, 1, b, 1);
  coupling.upper = S(7);
  refused(coupling, "upper");
  coupling.upper = S(-1);
  refused(coupling, "upper");
  EXPECT_TRUE(this->w.add(rack_and_pinion<S>(a, num<S>(0.3), c))) << describe(this->w.fault());
  EXPECT_TRUE(this->w.add(gears<S>(a, kMostTeeth<S>, b, 1))) << describe(this->w.fault());
  EXPECT_EQ(this->w.state().records->couplings.slot_map().count_taken(), 2u);
}

}  // namespace couplings_test
}  // namespace isostep::test
