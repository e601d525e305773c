// Laws of springs of six-axis joints' swings: as stiff whichever way they lean, without energy from nowhere.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "laws/six_axis.hpp"

namespace isostep::test {
namespace six_axis_springs_test {

template <class S> class SixAxisSprings : public SixAxis<S> {};
TYPED_TEST_SUITE(SixAxisSprings, AllScalars);

/// Springs alike, made for what each swing feels of a plank: ten times as much about one axis as about the other. The
/// swing bears the load that its own spring bears, wherever in the ellipse.
TYPED_TEST(SixAxisSprings, springs_of_a_cone_are_as_stiff_in_its_middle_as_at_its_edge) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    double torque_at[2] = {};
    for (const double angle : {0.25, 0.75}) {
      World<S> w(this->with(solver));
      const BodyId b = this->box(w, {0, 0, 0}, 1, 0.7, 0.05, 0.1);
      SixAxisDefinition<S> joint;
      joint.b = b;
      joint.locks = joint_flag::kLockPoint | joint_flag::kCone | joint_flag::kLockTwist;
      for (const JointAxis axis : {JointAxis::swing_x, JointAxis::swing_y}) {
        AxisDrive<S> drive = this->limit(axis, -1, 1);
        drive.spring_frequency = S(1);
        drive.spring_damping = S(1);
        joint.drives[joint.drive_count++] = drive;
      }
      const JointId id = w.create(six_axis(joint));
      ASSERT_TRUE(id) << describe(w.fault());
      // Of the same stiffness everywhere: k = I w^2 of the stiffer axis, about y.
      const double inertia = to_double(w.inertia(b, {Unit<S>(0), Unit<S>(1), Unit<S>(0)}));
      const double torque = inertia * 4 * kPi * kPi * angle;
      for (int i = 0; i < 480; ++i) {
        w.apply_force(b, Vec3<S>::zero(), vec<S>(0, torque, 0));
        ASSERT_TRUE(w.step().clean());
      }
      const double swing = to_double(w.joint_position(id, JointAxis::swing_y));
      torque_at[angle < 0.5 ? 0 : 1] = swing / angle;
    }
    EXPECT_NEAR(torque_at[0], 1, 0.05) << this->name(solver);
    EXPECT_NEAR(torque_at[1], 1, 0.05) << this->name(solver);
  }
}

/// Of one swing, of both alike, of both unlike: the rows turn with the swing, and nothing may come of that. Springs of
/// both swings beside a held twist gain a hundredth a second in any case, without a cone too.
TYPED_TEST(SixAxisSprings, springs_of_a_cone_give_no_energy) {
  using S = TypeParam;
  const double frequencies[][2] = {{1, 0}, {0, 2}, {1, 1}, {0.4, 1.2}};
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    for (const auto& f : frequencies) {
      World<S> w(this->with(solver));
      const BodyId b = this->box(w, {0, 0, 0}, 1, 0.5, 0.25, 0.25);
      SixAxisDefinition<S> joint;
      joint.b = b;
      joint.locks = joint_flag::kLockPoint | joint_flag::kCone | joint_flag::kLockTwist;
      for (int i = 0; i < 2; ++i) {
        AxisDrive<S> drive = this->limit(i == 0 ? JointAxis::swing_x : JointAxis::swing_y, -1.5, 1.5);
        drive.spring_frequency = num<S>(f[i]);
        joint.drives[joint.drive_count++] = drive;
      }
      ASSERT_TRUE(w.create(six_axis(joint))) << describe(w.fault());
      ASSERT_TRUE(w.set_velocity(b, Vec3<S>::zero(), vec<S>(3, 2, 0)));
      const double start = kinetic_energy(w.view(b));
      double most = 0;
      for (int i = 0; i < 600; ++i) {
        ASSERT_TRUE(w.step().clean());
        most = std::max(most, kinetic_energy(w.view(b)));
      }
      EXPECT_LT(most, 1.2 * start) << this->name(solver) << ' ' << f[0] << ' ' << f[1];
    }
  }
}

/// A swing comes back at half a turn, so its spring pulls by the way that it came.
TYPED_TEST(SixAxisSprings, a_spring_of_a_swing_pulls_back_the_way_it_came) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    World<S> w(this->with(solver));
    const BodyId b = this->box(w, {0, 0, 0});
    SixAxisDefinition<S> joint;
    joint.b = b;
    joint.locks = joint_flag::kLockPoint;
    AxisDrive<S> drive;
    drive.axis = JointAxis::swing_y;
    drive.spring_frequency = S(1);
    drive.spring_damping = S(1);
    drive.spring_target = num<S>(-1.7);
    joint.drives[joint.drive_count++] = drive;
    const JointId id = w.create(six_axis(joint));
    ASSERT_TRUE(id) << describe(w.fault());
    run(w, 240);
    EXPECT_NEAR(to_double(w.joint_position(id, JointAxis::swing_y)), -1.7, 0.02) << this->name(solver);
    const AxisDriveId spring = w.axis_drive(id, JointAxis::swing_y);
    AxisDrive<S> other = *w.find(spring);
    other.spring_target = num<S>(1.9);  // further than half a turn
    ASSERT_TRUE(w.set(spring, other));
    run(w, 300);
    EXPECT_NEAR(to_double(w.joint_position(id, JointAxis::swing_y)), 1.9, 0.02) << this->name(solver);
  }
}

}  // namespace six_axis_springs_test
}  // namespace isostep::test
