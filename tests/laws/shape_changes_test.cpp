// Laws of bodies that get another shape, and of joints whose limits, motors and springs are set one by one.
// SPDX-License-Identifier: MIT

#include "laws/body_changes.hpp"

namespace isostep::test {
namespace shape_changes_test {

template <class S> class ShapeChanges : public BodyChanges<S> {};
TYPED_TEST_SUITE(ShapeChanges, AllScalars);

TYPED_TEST(ShapeChanges, a_body_that_grows_keeps_its_place_and_mass_and_comes_to_rest_on_its_new_shape) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId body = this->box({0, 0.25, 0}, {0.25, 0.25, 0.25});
  EXPECT_TRUE(settle(this->w));
  const S mass = this->w.mass(body);
  const Pose<S> before = this->w.pose(body);
  const ShapeId large = add_box(this->w, 0.5, 0.5, 0.5);
  ASSERT_TRUE(this->w.set_shape(body, large)) << describe(this->w.fault());
  EXPECT_EQ(this->w.mass(body), mass);
  EXPECT_EQ(this->w.pose(body).position, before.position);
  EXPECT_TRUE(this->w.is_awake(body));
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    EXPECT_LT(std::abs(this->speed(body).y), 4) << "pushed out, not thrown";
  }
  EXPECT_TRUE(settle(this->w));
  EXPECT_NEAR(this->at(body).y, 0.5, 0.01);
}

/// As one that was made with the new shape: mass, inertia, motion.
TYPED_TEST(ShapeChanges, a_body_of_another_shape_moves_as_one_that_was_made_so) {
  using S = TypeParam;
  World<S> other(settings<S>());
  const BodyId body = this->box({0, 4, 0}, {0.5, 0.5, 0.5});
  const ShapeId plate = add_box(this->w, 1, 0.125, 0.5);
  const BodyMass<S> mass = {S(1), S(3), Vec3<S>::zero()};
  ASSERT_TRUE(this->w.set_shape(body, plate, mass));
  BodyDefinition<S> d = moving<S>(add_box(other, 1, 0.125, 0.5), {0, 4, 0});
  d.mass = S(3);
  const BodyId twin = other.create(d);
  this->w.set_velocity(body, Vec3<S>::zero(), vec<S>(1, 2, 0.5));
  other.set_velocity(twin, Vec3<S>::zero(), vec<S>(1, 2, 0.5));
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    other.step();
    ASSERT_EQ(this->w.pose(body).position, other.pose(twin).position) << i;
    ASSERT_EQ(this->w.pose(body).orientation, other.pose(twin).orientation) << i;
  }
}

/// The centre of mass moves in the body, so that its origin stays.
TYPED_TEST(ShapeChanges, the_origin_stays_where_the_centre_of_mass_moves) {
  using S = TypeParam;
  const BodyId body = this->box({1, 2, 3}, {0.5, 0.5, 0.5});
  const ShapeId uneven = add_two_boxes(this->w, {0.5, 0.5, 0.5}, {0, 0, 0}, {0.25, 0.25, 0.25}, {1, 0, 0});
  ASSERT_TRUE(this->w.set_shape(body, uneven));
  EXPECT_NEAR(real(this->w.pose(body).position).x, 1, pick<S>(1e-6, 1e-12, 1e-4, 1e-8));
  EXPECT_GT(this->at(body).x, 1.05) << "the centre of mass";
}

