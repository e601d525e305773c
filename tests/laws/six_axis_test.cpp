// Laws of six-axis joints: what each axis holds, lets move, drives and bounds, in every scalar and solver.
// SPDX-License-Identifier: MIT

#include "laws/six_axis.hpp"

#include <algorithm>

#include "built.hpp"

namespace isostep::test {
namespace six_axis_test {

TYPED_TEST_SUITE(SixAxis, AllScalars);

constexpr std::uint32_t kAllLocks = joint_flag::kLockPoint | joint_flag::kLockTurns;

TYPED_TEST(SixAxis, moves_along_the_axis_that_is_not_locked_and_along_no_other) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint32_t i = 0; i < kJointAxes; ++i) {
      const JointAxis axis = static_cast<JointAxis>(i);
      World<S> w(this->with(solver));
      const BodyId b = this->box(w, {0, 0, 0});
      const JointId joint = w.create(
          six_axis<S>({.b = b, .frame = this->at({0, 0, 0}), .locks = kAllLocks & ~lock_of(axis), .drives = {}}));
      ASSERT_TRUE(joint) << describe(w.fault());
      const int k = static_cast<int>(i % 3);
      D3 push = {0.5, 0.5, 0.5};
      push[k] = 1;
      for (int frame = 0; frame < 60; ++frame) {
        w.apply_force(b, vec<S>(push), vec<S>(push * 0.125));
        ASSERT_TRUE(w.step().clean());
      }
      const D3 v = real(w.velocity(b)), turning = real(w.angular_velocity(b));
      for (int other = 0; other < 3; ++other) {
        const std::string what = this->name(solver) + ", axis " + std::to_string(i) + ", " + std::to_string(other);
        const bool goes = other == k, way = is_length(axis);
        EXPECT_NEAR(v[other], goes && way ? 1 : 0, 0.02) << what;
        if (goes && !way) EXPECT_GT(turning[other], 0.5) << what;
        else EXPECT_NEAR(turning[other], 0, 0.02) << what;
      }
      const double moved = to_double(w.joint_position(joint, axis));
      EXPECT_GT(moved, 0.3) << this->name(solver) << i;
      for (std::uint32_t other = 0; other < kJointAxes; ++other) {
        if (other != i) {
          EXPECT_NEAR(to_double(w.joint_position(joint, static_cast<JointAxis>(other))), 0, 0.01) << other;
        }
      }
    }
  }
}

/// Full force past the speed that is asked for would carry it over both limits within a sub-step: a motor that leaves a
/// stop takes its own speed first.
TYPED_TEST(SixAxis, a_strong_motor_leaves_a_stop_at_its_own_speed) {
  using S = TypeParam;
  struct Case {
    bool slides;
    double mass, half, range, force, speed;  // [kg], [m], [m] or [rad], [N] or [N m], [m/s] or [rad/s]
  };
  const Case cases[] = {
      {true, 1, 0.25, 0.02, 20000, 0.1}, {true, 1, 0.25, 2, 20000, 1}, {false, 0.125, 0.0625, 0.5, 50, 0.5}};
  for (const SolverName solver : all_but({SolverName::worst_first, SolverName::avbd})) {
    for (const Case& of : cases) {
      World<S> w(this->with(solver));
      const BodyId b = this->box(w, {0, 0, 0}, of.mass, of.half, of.half, of.half);
      OneAxisJoint<S> joint;
      joint.b = b;
      joint.limit = {{S(0), num<S>(of.range)}};
      joint.motor = {{.speed = num<S>(-of.speed), .max_force = num<S>(of.force)}};
      const JointId id = of.slides ? w.create(slider(joint)) : w.create(hinge(joint));
      ASSERT_TRUE(id) << describe(w.fault());
      double last = 0, reached = 0;
      for (int frame = 0; frame < 360; ++frame) {
        if (frame % 60 == 0) {
          JointProperties<S> properties = *w.joint(id);
          properties.motor_speed = num<S>(frame / 60 % 2 == 0 ? -of.speed : of.speed);
          ASSERT_TRUE(w.set_joint(id, properties)) << describe(w.fault());
        }
        w.step();
        const double place = to_double(w.joint_position(id));
        const std::string what = this->name(solver) + ", range " + std::to_string(of.range);
        ASSERT_LT(std::abs(place - last), of.speed / 60 * 1.05 + 0.001) << what << ", frame " << frame;
        ASSERT_GT(place, -0.002) << what << ", frame " << frame;
        ASSERT_LT(place, of.range + 0.002) << what << ", frame " << frame;
        last = place;
        reached = std::max(reached, place);
      }
      EXPECT_GT(reached, std::min(of.range, of.speed) * 0.9) << this->name(solver);
    }
  }
}

