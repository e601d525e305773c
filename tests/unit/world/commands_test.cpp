// Every command of a world: what an accepted one does, and that a refused one names its fault and changes nothing.
// SPDX-License-Identifier: MIT

#include <limits>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

/// A world in full swing: things awake, asleep, joined, pressed together and watched, so that what a refused command
/// touched would show in the hash.
template <class S> class WorldCommands : public ::testing::Test {
 protected:
  WorldCommands() : world(settings<S>()) {
    ground = add_ground(world);
    box = add_box(world, 0.5, 0.5, 0.5);
    ball = add_ball(world, 0.5);
    spare = add_ball(world, 0.25);
    sleeper = world.create(moving<S>(box, {0, 0.5, 0}));
    BodyDefinition<S> platform = still<S>(box, {6, 3, 0});
    platform.type = BodyType::kinematic;
    kinematic = world.create(platform);
    BodyDefinition<S> sensor = still<S>(box, {3, 0.5, 0});
    sensor.sensor = true;
    watcher = world.create(sensor);
    for (int i = 0; i < 80; ++i) world.step();
    flier = world.create(moving<S>(ball, {3, 1, 0}));
    other = world.create(moving<S>(ball, {-8, 3, 0}));
    joint = world.create(world.joint_at(JointType::distance, {}, other, {vec<S>(-8, 5, 0), Quat<Unit<S>>::identity()}));
    gone = world.create(moving<S>(box, {0, 20, 0}));
    gone_shape = add_box(world, 1, 1, 1);
    gone_joint = world.create(world.joint_at(JointType::ball, {}, gone, {vec<S>(0, 20, 0), Quat<Unit<S>>::identity()}));
    world.destroy(gone_joint);
    world.destroy(gone);
    world.remove_shape(gone_shape);
    for (int i = 0; i < 3; ++i) world.step();
    EXPECT_FALSE(world.is_awake(sleeper));
    EXPECT_TRUE(world.is_awake(flier));
  }

  template <class Command> void expect_refused(Fault fault, Command&& command, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    const std::uint64_t before = world.hash();
    std::vector<std::uint8_t> tape;
    world.record_to(&tape);
    EXPECT_FALSE(static_cast<bool>(command()));
    world.record_to(nullptr);
    EXPECT_EQ(world.fault(), fault) << describe(world.fault());
    EXPECT_EQ(world.hash(), before) << "a refused command changed something: " << fault_text(fault);
    EXPECT_TRUE(tape.empty());
  }
  template <class Change> void expect_bad_definition(Fault fault, Change&& change, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    BodyDefinition<S> d = moving<S>(ball, {2, 9, 0});
    change(d);
    expect_refused(fault, [&] { return world.create(d); });
  }

  World<S> world;
  ShapeId box, ball, spare, gone_shape;
  BodyId ground, sleeper, kinematic, watcher, flier, other, gone;
  JointId joint, gone_joint;
};
TYPED_TEST_SUITE(WorldCommands, AllScalars);

template <class S> S not_a_number() {
  if constexpr (!kIsFixed<S>) return std::numeric_limits<S>::quiet_NaN();
  return S(0);
}
template <class S> S endless() {
  if constexpr (!kIsFixed<S>) return -std::numeric_limits<S>::infinity();
  return S(0);
}

TYPED_TEST(WorldCommands, a_new_world_is_empty_and_without_fault) {
  using S = TypeParam;
  World<S> fresh(settings<S>());
  EXPECT_EQ(fresh.fault(), Fault::none);
  EXPECT_EQ(fresh.tick(), 0u);
  EXPECT_EQ(fresh.counts().bodies, 0u);
  EXPECT_TRUE(fresh.step().clean());
  EXPECT_EQ(fresh.tick(), 1u);
}

TYPED_TEST(WorldCommands, settings_out_of_range_are_brought_into_range_and_reported) {
  using S = TypeParam;
  Settings<S> wild = settings<S>();
  wild.hz = 0;
  wild.substeps = 1000;
  wild.gravity = {Limits<S>::speed() + S(1), S(0), S(0)};
  World<S> tamed(wild);
  EXPECT_EQ(tamed.fault(), Fault::out_of_range);
  EXPECT_EQ(tamed.settings().hz, 10);
  EXPECT_EQ(tamed.settings().substeps, 64);
  EXPECT_EQ(tamed.settings().gravity.x, Limits<S>::speed());
  EXPECT_TRUE(tamed.step().clean());
}