TYPED_TEST(ShapeChanges, a_character_that_crouches_stays_on_its_ground) {
  using S = TypeParam;
  add_ground(this->w);
  const double half = 0.5, radius = 0.25, skin = 1.0 / 64;
  BodyDefinition<S> d =
      moving<S>(this->w.add_shape(Capsule<S>{num<S>(radius), num<S>(half)}), {0, half + radius + skin, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> c;
  c.body = this->w.create(d);
  const CharacterId id = this->w.add(c);
  run(this->w, 10);
  ASSERT_EQ(this->w.state(id)->footing, Footing::floor);
  // The same foot: the lower capsule hangs by that much less below the origin.
  const Child<S> low = {Capsule<S>{num<S>(radius), num<S>(0.125)}.primitive(),
                        {vec<S>(0, 0.125 - half, 0), Quat<Unit<S>>::identity()}};
  ASSERT_TRUE(this->w.set_shape(c.body, this->w.add_shape(std::span(&low, 1)))) << describe(this->w.fault());
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(this->w.set_input(id, {vec<S>(1, 0, 0), S(0)}));
    this->w.step();
    ASSERT_EQ(this->w.state(id)->footing, Footing::floor) << i;
  }
  EXPECT_NEAR(real(this->w.pose(c.body).position).y, half + radius + skin, 0.01);
  EXPECT_GT(real(this->w.pose(c.body).position).x, 0.8);
}

TYPED_TEST(ShapeChanges, shapes_that_cannot_be_are_refused_and_change_nothing) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId body = this->box({0, 2, 0});
  const ShapeId plane = this->w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
  const ShapeId gone = this->w.add_shape(Sphere<S>{S(1)});
  ASSERT_TRUE(this->w.remove_shape(gone));
  const ShapeId two = add_two_boxes(this->w, {0.5, 0.5, 0.5}, {0, 0, 0}, {0.5, 0.5, 0.5}, {1, 0, 0});
  ASSERT_TRUE(this->w.set_shape(body, two));
  SurfaceVelocity<S> belt{body, vec<S>(1, 0, 0), Vec3<S>::zero(), 1};
  ASSERT_TRUE(this->w.add(belt));
  const ShapeId ball = this->w.add_shape(Sphere<S>{S(1)});
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](ShapeId shape, Fault fault, const char* field) {
    EXPECT_FALSE(this->w.set_shape(body, shape)) << field;
    EXPECT_EQ(this->w.fault(), fault) << describe(this->w.fault());
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before);
  };
  refused(plane, Fault::bad_mass, "shape");
  refused(gone, Fault::stale_id, "shape");
  refused(ball, Fault::bad_argument, "part");
}

TYPED_TEST(ShapeChanges, are_state) {
  using S = TypeParam;
  add_ground(this->w);
  for (int i = 0; i < 4; ++i) this->box({0, 1 + 1.5 * i, 0}, {0.5, 0.5, 0.5});
  const ShapeId low = add_box(this->w, 0.5, 0.25, 0.5), round = add_ball(this->w, 0.5);
  const std::vector<BodyId> all = this->w.bodies();
  expect_exact_rollback(this->w, 120, [&](World<S>& world, int i) {
    if (i % 15 == 3) world.set_shape(all[1 + static_cast<std::size_t>(i / 15 % 4)], i % 2 == 0 ? low : round);
  });
}

TYPED_TEST(ShapeChanges, setters_of_joints_do_what_the_whole_record_does) {
  using S = TypeParam;
  const BodyId body = this->box({0, 2, 0}, {0.5, 0.25, 0.25});
  OneAxisJoint<S> definition;
  definition.a = body;
  definition.frame.position = vec<S>(0, 3, 0);
  const JointId joint = this->w.create(hinge<S>(definition));
  ASSERT_TRUE(joint) << describe(this->w.fault());
  typename World<S>::Snapshot start;
  this->w.save(start);
  World<S> whole(settings<S>());
  ASSERT_TRUE(whole.load(start));
  ASSERT_TRUE(this->w.set_limits(joint, S(-0.5), S(0.25)));
  ASSERT_TRUE(this->w.set_motor(joint, S(2), S(5)));
  ASSERT_TRUE(this->w.set_spring(joint, S(3), S(0.5)));
  ASSERT_TRUE(this->w.set_target(joint, S(0.125)));
  JointProperties<S> next = *whole.joint(joint);
  next.flags |= joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
  next.lower = S(-0.5), next.upper = S(0.25);
  next.motor_speed = S(2), next.max_force = S(5);
  next.spring_frequency = S(3), next.spring_damping = S(0.5), next.spring_target = S(0.125);
  ASSERT_TRUE(whole.set_joint(joint, next));
  EXPECT_EQ(this->w.hash(), whole.hash());
  ASSERT_TRUE(this->w.set_motor(joint, S(0), S(0)));
  ASSERT_TRUE(this->w.set_spring(joint, S(0), S(0)));
  EXPECT_EQ(this->w.joint(joint)->flags & (joint_flag::kMotor | joint_flag::kSpring), 0u);
  EXPECT_FALSE(this->w.set_limits(joint, S(1), S(0)));
  EXPECT_STREQ(this->w.fault().field, "lower");
  EXPECT_FALSE(this->w.set_motor(joint, S(1), S(-1)));
  EXPECT_STREQ(this->w.fault().field, "max_force");
}

}  // namespace shape_changes_test
}  // namespace isostep::test
