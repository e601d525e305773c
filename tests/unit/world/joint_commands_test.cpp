// The commands about joints: what an accepted one does, and that a refused one names its fault and changes nothing.
// SPDX-License-Identifier: MIT
#include "isostep/store/state_validator.hpp"
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace joint_commands_test {

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
  expect_bad(Fault::bad_argument, [](auto& j) { j.max_force = S(-1); });
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

TYPED_TEST(JointCommands, a_frame_without_an_orientation_is_refused) {
  using S = TypeParam;
  using U = Unit<S>;
  World<S>& w = this->world;
  for (const Quat<U> none : {Quat<U>{U(0), U(0), U(0), U(0)}, Quat<U>{U(0), U(0.5), U(0), U(0)}}) {
    const Pose<S> frame = {{S(0), S(1), S(0)}, none};
    this->expect_refused(Fault::bad_argument,
                         [&] { return w.create(hinge<S>({.a = this->flier, .b = this->sleeper, .frame = frame})); });
    EXPECT_STREQ(w.fault().field, "frame_a.orientation");
    this->expect_refused(Fault::bad_argument, [&] { return w.create(hinge<S>({.b = this->sleeper, .frame = frame})); });
  }
}

/// A format resolves masses up to Limits::mass_ratio() apart: joints are refused beyond, and so are changes of mass.
TYPED_TEST(JointCommands, a_joint_of_masses_too_unlike_is_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const auto body_of = [&](S mass) {
    BodyDefinition<S> d = moving<S>(add_box(w, 1, 1, 1), {0, 50, 0});
    d.mass = mass;
    return w.create(d);
  };
  const S most = Limits<S>::mass_ratio(), twice = most + most;
  const BodyId light = body_of(S(1)), heavy = body_of(most), heavier = body_of(twice);
  const Pose<S> there = {vec<S>(0, 50, 0), Quat<Unit<S>>::identity()};
  const auto tie = [&](BodyId a, BodyId b) { return w.create(ball<S>({.a = a, .b = b, .frame = there})); };
  EXPECT_TRUE(tie(light, heavy)) << describe(w.fault());
  EXPECT_TRUE(tie({}, heavier)) << describe(w.fault());
  this->expect_refused(Fault::out_of_range, [&] { return tie(light, heavier); });
  EXPECT_STREQ(w.fault().field, "body_a, body_b");
  this->expect_refused(Fault::out_of_range, [&] { return w.set_mass(heavy, {.mass = twice}); });
  EXPECT_STREQ(w.fault().field, "mass");
  this->expect_refused(Fault::out_of_range, [&] { return w.set_mass(light, {.mass = S(0.25)}); });
  EXPECT_TRUE(w.set_mass(light, {.mass = S(2)})) << describe(w.fault());
  EXPECT_TRUE(w.set_mass(heavy, {.mass = twice})) << describe(w.fault());
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

TYPED_TEST(JointCommands, more_drives_than_axes_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  SixAxisDefinition<S> six;
  six.b = this->flier;
  for (std::uint32_t i = 0; i < kJointAxes; ++i) six.drives[i].axis = static_cast<JointAxis>(i);
  for (const std::uint32_t count : {kJointAxes + 1, 0xffffffffu}) {
    six.drive_count = count;
    this->expect_refused(Fault::bad_argument, [&] { return w.create(six_axis(six)); });
    EXPECT_STREQ(w.fault().command, "create_joint");
    EXPECT_STREQ(w.fault().field, "drive_count");
  }
  six.drive_count = kJointAxes;
  EXPECT_TRUE(w.create(six_axis(six)));
  EXPECT_EQ(w.state().records->axis_drives.slot_map().template ids<AxisDriveId>().size(), kJointAxes);
}

TYPED_TEST(JointCommands, a_state_in_which_an_axis_has_two_drives_is_not_valid) {
  using S = TypeParam;
  World<S>& w = this->world;
  SixAxisDefinition<S> six;
  six.b = this->flier;
  six.drives[0].axis = JointAxis::y;
  six.drives[1].axis = JointAxis::twist;
  six.drive_count = 2;
  ASSERT_TRUE(w.create(six_axis(six)));
  WorldState<S> state = w.state();
  EXPECT_EQ(broken_rule(state), nullptr);
  state.records.change().axis_drives.change_all()[0].axis = JointAxis::twist;
  EXPECT_STREQ(broken_rule(state), "two records of a kind are about the same");
}

}  // namespace joint_commands_test
}  // namespace isostep::test