TYPED_TEST(WorldCommands, every_fault_has_a_text_of_its_own) {
  std::vector<std::string> texts;
  for (std::uint32_t i = 0; i < kFaults; ++i) {
    const std::string text = fault_text(static_cast<Fault>(i));
    EXPECT_FALSE(text.empty());
    for (const std::string& known : texts) EXPECT_NE(known, text);
    texts.push_back(text);
  }
}

TYPED_TEST(WorldCommands, adding_a_shape_counts_one_more_and_removing_it_one_less) {
  using S = TypeParam;
  World<S>& w = this->world;
  const std::uint32_t before = w.counts().shapes;
  const ShapeId id = w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)});
  ASSERT_TRUE(id);
  EXPECT_TRUE(w.contains(id));
  EXPECT_EQ(w.counts().shapes, before + 1);
  EXPECT_TRUE(w.remove_shape(id));
  EXPECT_FALSE(w.contains(id));
  EXPECT_EQ(w.counts().shapes, before);
}

TYPED_TEST(WorldCommands, bad_shapes_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Sphere<S>{S(0)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Sphere<S>{S(-1)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Box<S>{vec<S>(1, 0, 1)}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Box<S>{{S(1), S(1), Limits<S>::extent() + S(1)}}); });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(Capsule<S>{S(1), S(0)}); });
  this->expect_refused(Fault::bad_shape, [&] {
    return w.add_shape(HalfSpace<S>{{Unit<S>(0.5), Unit<S>(0.5), Unit<S>(0)}, S(0)});
  });
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(std::span<const Child<S>>{}); });
  Child<S> far_off = {primitive_of(Sphere<S>{S(1)}), Pose<S>::identity()};
  far_off.pose.position.x = Limits<S>::extent();
  this->expect_refused(Fault::bad_shape, [&] { return w.add_shape(std::span<const Child<S>>(&far_off, 1)); });
  if constexpr (!kIsFixed<S>) {
    this->expect_refused(Fault::not_finite, [&] { return w.add_shape(Sphere<S>{not_a_number<S>()}); });
    this->expect_refused(Fault::not_finite, [&] { return w.add_shape(Box<S>{{S(1), endless<S>(), S(1)}}); });
  }
}

TYPED_TEST(WorldCommands, a_shape_that_a_body_names_stays_whether_the_body_moves_sleeps_or_stands) {
  World<TypeParam>& w = this->world;
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->ball); });
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->box); });
  EXPECT_TRUE(w.destroy(this->kinematic));
  EXPECT_TRUE(w.destroy(this->watcher));
  this->expect_refused(Fault::shape_in_use, [&] { return w.remove_shape(this->box); });
  EXPECT_TRUE(w.destroy(this->sleeper));
  EXPECT_TRUE(w.remove_shape(this->box));
  this->expect_refused(Fault::stale_id, [&] { return w.remove_shape(this->box); });
}

TYPED_TEST(WorldCommands, removing_a_shape_leaves_the_others_their_parts) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId first = add_ball(w, 0.5), second = add_box(w, 0.25, 0.5, 1), third = add_ball(w, 2);
  EXPECT_TRUE(w.remove_shape(first));
  const ShapeId fourth = w.add_shape(Capsule<S>{S(1), S(2)});
  EXPECT_EQ(fourth.slot, first.slot);
  EXPECT_NE(fourth.generation, first.generation);
  EXPECT_TRUE(w.create(still<S>(second, {0, 0, 0})));
  EXPECT_TRUE(w.create(still<S>(third, {10, 0, 0})));
  EXPECT_TRUE(w.create(still<S>(fourth, {20, 0, 0})));
  const auto height = [&](double x) { return to_double(w.cast_ray(vec<S>(x, 8, 0), vec<S>(0, -16, 0))->point.y); };
  const double slack = 64 * grain<S>(16);
  EXPECT_NEAR(height(0), 0.5, slack);
  EXPECT_NEAR(height(10), 2, slack);
  EXPECT_NEAR(height(20), 3, slack);
}

