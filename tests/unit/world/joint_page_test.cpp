// The joints and records that the page of joints (dynamics/joints/README.md) shows: its code, in a world.
// SPDX-License-Identifier: MIT
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace joint_page_test {

template <class S> class JointPage : public ::testing::Test {
 protected:
  JointPage() : world_(settings<S>()) {}
  BodyId ball_at(double x) { return world_.create(moving<S>(add_ball(world_, 0.25), {x, 2, 0})); }
  JointId tied(JointType type, double x) {
    const BodyId ball = ball_at(x);
    return world_.create(world_.joint_at(type, {}, ball, {vec<S>(x, 2, 0), Quat<Unit<S>>::identity()}));
  }
  JointId rope_at(double x) {
    const Vec3<S> top = vec<S>(x, 4, 0), end = vec<S>(x, 2, 0);
    return world_.create(rope<S>({.b = ball_at(x), .anchor_a = top, .anchor_b = end, .length = S(8)}));
  }

  World<S> world_;
};
TYPED_TEST_SUITE(JointPage, AllScalars);

TYPED_TEST(JointPage, describes_joints_by_their_names) {
  using S = TypeParam;
  World<S>& world = this->world_;
  const BodyId frame = this->ball_at(0), door = this->ball_at(1), lamp = this->ball_at(4);
  const Pose<S> pin = {vec<S>(0.5, 2, 0), Quat<Unit<S>>::identity()};
  const Vec3<S> hook = vec<S>(4, 4, 0), top = vec<S>(4, 2.25, 0);
  // README: begin
  world.create(hinge<S>(
      {.a = frame, .b = door, .frame = pin, .limit = {{S(0), S(2)}}, .motor = {{.speed = S(1), .max_force = S(5)}}}));
  world.create(rope<S>({.b = lamp, .anchor_a = hook, .anchor_b = top, .length = S(2)}));
  // README: end
  ASSERT_EQ(world.joints().size(), 2u) << describe(world.first_fault());
  const JointProperties<S>&hinged = *world.joint(world.joints()[0]), &hung = *world.joint(world.joints()[1]);
  EXPECT_EQ(hinged.flags, joint_flag::kLimit | joint_flag::kMotor);
  EXPECT_EQ(hinged.lower, S(0));
  EXPECT_EQ(hinged.upper, S(2));
  EXPECT_EQ(hinged.motor_speed, S(1));
  EXPECT_EQ(hinged.max_force, S(5));
  EXPECT_EQ(hung.flags, joint_flag::kLimit);
  EXPECT_EQ(hung.upper, S(2));
}

TYPED_TEST(JointPage, couples_joints_and_measures_them) {
  using S = TypeParam;
  World<S>& world = this->world_;
  const JointId small = this->tied(JointType::hinge, 0), large = this->tied(JointType::hinge, 1);
  const JointId rope_a = this->rope_at(2), rope_b = this->rope_at(3), hook = this->tied(JointType::ball, 4);
  // README: begin
  world.add(gears<S>(small, 20, large, 40));         // hinges: whole teeth, so that no turn is counted
  world.add(pulley<S>(rope_a, rope_b, S(1), S(8)));  // ropes of 8 m together
  JointLoad<S> load;
  load.joint = hook;
  load.break_force = S(500);  // [N]
  world.add(load);
  // README: end
  EXPECT_EQ(world.state().records->couplings.slot_map().count_taken(), 2u) << describe(world.first_fault());
  EXPECT_EQ(world.state().records->joint_loads.slot_map().count_taken(), 1u) << describe(world.first_fault());
}

}  // namespace joint_page_test
}  // namespace isostep::test
