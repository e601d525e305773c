// Laws of SensorMount: where the sensor is, that its carrier never knows, that it is all state; and what is refused.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "isostep/store/state_validator.hpp"
#include "laws/mounted_world.hpp"

namespace isostep::test {
namespace sensor_mount_poses_test {

template <class S> class SensorMountPoses : public MountedWorld<S> {
 protected:
  /// A body of two boxes, whose centre of mass is not its origin, falls on its edge and tumbles.
  BodyId tumbler(World<S>& world) {
    const ShapeId shape = add_two_boxes(world, {0.5, 0.25, 0.25}, {0, 0, 0}, {0.125, 0.5, 0.25}, {0.625, 0.25, 0});
    BodyDefinition<S> d = moving<S>(shape, {0, 3, 0}, {2, 0, 1});
    d.orientation = turn<S>({0, 0, 1}, 0.5);
    d.angular_velocity = vec<S>(3, 2, 1);
    return world.create(d);
  }
  void turn_frame() {
    SensorMount<S> record = *this->w.find(this->mount);
    record.frame.orientation = turn<S>({0.6, 0.8, 0}, 1);
    ASSERT_TRUE(this->w.set(this->mount, record));
  }
};
TYPED_TEST_SUITE(SensorMountPoses, AllScalars);

TYPED_TEST(SensorMountPoses, are_their_carriers_times_the_frame_after_every_step) {
  using S = TypeParam;
  this->begin(-10);
  add_ground(this->w);
  const BodyId body = this->tumbler(this->w);
  this->feel(body, {0.25, 0.5, -0.75});
  this->turn_frame();
  bool slept = false;
  for (int step = 0; step < 480; ++step) {
    if (step == 400) this->w.set_pose(body, {vec<S>(4, 1, 0), turn<S>({1, 0, 0}, 0.5)});
    if (step == 420) this->w.set_pose(this->sensor, {vec<S>(0, 9, 0), Quat<Unit<S>>::identity()});
    if (step == 440) this->w.set_velocity(this->sensor, vec<S>(3, 0, 0), Vec3<S>::zero());
    if (step == 460) this->w.move_to(this->sensor, {vec<S>(0, 9, 0), Quat<Unit<S>>::identity()});
    ASSERT_TRUE(this->w.step().clean());
    this->expect_in_place(body);
    ASSERT_EQ(this->w.velocity(this->sensor), Vec3<S>::zero()) << step;
    slept = slept || !this->w.is_awake(body);
    ASSERT_FALSE(this->HasFailure()) << step;
  }
  EXPECT_TRUE(slept);
}

TYPED_TEST(SensorMountPoses, follow_characters_and_what_is_moved_to_a_target) {
  using S = TypeParam;
  this->begin(-10);
  add_ground(this->w);
  BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.765625, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = this->w.create(d);
  const CharacterId walker = this->w.add(character);
  ASSERT_TRUE(walker && this->w.set_input(walker, {vec<S>(2, 0, 1)})) << describe(this->w.fault());
  this->feel(character.body, {0.5, 0, 0});
  for (int step = 0; step < 30; ++step) {
    this->w.step();
    this->expect_in_place(character.body);
  }
  EXPECT_GT(to_double(this->w.pose(this->sensor).position.x), 1);
  d.position = vec<S>(0, 4, 0);
  const BodyId lift = this->w.create(d);
  this->feel(lift, {0, 1, 0});
  for (int step = 0; step < 10; ++step) {
    this->w.move_to(lift, {vec<S>(0, 4 + 0.1 * step, 0), turn<S>({0, 1, 0}, 0.1 * step)});
    this->w.step();
    this->expect_in_place(lift);
  }
}

/// What is jointed to the sensor goes with it too: in the step it moves as its carrier does.
TYPED_TEST(SensorMountPoses, move_in_the_step_with_their_carrier) {
  using S = TypeParam;
  this->begin(0);
  BodyDefinition<S> d = still<S>(add_ball(this->w, 0.5));
  d.type = BodyType::kinematic;
  d.velocity = vec<S>(4, 0, 0);
  d.angular_velocity = vec<S>(0, 1, 0);
  const BodyId body = this->w.create(d);
  this->feel(body, {0, 0, 2});
  this->w.step();
  const Pose<S> frame = this->w.pose(this->sensor);
  BodyDefinition<S> bob = moving<S>(add_ball(this->w, 0.25), real(frame.position));
  bob.angular_velocity = vec<S>(0, 1, 0);
  bob.velocity = vec<S>(6, 0, 0);
  const BodyId held = this->w.create(bob);
  ASSERT_TRUE(this->w.create(this->w.joint_at(JointType::fixed, this->sensor, held, frame)));
  for (int step = 0; step < 64; ++step) {
    this->w.step();
    const D3 way = real(this->w.center_of_mass(held)) - real(this->w.pose(this->sensor).position);
    ASSERT_LT(length(way), 0.005) << step;
    const D3 arm = real(this->w.pose(this->sensor).position) - real(this->w.pose(body).position);
    expect_near(real(this->w.velocity(held)), {4 + arm.z, 0, -arm.x}, 0.1);
  }
}

TYPED_TEST(SensorMountPoses, change_no_bit_of_what_their_carrier_does) {
  using S = TypeParam;
  for (const SolverName solver : built({SolverName::soft_step, SolverName::worst_first})) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    this->w = World<S>(s);
    World<S> alone(s);
    const auto fill = [&](World<S>& world) {
      add_ground(world);
      for (int i = 0; i < 4; ++i) world.create(moving<S>(add_box(world, 0.5, 0.25, 0.5), {0.1 * i, 0.25 + 0.5 * i, 0}));
      return this->tumbler(world);
    };
    const BodyId body = fill(this->w);
    fill(alone);
    this->feel(body, {0, 0.5, 0});
    for (int step = 0; step < 240; ++step) {
      this->w.step();
      alone.step();
      for (const BodyId id : alone.bodies()) {
        ASSERT_EQ(this->w.pose(id).position, alone.pose(id).position) << step;
        ASSERT_EQ(this->w.pose(id).orientation, alone.pose(id).orientation) << step;
        ASSERT_EQ(this->w.velocity(id), alone.velocity(id)) << step;
        ASSERT_EQ(this->w.is_awake(id), alone.is_awake(id)) << step;
      }
    }
  }
}

TYPED_TEST(SensorMountPoses, and_their_events_are_rolled_back) {
  this->begin(-10);
  add_ground(this->w);
  const BodyId body = this->tumbler(this->w);
  for (int i = 0; i < 6; ++i) {  // below where it falls
    this->w.create(moving<TypeParam>(add_ball(this->w, 0.25), {0.5 * (i % 3) + 0.375, 0.25, 0.5 * (i / 3) - 0.25}));
  }
  this->feel(body, {0.5, 0.25, 0});
  std::vector<std::size_t> told[3];
  std::size_t turn = 0;
  expect_exact_rollback(this->w, 120, [&](World<TypeParam>& world, int frame) {
    if (frame == 60 && !told[0].empty() && told[0].size() > 60) ++turn;
    if (frame % 30 == 20) world.set_pose(body, {vec<TypeParam>(0, 2, 0), Quat<Unit<TypeParam>>::identity()});
    told[turn].push_back(world.events().sensor_begin.size() * 16 + world.events().sensor_end.size());
  });
  ASSERT_EQ(turn, 2u);
  std::size_t events = 0;
  for (std::size_t i = 1; i < 60; ++i) {  // what the step before told; of that before the load nothing is kept
    EXPECT_EQ(told[1][i], told[0][60 + i]) << i;
    EXPECT_EQ(told[2][i], told[0][60 + i]) << i;
  }
  for (const std::size_t each : told[0]) events += each;
  EXPECT_GT(events, 16u);
}

TYPED_TEST(SensorMountPoses, stay_within_the_world_at_its_edge) {
  using S = TypeParam;
  this->begin(0);
  const S edge = Limits<S>::position(), extent = Limits<S>::extent(), speed = Limits<S>::speed() * S(0.5);
  BodyDefinition<S> d = moving<S>(add_ball(this->w, 0.5), {0, 0, 0});
  d.position = {edge - S(1), S(0), -edge + S(1)};
  d.velocity = {speed, S(0), -speed};
  d.angular_velocity = {S(0), S(8), S(0)};
  const BodyId body = this->w.create(d);
  this->feel(body, {0, 0, 0});
  ASSERT_TRUE(this->w.set(this->mount, {this->sensor, body, {{extent, extent, extent}, turn<S>({0, 1, 0}, 1)}}));
  for (int step = 0; step < 20; ++step) {
    this->w.step();
    EXPECT_LE(max_abs(this->w.pose(this->sensor).position), edge);
    ASSERT_EQ(broken_rule(this->w.state()), nullptr) << step;
  }
}

TYPED_TEST(SensorMountPoses, refuse_what_is_no_mount_and_change_nothing) {
  using S = TypeParam;
  this->begin(0);
  const BodyId body = this->w.create(moving<S>(add_ball(this->w, 0.5), {0, 0, 0}));
  this->feel(body, {1, 0, 0});
  const BodyId free = this->add_feeler({0, 9, 0}), fixed = this->add_feeler({0, 12, 0}, BodyType::static_);
  const BodyId solid = this->add_feeler({0, 15, 0}, BodyType::kinematic, false);
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](SensorMount<S> record, Fault fault, const char* field, const char* expected = nullptr) {
    EXPECT_FALSE(this->w.add(record));
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    if (expected != nullptr) {
      EXPECT_STREQ(this->w.fault().expected, expected);
    }
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  const Pose<S> here = Pose<S>::identity();
  refused({{}, body, here}, Fault::null_id, "sensor");
  refused({free, {}, here}, Fault::null_id, "on");
  refused({free, free, here}, Fault::bad_argument, "on", "another body than sensor");
  refused({fixed, body, here}, Fault::bad_argument, "sensor", "a kinematic one");
  refused({solid, body, here}, Fault::bad_argument, "sensor", "a body that is a sensor");
  refused({this->sensor, solid, here}, Fault::bad_argument, "sensor", "a sensor that has no record yet");
  refused({free, this->sensor, here}, Fault::bad_argument, "on", "a body that is not mounted itself");
  const S far = Limits<S>::extent() + S(1);
  refused({free, body, {{far, S(0), S(0)}, here.orientation}}, Fault::out_of_range, "frame.position");
  Quat<Unit<S>> none = here.orientation;
  none.w = Unit<S>(0.5);
  refused({free, body, {here.position, none}}, Fault::bad_argument, "frame.orientation");
  if constexpr (!kIsFixed<S>)
    refused({free, body, {{num<S>(NAN), S(0), S(0)}, here.orientation}}, Fault::not_finite, "frame.position");
  EXPECT_FALSE(this->w.set_type(this->sensor, BodyType::static_));
  EXPECT_STREQ(this->w.fault().field, "type");
  EXPECT_EQ(this->w.hash(), before);
  ASSERT_TRUE(this->w.set(this->mount, {this->sensor, free, here}));
  EXPECT_FALSE(this->w.add(SensorMount<S>{free, body, here}));
  EXPECT_STREQ(this->w.fault().expected, "a sensor that carries none");
  ASSERT_TRUE(this->w.destroy(free));
  EXPECT_EQ(this->w.find(this->mount), nullptr);
}

/// A force at the origin of such a body would have too long an arm; a record about the whole body has none.
TYPED_TEST(SensorMountPoses, go_with_a_body_whose_centre_is_far_from_its_origin) {
  using S = TypeParam;
  this->begin(0);
  const Child<S> far[] = {part_at(primitive_of(Sphere<S>{num<S>(0.125)}), {100, 0, 0})};
  const BodyId body = this->w.create(moving<S>(this->w.add_shape(std::span<const Child<S>>(far)), {-100, 0, 0}));
  ASSERT_TRUE(body) << describe(this->w.fault());
  this->feel(body, {100, 0, 0});
  EXPECT_TRUE(this->w.add(HitReport<S>{body, S(1)})) << describe(this->w.fault());
  this->w.step();
  this->expect_in_place(body);
}

TYPED_TEST(SensorMountPoses, of_a_state_that_breaks_a_rule_are_not_read) {
  using S = TypeParam;
  this->begin(0);
  const BodyId body = this->w.create(moving<S>(add_ball(this->w, 0.5), {0, 0, 0}));
  const BodyId solid = this->add_feeler({0, 15, 0}, BodyType::kinematic, false);
  this->feel(body, {1, 0, 0});
  const BodyId first = this->sensor;
  this->feel(body, {2, 0, 0});
  const WorldState<S> good = this->w.state();
  EXPECT_EQ(broken_rule(good), nullptr);
  const auto rule_of = [&](SensorMount<S> record) {
    WorldState<S> state = good;
    state.records.change().sensor_mounts.change_all()[this->mount.slot] = record;
    const char* rule = broken_rule(state);
    return std::string(rule == nullptr ? "" : rule);
  };
  EXPECT_EQ(rule_of({first, body, Pose<S>::identity()}), "two records of a kind are about the same");
  EXPECT_EQ(rule_of({this->sensor, first, Pose<S>::identity()}), "a sensor is mounted on one that is mounted");
  EXPECT_NE(rule_of({solid, body, Pose<S>::identity()}), "");
  EXPECT_NE(rule_of({this->sensor, {}, Pose<S>::identity()}), "");
}

}  // namespace sensor_mount_poses_test
}  // namespace isostep::test
