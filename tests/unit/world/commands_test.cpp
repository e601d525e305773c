// The commands of bodies and all commands alike: what an accepted one does, and that a refused one names its fault and
// changes nothing.
// SPDX-License-Identifier: MIT
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace commands_test {

template <class S> class WorldCommands : public CommandedWorld<S> {};
TYPED_TEST_SUITE(WorldCommands, AllScalars);

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
  this->expect_bad_definition(Fault::out_of_range,
                              [&](auto& d) { d.angular_velocity.x = Limits<S>::angular_speed() + S(1); });
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
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.static_friction = S(-1); });
  this->expect_bad_definition(Fault::out_of_range, [&](auto& d) { d.material.static_friction = S(17); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.anisotropy.x = num<S>(1.0 / 65); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.anisotropy.y = S(0); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.anisotropy.z = num<S>(1.01); });
  this->expect_bad_definition(Fault::bad_argument, [&](auto& d) { d.material.reserved = 1; });
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
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.material.static_friction = nan; });
    this->expect_bad_definition(Fault::not_finite, [&](auto& d) { d.material.anisotropy.z = nan; });
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

TYPED_TEST(WorldCommands, arguments_out_of_range_are_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  const Vec3<S> far_off = {Limits<S>::position() + S(1), S(0), S(0)}, fast = {S(0), Limits<S>::speed() + S(1), S(0)},
                whirling = {S(0), S(0), -Limits<S>::angular_speed() - S(1)};
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

TYPED_TEST(WorldCommands, user_data_stays_what_it_was_set_to) {
  World<TypeParam>& w = this->world;
  for (const BodyId id : {this->ground, this->sleeper, this->kinematic, this->flier}) {
    ASSERT_TRUE(w.set_user_data(id, 0xfedcba9876543210u));
    EXPECT_EQ(w.user_data(id), 0xfedcba9876543210u);
  }
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

}  // namespace commands_test
}  // namespace isostep::test
