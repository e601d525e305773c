// The commands about joints: what an accepted one does, and that a refused one names its fault and changes nothing.
// SPDX-License-Identifier: MIT
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace {

template <class S> class JointCommands : public CommandedWorld<S> {};
TYPED_TEST_SUITE(JointCommands, AllScalars);

TYPED_TEST(JointCommands, bad_joints_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const auto expect_bad = [&](Fault fault, auto&& change) {
    JointProperties<S> j = w.joint_at(JointType::hinge, this->flier, this->sleeper, Pose<S>::identity());
    change(j);
    this->expect_refused(fault, [&] { return w.create(j); });
  };
  expect_bad(Fault::bad_argument, [](auto& j) { j.type = static_cast<JointType>(kJointTypes); });
  expect_bad(Fault::bad_argument, [](auto& j) { j.flags = 1u << 5; });
  expect_bad(Fault::bad_argument, [](auto& j) { j.lower = S(1); });
  expect_bad(Fault::bad_argument, [](auto& j) { j.motor_torque = S(-1); });
  expect_bad(Fault::bad_argument, [](auto& j) { j.flags = joint_flag::kSpring; });
  expect_bad(Fault::bad_argument, [](auto& j) {
    j.flags = joint_flag::kSpring;
    j.spring_frequency = S(1000);
  });
  expect_bad(Fault::bad_argument, [](auto& j) { j.frame_a.orientation.w = Unit<S>(0.25); });
  expect_bad(Fault::bad_argument, [](auto& j) {
    j.type = JointType::distance;
    j.lower = S(-1);
  });
  expect_bad(Fault::bad_argument, [](auto& j) { j.body_b = j.body_a; });
  expect_bad(Fault::stale_id, [](auto& j) { j.body_b = 12345; });
  expect_bad(Fault::out_of_range, [](auto& j) { j.frame_a.position.x = Limits<S>::position() + S(1); });
  expect_bad(Fault::not_dynamic, [&](auto& j) {
    j.body_a = this->ground.slot;
    j.body_b = this->kinematic.slot;
  });
  expect_bad(Fault::not_dynamic, [](auto& j) { j.body_a = j.body_b = kNoBody; });
  JointProperties<S> j = *w.joint(this->joint);
  j.type = JointType::ball;
  this->expect_refused(Fault::bad_argument, [&] { return w.set_joint(this->joint, j); });
}

TYPED_TEST(JointCommands, a_joint_set_anew_keeps_its_bodies_and_frames) {
  using S = TypeParam;
  World<S>& w = this->world;
  JointProperties<S> j = *w.joint(this->joint);
  const JointProperties<S> old = j;
  j.body_a = this->sleeper.slot;
  j.frame_b.position = vec<S>(1, 1, 1);
  j.upper = S(3);
  j.user_data = 7;
  ASSERT_TRUE(w.set_joint(this->joint, j));
  EXPECT_EQ(w.joint(this->joint)->body_a, old.body_a);
  EXPECT_EQ(w.joint(this->joint)->frame_b.position, old.frame_b.position);
  EXPECT_EQ(w.joint(this->joint)->upper, S(3));
  EXPECT_EQ(w.joint(this->joint)->user_data, 7u);
}

}  // namespace
}  // namespace isostep::test