TYPED_TEST(SixAxis, swings_as_a_hinge_where_two_turns_are_locked) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::pgs, SolverName::worst_first})) {
    World<S> w(this->with(solver, -10));
    const BodyId first = this->box(w, {1, 0, 0}), second = this->box(w, {1, 0, 8});
    const JointId one = w.create(six_axis<S>({.b = first,
                                              .frame = this->at({0, 0, 0}),
                                              .locks = joint_flag::kLockPoint | joint_flag::kLockSwing,
                                              .drives = {}}));
    const JointId other = w.create(hinge<S>({.b = second, .frame = this->at({0, 0, 8})}));
    for (int i = 0; i < 90; ++i) {
      w.step();
      const D3 a = real(w.pose(first).position), b = real(w.pose(second).position);
      ASSERT_NEAR(a.x, b.x, 0.01) << i;
      ASSERT_NEAR(a.y, b.y, 0.01) << i;
      const double twist = to_double(w.joint_position(one, JointAxis::twist)),
                   turn = to_double(w.joint_position(other));
      ASSERT_NEAR(std::remainder(twist - turn, 2 * kPi), 0, 0.01) << i;
    }
  }
}

TYPED_TEST(SixAxis, stops_at_the_limits_of_each_axis) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint32_t i = 0; i < kJointAxes; ++i) {
      const JointAxis axis = static_cast<JointAxis>(i);
      for (const double side : {-1.0, 1.0}) {
        World<S> w(this->with(solver));
        const BodyId b = this->box(w, {0, 0, 0});
        SixAxisDefinition<S> joint;
        joint.b = b;
        joint.locks = kAllLocks & ~lock_of(axis);
        joint.drives[joint.drive_count++] = this->limit(axis, -0.25, 0.5);
        const JointId id = w.create(six_axis(joint));
        ASSERT_TRUE(id) << describe(w.fault());
        D3 push = {0, 0, 0};
        push[static_cast<int>(i % 3)] = side * 2;
        double least = 0, most = 0;
        for (int frame = 0; frame < 180; ++frame) {
          w.apply_force(b, is_length(axis) ? vec<S>(push) : vec<S>(D3{0, 0, 0}),
                        is_length(axis) ? vec<S>(D3{0, 0, 0}) : vec<S>(push * 0.25));
          ASSERT_TRUE(w.step().clean());
          const double place = to_double(w.joint_position(id, axis));
          least = std::min(least, place);
          most = std::max(most, place);
        }
        const std::string what = this->name(solver) + ", axis " + std::to_string(i);
        EXPECT_NEAR(to_double(w.joint_position(id, axis)), side < 0 ? -0.25 : 0.5, 0.005) << what;
        EXPECT_GT(least, -0.27) << what;
        EXPECT_LT(most, 0.52) << what;
      }
    }
  }
}

