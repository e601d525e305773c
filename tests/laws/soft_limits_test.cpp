// Laws of limits that yield: how far they give way, how fast they return, and that they return no more than they took.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "built.hpp"
#include "laws/exact_rollback.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace soft_limits_test {

constexpr double kTurn = 6.283185307179586;
constexpr std::uint32_t kAllLocks = joint_flag::kLockPoint | joint_flag::kLockTurns;

template <class S> struct Hung {
  World<S> world;
  BodyId body = {};
  JointId joint = {};
};

template <class S> class SoftLimits : public ::testing::Test {
 protected:
  static AxisDrive<S> soft(JointAxis axis, double lower, double upper, double frequency, double damping) {
    AxisDrive<S> d;
    d.axis = axis;
    d.limited = true;
    d.lower = num<S>(lower);
    d.upper = num<S>(upper);
    d.limit_frequency = num<S>(frequency);
    d.limit_damping = num<S>(damping);
    return d;
  }
  /// A box of 2 kg on a joint to the world that leaves it one axis.
  static Hung<S> hang(SolverName solver, const AxisDrive<S>& drive, double gravity, D3 from = {0, 0, 0}) {
    Settings<S> s = settings<S>(gravity, 60, 8);
    s.solver = solver;
    s.allow_sleep = false;
    Hung<S> made{World<S>(s)};
    BodyDefinition<S> d = moving<S>(add_box(made.world, 0.25, 0.25, 0.25), from);
    d.mass = S(2);
    made.body = made.world.create(d);
    SixAxisDefinition<S> joint;
    joint.b = made.body;
    joint.locks = kAllLocks & ~lock_of(drive.axis);
    joint.drives[joint.drive_count++] = drive;
    made.joint = made.world.create(six_axis(joint));
    EXPECT_TRUE(made.joint) << describe(made.world.fault());
    return made;
  }
  static double at(const Hung<S>& h, JointAxis axis) { return to_double(h.world.joint_position(h.joint, axis)); }
  static std::string name(SolverName solver) { return kSolverNames[static_cast<int>(solver)]; }
  static void run(Hung<S>& h, int frames) {
    for (int i = 0; i < frames; ++i) ASSERT_TRUE(h.world.step().clean());
  }
};
TYPED_TEST_SUITE(SoftLimits, AllScalars);

/// At rest g = w^2 x: 9.8 m/s^2 at 2 Hz are 62 mm.
TYPED_TEST(SoftLimits, sag_as_far_as_their_spring_says) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    Hung<S> h = this->hang(solver, this->soft(JointAxis::y, -0.5, 1, 2, 1), -9.8);
    this->run(h, 300);
    const double w = kTurn * 2;
    EXPECT_NEAR(this->at(h, JointAxis::y), -0.5 - 9.8 / (w * w), 0.001) << this->name(solver);
    EXPECT_NEAR(to_double(h.world.velocity(h.body).y), 0, 0.001) << this->name(solver);
  }
}

/// An angle: M = inertia w^2 x.
TYPED_TEST(SoftLimits, of_a_turn_hold_an_arm_as_their_spring_says) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    const AxisDrive<S> drive = this->soft(JointAxis::twist, -0.25, 0.25, 3, 1);
    Hung<S> h = this->hang(solver, drive, 0);
    for (int i = 0; i < 300; ++i) {
      h.world.apply_force(h.body, vec<S>(0, 0, 0), vec<S>(0, 0, 2));
      ASSERT_TRUE(h.world.step().clean());
    }
    const double inertia = 2 * (0.25 * 0.25 + 0.25 * 0.25) / 3, w = kTurn * 3;
    EXPECT_NEAR(this->at(h, JointAxis::twist), 0.25 + 2 / (inertia * w * w), 0.004) << this->name(solver);
  }
}

/// Without damping a body comes back as fast as it came, but for what implicit steps lose: as much as
/// exp(-pi w h / 2) of the speed, with h the whole step in pgs. It is beyond the limit for half a swing.
TYPED_TEST(SoftLimits, throw_back_what_they_caught_in_half_a_swing) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    Hung<S> hung = this->hang(solver, this->soft(JointAxis::x, -0.5, 0.5, 2, 0), 0);
    hung.world.set_velocity(hung.body, vec<S>(2, 0, 0), vec<S>(0, 0, 0));
    double deepest = 0;
    int beyond = 0;
    for (int i = 0; i < 60; ++i) {
      ASSERT_TRUE(hung.world.step().clean());
      const double x = this->at(hung, JointAxis::x);
      deepest = std::max(deepest, x - 0.5);
      beyond += x > 0.5;
    }
    const double w = kTurn * 2, h = solver == SolverName::pgs ? 1.0 / 60 : 1.0 / 480,
                 kept = std::exp(-kTurn / 4 * w * h);
    const double back = -to_double(hung.world.velocity(hung.body).x);
    EXPECT_LE(back, 2.001) << this->name(solver);
    EXPECT_NEAR(back, 2 * kept, 0.05) << this->name(solver);
    EXPECT_NEAR(deepest, 2 / w * std::sqrt(kept), 0.008) << this->name(solver);
    EXPECT_NEAR(beyond, 15, 1) << this->name(solver);
  }
}