TYPED_TEST(WorldCommands, a_created_body_is_as_defined) {
  using S = TypeParam;
  World<S>& w = this->world;
  BodyDefinition<S> d = moving<S>(this->ball, {1, 9, 2}, {3, -4, 5});
  d.angular_velocity = vec<S>(1, 2, 3);
  d.user_data = 42;
  d.mass = S(7);
  const BodyId id = w.create(d);
  ASSERT_TRUE(id);
  EXPECT_EQ(w.pose(id).position, d.position);
  EXPECT_EQ(w.velocity(id), d.velocity);
  EXPECT_EQ(w.angular_velocity(id), d.angular_velocity);
  EXPECT_EQ(w.user_data(id), 42u);
  EXPECT_EQ(w.mass(id), S(7));
  EXPECT_EQ(w.type(id), BodyType::dynamic);
  EXPECT_TRUE(w.is_awake(id));
}

TYPED_TEST(WorldCommands, bad_definitions_are_refused) {
  using S = TypeParam;
  this->expect_bad_definition(Fault::stale_id, [&](auto& d) { d.shape = this->gone_shape; });
  this->expect_bad_definition(Fault::null_id, [&](auto& d) { d.shape = ShapeId{}; });
  this->expect_bad_definition(Fault::stale_id, [&](auto& d) { d.shape = ShapeId{999, 1}; });
  this->expect_bad_definition(Fault::out_of_range, [&](auto& d) { d.position.y = Limits<S>::position() + S(1); });
  this->expect_bad_definition(Fault::out_of_range, [&](auto& d) { d.velocity.z = -Limits<S>::speed() - S(1); });
  this->expect_bad_definition(Fault::out_of_range, [&](auto& d) { d.angular_velocity.x = Limits<S>::spin() + S(1); });
  this->expect_bad_definition(Fault::out_of_range,
                              [&](auto& d) { d.material.surface_velocity.x = Limits<S>::speed() + S(1); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.orientation.w = Unit<S>(0.5); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.type = static_cast<BodyType>(3); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.locks = body_flag::kSensor; });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.locks = 1u << 14; });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.friction = S(-1); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.restitution = num<S>(1.5); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.restitution = S(-1); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.rolling_resistance = S(-1); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.linear_damping = S(-1); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.angular_damping = S(-1); });
  this->expect_bad_definition(Fault::bad_mass, [&](auto& d) { d.mass = S(-1); });
  this->expect_bad_definition(Fault::bad_mass, [&](auto& d) { d.density = S(-1); });
  this->expect_bad_definition(Fault::bad_mass, [&](auto& d) { d.inertia = vec<S>(1, -1, 1); });
  this->expect_bad_definition(Fault::bad_mass, [&](auto& d) { d.mass = Limits<S>::mass() * S(1.5); });
  if constexpr (!kIsFixed<S>) {
    const S nan = not_a_number<S>();
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.position.x = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.velocity.y = endless<S>(); });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.angular_velocity.z = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.mass = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.density = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.inertia.x = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.material.friction = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.material.surface_velocity.x = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.gravity_scale = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.linear_damping = endless<S>(); });
    this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.orientation.x = nan; });
  }
}

TYPED_TEST(WorldCommands, a_half_space_is_no_dynamic_body) {
  using S = TypeParam;
  const ShapeId plane = this->world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
  this->expect_bad_definition(Fault::bad_mass, [&](auto& d) { d.shape = plane; });
}