TYPED_TEST(SixAxis, a_servo_holds_what_it_is_strong_enough_for_and_yields_to_more) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    for (const double mass : {1.0, 2.0}) {
      World<S> w(this->with(solver, -10));
      const BodyId b = this->box(w, {0, 8, 0}, mass);
      SixAxisDefinition<S> joint;
      joint.b = b;
      joint.frame = this->at({0, 8, 0});
      joint.locks = kAllLocks & ~joint_flag::kLockY;
      AxisDrive<S> servo;
      servo.axis = JointAxis::y;
      servo.spring_frequency = S(2);
      servo.spring_damping = S(1);
      servo.max_force = S(15);
      joint.drives[joint.drive_count++] = servo;
      const JointId id = w.create(six_axis(joint));
      const std::string what = this->name(solver) + ", " + std::to_string(mass) + " kg";
      for (int i = 0; i < 60; ++i) w.step();
      if (mass == 1) {  // sag g / (2 pi f)^2
        for (int i = 0; i < 120; ++i) w.step();
        EXPECT_NEAR(to_double(w.joint_position(id, JointAxis::y)), -10 / (16 * kPi * kPi), 0.004) << what;
      } else {  // 20 N less 15 N, but for the first moments
        const double before = to_double(w.velocity(b).y);
        for (int i = 0; i < 30; ++i) w.step();
        EXPECT_NEAR((to_double(w.velocity(b).y) - before) / 0.5, -2.5, 0.05) << what;
        EXPECT_LT(to_double(w.joint_position(id, JointAxis::y)), -1) << what;
      }
    }
  }
}

TYPED_TEST(SixAxis, a_brake_stops_a_spin_as_coulomb_says) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    World<S> w(this->with(solver));
    const BodyId b = this->box(w, {0, 0, 0}, 3);
    w.set_velocity(b, Vec3<S>::zero(), vec<S>(D3{0, 0, 4}));
    SixAxisDefinition<S> joint;
    joint.b = b;
    joint.locks = joint_flag::kLockPoint;
    AxisDrive<S> brake;
    brake.axis = JointAxis::twist;
    brake.motor = true;
    brake.max_force = num<S>(0.25);
    joint.drives[joint.drive_count++] = brake;
    ASSERT_TRUE(w.create(six_axis(joint)));
    const double inertia = 3 * (0.5 * 0.5 + 0.5 * 0.5) / 12;  // 0.125: 2 rad/s^2
    for (int i = 0; i < 60; ++i) w.step();
    EXPECT_NEAR(to_double(w.angular_velocity(b).z), 4 - 0.25 / inertia, 0.03) << this->name(solver);
    for (int i = 0; i < 90; ++i) w.step();
    EXPECT_NEAR(to_double(w.angular_velocity(b).z), 0, 0.002) << this->name(solver);
  }
}

/// z of b in a, as tangents of half swings over those of the half axes: 1 on the ellipse.
template <class S> double ellipse(const World<S>& w, BodyId b, double about_x, double about_y) {
  const D3 d = to_matrix(joint_angles_detail::wide(w.pose(b).orientation)).column(2);
  return std::hypot(d.y / (1 + d.z) / std::tan(about_x / 2), d.x / (1 + d.z) / std::tan(about_y / 2));
}

TYPED_TEST(SixAxis, a_cone_is_an_ellipse) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    for (int way = 0; way < 8; ++way) {
      World<S> w(this->with(solver));
      const BodyId b = this->box(w, {0, 0, 0});
      SixAxisDefinition<S> joint;
      joint.b = b;
      joint.locks = joint_flag::kLockPoint | joint_flag::kCone;
      joint.drives[joint.drive_count++] = this->limit(JointAxis::swing_x, -0.4, 0.4);
      joint.drives[joint.drive_count++] = this->limit(JointAxis::swing_y, -1.0, 1.0);
      joint.drives[joint.drive_count++] = this->limit(JointAxis::twist, -0.25, 0.25);
      ASSERT_TRUE(w.create(six_axis(joint))) << describe(w.fault());
      const double angle = way * kPi / 4;
      const D3 torque = D3{std::cos(angle), std::sin(angle), 0.25} * 0.5;
      double worst = 0, last = 0;
      for (int i = 0; i < 240; ++i) {
        w.apply_force(b, Vec3<S>::zero(), vec<S>(torque));
        ASSERT_TRUE(w.step().clean());
        last = ellipse(w, b, 0.4, 1.0);
        worst = std::max(worst, last);
      }
      const std::string what = this->name(solver) + ", way " + std::to_string(way);
      EXPECT_LT(worst, 1.1) << what;
      EXPECT_NEAR(last, 1, 0.03) << what;
    }
  }
}