/// Whatever the frequency, and wherever in a sub-step the limit is passed.
TYPED_TEST(SoftLimits, return_no_more_than_they_took) {
  using S = TypeParam;
  Dice dice(7);
  for (const SolverName solver : kBuiltSolvers) {
    int returned = 0;
    for (int i = 0; i < 40; ++i) {
      const double frequency = dice.magnitude(1, 240), speed = dice.in(0.5, 8),
                   damping = i % 2 == 0 ? 0 : dice.in(0, 2);
      const JointAxis axis = i % 4 < 2 ? JointAxis::z : JointAxis::twist;
      Hung<S> h = this->hang(solver, this->soft(axis, -0.3, dice.in(0.1, 0.3), frequency, damping), 0);
      const D3 push = {0, 0, speed}, none = {0, 0, 0};
      h.world.set_velocity(h.body, vec<S>(is_length(axis) ? push : none), vec<S>(is_length(axis) ? none : push));
      double fastest = speed;
      for (int frame = 0; frame < 240; ++frame) {
        ASSERT_TRUE(h.world.step().clean());
        const double v =
            std::fabs(to_double(is_length(axis) ? h.world.velocity(h.body).z : h.world.angular_velocity(h.body).z));
        ASSERT_LE(v, fastest + 0.01) << this->name(solver) << ' ' << frequency << ' ' << speed << ' ' << frame;
      }
      returned += this->at(h, axis) < 0.05;
    }
    EXPECT_GT(returned, 10) << this->name(solver);  // the limits were met
  }
}

/// w^2 = w1^2 + w2^2, about the weighted mean of both targets.
TYPED_TEST(SoftLimits, add_to_the_spring_of_their_axis) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    AxisDrive<S> drive = this->soft(JointAxis::x, -0.25, 0.25, 4, 1);
    drive.spring_frequency = S(3);
    drive.spring_damping = S(1);
    drive.spring_target = S(1);
    Hung<S> h = this->hang(solver, drive, 0);
    this->run(h, 300);
    EXPECT_NEAR(this->at(h, JointAxis::x), (0.25 * 16 + 1.0 * 9) / 25, 0.001) << this->name(solver);
  }
}

/// A servo pushes a body as far as the limit, and leaves it there.
TYPED_TEST(SoftLimits, let_a_servo_rest) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    AxisDrive<S> drive = this->soft(JointAxis::x, -0.25, 0.25, 6, 1);
    drive.spring_frequency = S(2);
    drive.spring_damping = S(1);
    drive.spring_target = S(1);
    drive.max_force = S(20);
    Hung<S> h = this->hang(solver, drive, 0);
    this->run(h, 300);
    EXPECT_NEAR(this->at(h, JointAxis::x), 0.25, 0.002) << this->name(solver);
    for (int i = 0; i < 300; ++i) {  // what pushes further is met by the limit alone: 20 N / (2 kg w^2)
      h.world.apply_force(h.body, vec<S>(20, 0, 0));
      ASSERT_TRUE(h.world.step().clean());
    }
    const double w = kTurn * 6;
    EXPECT_NEAR(this->at(h, JointAxis::x), 0.25 + 10 / (w * w), 0.002) << this->name(solver);
  }
}

/// A motor that pushes on sinks in by its force.
TYPED_TEST(SoftLimits, hold_a_motor) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    AxisDrive<S> drive = this->soft(JointAxis::x, -0.25, 0.25, 3, 1);
    drive.motor = true;
    drive.motor_speed = S(1);
    drive.max_force = S(20);
    Hung<S> h = this->hang(solver, drive, 0);
    this->run(h, 300);
    const double w = kTurn * 3;
    EXPECT_NEAR(this->at(h, JointAxis::x), 0.25 + 10 / (w * w), 0.002) << this->name(solver);
  }
}