TYPED_TEST(WorldCommands, ids_of_what_is_gone_are_refused_everywhere) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> v = vec<S>(0, 1, 0);
  for (const BodyId id : {this->gone, BodyId{}, BodyId{12345, 1}, BodyId{this->flier.slot, 7u << 24 | 1u}}) {
    const Fault fault = !id ? Fault::null_id : id.generation > 1u << 24 ? Fault::foreign_id : Fault::stale_id;
    this->expect_refused(fault, [&] { return w.destroy(id); });
    this->expect_refused(fault, [&] { return w.wake(id); });
    this->expect_refused(fault, [&] { return w.set_pose(id, Pose<S>::identity()); });
    this->expect_refused(fault, [&] { return w.set_velocity(id, v, v); });
    this->expect_refused(fault, [&] { return w.set_material(id, {}); });
    this->expect_refused(fault, [&] { return w.set_filter(id, {}); });
    this->expect_refused(fault, [&] { return w.set_motion(id, S(1), S(0), S(0), 0); });
    this->expect_refused(fault, [&] { return w.set_user_data(id, 1); });
    this->expect_refused(fault, [&] { return w.apply_force(id, v); });
    this->expect_refused(fault, [&] { return w.apply_force_at(id, v, v); });
    this->expect_refused(fault, [&] { return w.apply_impulse(id, v); });
    this->expect_refused(fault, [&] { return w.apply_impulse_at(id, v, v); });
    EXPECT_FALSE(w.contains(id));
    EXPECT_FALSE(w.is_awake(id));
    EXPECT_EQ(w.mass(id), S(0));
    EXPECT_EQ(w.velocity(id), Vec3<S>::zero());
    EXPECT_TRUE(w.pose(id).is_identity());
  }
  this->expect_refused(Fault::stale_id, [&] { return w.destroy(this->gone_joint); });
  this->expect_refused(Fault::stale_id, [&] { return w.set_joint(this->gone_joint, {}); });
  this->expect_refused(Fault::stale_id, [&] {
    return w.create(w.joint_at(JointType::ball, this->gone, this->flier, Pose<S>::identity()));
  });
  EXPECT_EQ(w.joint(this->gone_joint), nullptr);
  EXPECT_EQ(w.joint_error(this->gone_joint), S(0));
}

TYPED_TEST(WorldCommands, a_slot_used_again_gets_a_new_generation) {
  using S = TypeParam;
  World<S>& w = this->world;
  const BodyId next = w.create(moving<S>(this->ball, {0, 9, 0}));
  EXPECT_EQ(next.slot, this->gone.slot);
  EXPECT_NE(next.generation, this->gone.generation);
  EXPECT_TRUE(w.contains(next));
  EXPECT_FALSE(w.contains(this->gone));
}

TYPED_TEST(WorldCommands, forces_and_impulses_on_what_no_force_moves_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> v = vec<S>(0, 1, 0);
  for (const BodyId id : {this->ground, this->watcher, this->kinematic}) {
    this->expect_refused(Fault::not_dynamic, [&] { return w.apply_force(id, v); });
    this->expect_refused(Fault::not_dynamic, [&] { return w.apply_impulse(id, v); });
  }
  this->expect_refused(Fault::not_dynamic, [&] { return w.set_velocity(this->ground, v, v); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.set_motion(this->ground, S(1), S(0), S(0), 0); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.wake(this->ground); });
}

TYPED_TEST(WorldCommands, arguments_out_of_range_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  const Vec3<S> far_off = {Limits<S>::position() + S(1), S(0), S(0)}, fast = {S(0), Limits<S>::speed() + S(1), S(0)},
                whirling = {S(0), S(0), -Limits<S>::spin() - S(1)};
  for (const BodyId id : {this->flier, this->sleeper, this->kinematic}) {
    this->expect_refused(Fault::out_of_range, [&] { return w.set_pose(id, {far_off, Quat<Unit<S>>::identity()}); });
    this->expect_refused(Fault::bad_argument, [&] {
      return w.set_pose(id, {zero, {Unit<S>(1), Unit<S>(1), Unit<S>(0), Unit<S>(0)}});
    });
    this->expect_refused(Fault::out_of_range, [&] { return w.set_velocity(id, fast, zero); });
    this->expect_refused(Fault::out_of_range, [&] { return w.set_velocity(id, zero, whirling); });
    Material<S> m;
    m.restitution = S(2);
    this->expect_refused(Fault::bad_argument, [&] { return w.set_material(id, m); });
    m = {};
    m.surface_velocity = fast;
    this->expect_refused(Fault::out_of_range, [&] { return w.set_material(id, m); });
    this->expect_refused(Fault::bad_argument, [&] { return w.set_motion(id, S(1), S(-1), S(0), 0); });
    this->expect_refused(Fault::bad_argument, [&] { return w.set_motion(id, S(1), S(0), S(-1), 0); });
    this->expect_refused(Fault::bad_argument, [&] { return w.set_motion(id, S(1), S(0), S(0), 1); });
  }
  this->expect_refused(Fault::out_of_range, [&] { return w.set_gravity(fast); });
}