TYPED_TEST(SixAxis, is_rolled_back_with_all_its_drives) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step, -10));
  BodyId last = {};
  std::vector<JointId> joints;
  for (int i = 0; i < 4; ++i) {
    const BodyId b = this->box(w, {0.75 * i, 6, 0});
    SixAxisDefinition<S> joint;
    joint.a = last;
    joint.b = b;
    joint.frame = this->at({0.75 * i - 0.375, 6, 0});
    joint.locks = joint_flag::kLockPoint | joint_flag::kCone;
    joint.drives[joint.drive_count++] = this->limit(JointAxis::swing_x, -0.5, 0.5);
    joint.drives[joint.drive_count++] = this->limit(JointAxis::swing_y, -1.0, 1.0);
    AxisDrive<S> servo = this->limit(JointAxis::twist, -0.5, 0.25);
    servo.spring_frequency = S(2);
    servo.max_force = S(3);
    joint.drives[joint.drive_count++] = servo;
    joints.push_back(w.create(six_axis(joint)));
    ASSERT_TRUE(joints.back()) << describe(w.fault());
    last = b;
  }
  bool held = false;
  expect_exact_rollback<S>(w, 120, [&](World<S>& world, int frame) {
    for (const JointState<S>& joint : world.state().joints.states)
      held = held || (joint.has_drive(5) && detail::fixes_speed(joint.piece(5)));
    if (frame == 80) {
      const AxisDriveId id = world.axis_drive(joints[0], JointAxis::swing_y);
      ASSERT_TRUE(id);
      AxisDrive<S> changed = *world.find(id);
      changed.motor = true;
      changed.max_force = S(4);
      world.set(id, changed);
    }
  });
  EXPECT_TRUE(held);
}

TYPED_TEST(SixAxis, refuses_what_no_axis_can_do) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  const BodyId b = this->box(w, {0, 0, 0});
  const JointId hinged = w.create(hinge<S>({.b = b}));
  const JointId joint = w.create(six_axis<S>({.b = b, .locks = joint_flag::kLockX | joint_flag::kCone, .drives = {}}));
  const std::uint64_t before = w.hash();
  const auto refused = [&](AxisDrive<S> d, const char* field) {
    EXPECT_FALSE(w.add(d));
    EXPECT_STREQ(w.fault().field, field) << describe(w.fault());
    EXPECT_EQ(w.hash(), before);
  };
  AxisDrive<S> d = this->limit(JointAxis::y, 0, 1);
  refused(d, "joint");
  d.joint = hinged;
  refused(d, "joint");
  d.joint = joint;
  d.axis = JointAxis::x;
  refused(d, "axis");
  d.axis = static_cast<JointAxis>(6);
  refused(d, "axis");
  d.axis = JointAxis::swing_x;
  refused(d, "lower");  // kCone: an ellipse about the middle
  d.axis = JointAxis::twist;
  d.upper = S(4);
  refused(d, "upper");
  d.upper = S(-1);
  refused(d, "lower");
  d.upper = S(1);
  d.max_force = S(-1);
  refused(d, "max_force");
  d.max_force = S(0);
  d.spring_frequency = S(241);
  refused(d, "spring_frequency");
  d.spring_frequency = S(2);
  d.spring_damping = S(65);
  refused(d, "spring_damping");
  d.spring_damping = S(1);
  EXPECT_TRUE(w.add(d));
  EXPECT_FALSE(w.add(d));  // that axis has one
  EXPECT_STREQ(w.fault().field, "axis");
  JointProperties<S> p = *w.joint(joint);
  p.flags |= joint_flag::kLockTwist;
  EXPECT_FALSE(w.set_joint(joint, p));
  EXPECT_STREQ(w.fault().field, "flags");
  SixAxisDefinition<S> twice;
  twice.b = b;
  twice.drives[0] = twice.drives[1] = this->limit(JointAxis::z, 0, 1);
  twice.drive_count = 2;
  const std::uint64_t now = w.hash();
  EXPECT_FALSE(w.create(six_axis(twice)));
  EXPECT_STREQ(w.fault().field, "axis");
  EXPECT_EQ(w.hash(), now);
  EXPECT_TRUE(w.destroy(joint));
  EXPECT_TRUE(w.state().records->axis_drives.slot_map().template ids<AxisDriveId>().empty());
}

}  // namespace six_axis_test
}  // namespace isostep::test