/// A rod that leans out of its cone: how far is the same in every direction of a round cone.
TYPED_TEST(SoftLimits, of_a_cone_yield_along_the_swing) {
  using S = TypeParam;
  double lean[2] = {0, 0};
  for (const int way : {0, 1}) {
    World<S> w(settings<S>(0, 60, 8));
    const BodyId b = w.create(moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 0, 0}));
    SixAxisDefinition<S> joint;
    joint.b = b;
    joint.locks = joint_flag::kLockPoint | joint_flag::kLockTwist | joint_flag::kCone;
    joint.drives[joint.drive_count++] = this->soft(JointAxis::swing_x, -0.4, 0.4, 3, 1);
    joint.drives[joint.drive_count++] = this->soft(JointAxis::swing_y, -0.4, 0.4, 3, 1);
    const JointId made = w.create(six_axis(joint));
    ASSERT_TRUE(made) << describe(w.fault());
    const double torque = 0.25, diagonal = torque * 0.70710678;
    for (int i = 0; i < 300; ++i) {
      w.apply_force(b, vec<S>(0, 0, 0), way == 0 ? vec<S>(torque, 0, 0) : vec<S>(diagonal, diagonal, 0));
      ASSERT_TRUE(w.step().clean());
    }
    const double x = to_double(w.joint_position(made, JointAxis::swing_x));
    const double y = to_double(w.joint_position(made, JointAxis::swing_y));
    lean[way] = std::sqrt(x * x + y * y);
    const double inertia = to_double(w.mass(b)) * (0.25 * 0.25 * 2) / 3, rate = kTurn * 3;
    EXPECT_NEAR(lean[way], 0.4 + torque / (inertia * rate * rate), 0.01) << way;
  }
  EXPECT_NEAR(lean[0], lean[1], 0.01);
}

/// Stiffness is that of the mass that a spring is made for: twice the box's, and it sags by half.
TYPED_TEST(SoftLimits, and_springs_are_as_stiff_as_the_mass_says_that_they_are_made_for) {
  using S = TypeParam;
  const double w = kTurn * 2;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double made_for : {1.0, 4.0}) {
      AxisDrive<S> limit = this->soft(JointAxis::y, -0.5, 1, 2, 1);
      limit.spring_mass = num<S>(made_for);
      Hung<S> h = this->hang(solver, limit, -9.8);
      this->run(h, 300);
      EXPECT_NEAR(this->at(h, JointAxis::y), -0.5 - 2 / made_for * 9.8 / (w * w), 0.002) << this->name(solver);
    }
  }
}

/// A box of 0.25 m and 2 kg turns about the world's z axis on a spring that is made for an inertia twice as large: its
/// swings are faster by the root of 2.
TYPED_TEST(SoftLimits, of_a_turn_are_made_for_an_inertia) {
  using S = TypeParam;
  const double inertia = 2 * (0.25 * 0.25 + 0.25 * 0.25) / 3;
  for (const SolverName solver : kBuiltSolvers) {
    AxisDrive<S> spring;
    spring.axis = JointAxis::twist;
    spring.spring_frequency = S(1);
    spring.spring_mass = num<S>(2 * inertia);
    Hung<S> h = this->hang(solver, spring, 0);
    h.world.set_velocity(h.body, vec<S>(0, 0, 0), vec<S>(0, 0, 1));
    int passed = 0;
    double before = 0;
    for (int i = 0; i < 600; ++i) {
      ASSERT_TRUE(h.world.step().clean());
      const double now = this->at(h, JointAxis::twist);
      passed += before < 0 && now >= 0;
      before = now;
    }
    EXPECT_NEAR(passed, 10 * 1.41421356, 1.5) << this->name(solver);
    EXPECT_NEAR(to_double(h.world.inertia(h.body, vec<Unit<S>>({0, 0, 1}))), inertia, 0.001);
  }
}

TYPED_TEST(SoftLimits, go_back_exactly) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    Hung<S> h = this->hang(solver, this->soft(JointAxis::y, -0.25, 0.25, 2, 0.125), -9.8);
    bool passed = false;
    expect_exact_rollback(h.world, 120, [&](World<S>& w, int) {
      passed = passed || to_double(w.joint_position(h.joint, JointAxis::y)) < -0.25;
    });
    EXPECT_TRUE(passed) << this->name(solver);
  }
}

TYPED_TEST(SoftLimits, that_are_none_are_refused) {
  using S = TypeParam;
  Hung<S> h = this->hang(SolverName::soft_step, this->soft(JointAxis::y, -1, 1, 2, 1), 0);
  const std::uint64_t before = h.world.hash();
  const auto refused = [&](double frequency, double damping, double mass, const char* field) {
    SixAxisDefinition<S> joint;
    joint.b = h.body;
    AxisDrive<S>& drive = joint.drives[joint.drive_count++];
    drive = this->soft(JointAxis::x, -1, 1, frequency, damping);
    drive.spring_mass = num<S>(mass);
    EXPECT_FALSE(h.world.create(six_axis(joint)));
    EXPECT_STREQ(h.world.fault().field, field) << describe(h.world.fault());
    EXPECT_EQ(h.world.hash(), before);
  };
  refused(-1, 1, 0, "limit_frequency");
  refused(241, 1, 0, "limit_frequency");
  refused(2, -1, 0, "limit_damping");
  refused(2, 65, 0, "limit_damping");
  refused(2, 1, -1, "spring_mass");
}

}  // namespace soft_limits_test
}  // namespace isostep::test