TYPED_TEST(WorldCommands, numbers_that_are_not_finite_are_refused) {
  using S = TypeParam;
  if constexpr (kIsFixed<S>) GTEST_SKIP() << "fixed point has no such numbers";
  World<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  for (const S bad : {not_a_number<S>(), endless<S>()}) {
    const Vec3<S> v = {S(0), bad, S(0)};
    for (const BodyId id : {this->flier, this->sleeper}) {
      this->expect_refused(Fault::not_finite, [&] { return w.set_pose(id, {v, Quat<Unit<S>>::identity()}); });
      this->expect_refused(Fault::not_finite, [&] { return w.set_velocity(id, v, zero); });
      this->expect_refused(Fault::not_finite, [&] { return w.set_velocity(id, zero, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_force(id, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_force(id, zero, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_force_at(id, zero, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_impulse(id, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_impulse(id, zero, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.set_motion(id, bad, S(0), S(0), 0); });
      Material<S> m;
      m.friction = bad;
      this->expect_refused(Fault::not_finite, [&] { return w.set_material(id, m); });
    }
    this->expect_refused(Fault::not_finite, [&] { return w.set_gravity(v); });
    JointProperties<S> j = *w.joint(this->joint);
    j.upper = bad;
    this->expect_refused(Fault::not_finite, [&] { return w.set_joint(this->joint, j); });
    this->expect_refused(Fault::not_finite, [&] { return w.create(j); });
    j = *w.joint(this->joint);
    j.frame_b.position.x = bad;
    this->expect_refused(Fault::not_finite, [&] { return w.create(j); });
  }
}

TYPED_TEST(WorldCommands, bad_joints_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const auto expect_bad = [&](Fault fault, auto&& change) {
    JointProperties<S> j = w.joint_at(JointType::hinge, this->flier, this->sleeper, Pose<S>::identity());
    change(j);
    this->expect_refused(fault, [&] { return w.create(j); });
  };
  expect_bad(Fault::bad_argument, [](auto& j) { j.type = static_cast<JointType>(4); });
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

TYPED_TEST(WorldCommands, a_teleport_moves_a_body_and_keeps_its_velocity) {
  using S = TypeParam;
  World<S>& w = this->world;
  ASSERT_TRUE(w.set_velocity(this->flier, vec<S>(1, 2, 3), vec<S>(4, 5, 6)));
  const Pose<S> there = {vec<S>(-5, 9, 4), turn<S>({0, 1, 0}, 1)};
  ASSERT_TRUE(w.set_pose(this->flier, there));
  EXPECT_EQ(w.pose(this->flier).position, there.position);
  EXPECT_EQ(w.velocity(this->flier), vec<S>(1, 2, 3));
  EXPECT_EQ(w.angular_velocity(this->flier), vec<S>(4, 5, 6));
}

TYPED_TEST(WorldCommands, an_impulse_changes_velocity_by_itself_over_mass) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 1), {0, 0, 0});
  d.mass = S(4);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_impulse(id, vec<S>(8, 0, -2)));
  EXPECT_EQ(w.velocity(id), vec<S>(2, 0, -0.5));
  EXPECT_EQ(w.angular_velocity(id), Vec3<S>::zero());
  // Off centre: w = I^-1 (r x J), I_y = m (x^2 + z^2) / 3 with half extents x = 1/2, z = 1.
  ASSERT_TRUE(w.apply_impulse_at(id, vec<S>(0, 0, 2), vec<S>(0.5, 0, 0)));
  expect_near(real(w.angular_velocity(id)), {0, -0.5 * 2 / (4 * 1.25 / 3), 0}, 32 * grain<S>());
  expect_near(real(w.velocity(id)), {2, 0, 0}, 4 * grain<S>());
}

TYPED_TEST(WorldCommands, a_force_acts_over_one_step_alone_and_forces_add_up) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 4));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(2);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_force(id, vec<S>(64, 0, 0)));
  ASSERT_TRUE(w.apply_force(id, vec<S>(64, 0, 32), vec<S>(0, 2, 0)));
  EXPECT_EQ(w.velocity(id), Vec3<S>::zero());
  w.step();
  // I = 2/5 m r^2 = 1/5.
  expect_near(real(w.velocity(id)), {1, 0, 0.25}, 8 * grain<S>());
  expect_near(real(w.angular_velocity(id)), {0, 2 / 0.2 / 64, 0}, 8 * grain<S>());
  const Vec3<S> kept = w.velocity(id);
  w.step();
  EXPECT_EQ(w.velocity(id), kept);
}

TYPED_TEST(WorldCommands, impulses_one_after_another_never_turn_a_velocity_round) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(1);
  const BodyId id = w.create(d);
  const S most = Limits<S>::speed();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(w.apply_impulse(id, {most, S(0), S(0)}));
    EXPECT_GT(to_double(w.velocity(id).x), 0) << "after impulse " << i;
  }
  w.step();
  EXPECT_GT(to_double(w.velocity(id).x), 0);
  EXPECT_LE(w.velocity(id).x, most);
}

TYPED_TEST(WorldCommands, a_force_too_large_for_the_scalar_still_pushes_its_own_way) {
  using S = TypeParam;
  for (const double force : {1000.0, 4000.0, 7000.0, 12000.0, 30000.0}) {
    World<S> w(settings<S>(0));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
    d.mass = num<S>(0.5);
    const BodyId id = w.create(d);
    ASSERT_TRUE(w.apply_force(id, vec<S>(force, 0, 0)));
    w.step();
    EXPECT_GT(to_double(w.velocity(id).x), 0) << force << " N";
    EXPECT_GT(to_double(w.center_of_mass(id).x), 0) << force << " N";
  }
}

TYPED_TEST(WorldCommands, user_data_stays_what_it_was_set_to) {
  World<TypeParam>& w = this->world;
  for (const BodyId id : {this->ground, this->sleeper, this->kinematic, this->flier}) {
    ASSERT_TRUE(w.set_user_data(id, 0xfedcba9876543210u));
    EXPECT_EQ(w.user_data(id), 0xfedcba9876543210u);
  }
}

TYPED_TEST(WorldCommands, gravity_set_anew_is_what_bodies_fall_by) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 64, 4));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  ASSERT_TRUE(w.set_gravity(vec<S>(0, 0, 16)));
  run(w, 64);
  expect_near(real(w.velocity(id)), {0, 0, 16}, 1024 * speed_grain<S>(16));
}

TYPED_TEST(WorldCommands, destroying_a_body_takes_its_joints_and_contacts_along) {
  using S = TypeParam;
  World<S>& w = this->world;
  EXPECT_TRUE(w.contains(this->joint));
  EXPECT_TRUE(w.destroy(this->other));
  EXPECT_FALSE(w.contains(this->joint));
  EXPECT_TRUE(w.destroy(this->sleeper));
  EXPECT_TRUE(w.destroy(this->flier));
  EXPECT_EQ(w.counts().contacts, 0u);
  EXPECT_EQ(w.counts().joints, 0u);
  EXPECT_TRUE(w.state().overlaps.empty());
  run(w, 3);
}

TYPED_TEST(WorldCommands, the_lists_of_bodies_and_joints_ascend_by_slot) {
  World<TypeParam>& w = this->world;
  const std::vector<BodyId> bodies = w.bodies();
  EXPECT_EQ(bodies.size(), w.counts().bodies);
  for (std::size_t i = 1; i < bodies.size(); ++i) EXPECT_LT(bodies[i - 1].slot, bodies[i].slot);
  for (const BodyId id : bodies) EXPECT_TRUE(w.contains(id));
  ASSERT_EQ(w.joints().size(), 1u);
  EXPECT_EQ(w.joints()[0], this->joint);
}

TYPED_TEST(WorldCommands, a_joint_set_anew_keeps_its_bodies_and_frames) {
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
