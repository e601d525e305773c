// Commands as data: each does what the call does, and returns what it made.
// SPDX-License-Identifier: MIT

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

template <class S> ForceZone<S> broken(ForceZone<S> zone) {
  zone.half.x = S(-1);
  return zone;
}
template <class S> Attractor<S> broken(Attractor<S> attractor) {
  attractor.least_distance = S(0);
  return attractor;
}
template <class S> Explosion<S> broken(Explosion<S> explosion) {
  explosion.wave_speed = S(0);
  return explosion;
}
template <class S> Water<S> broken(Water<S> water) {
  water.density = S(-1);
  return water;
}
template <class S> BodySpring<S> broken(BodySpring<S> spring) {
  spring.stiffness = S(-1);
  return spring;
}
template <class S> MaterialPair<S> broken(MaterialPair<S> pair) {
  pair.kind_b = 0;
  return pair;
}
template <class S> KindGhost<S> broken(KindGhost<S> ghost) {
  ghost.kind_a = 0;
  return ghost;
}
template <class S> KindResponse<S> broken(KindResponse<S> response) {
  response.inverse_mass_scale_a = S(2);
  return response;
}
template <class S> DampingZone<S> broken(DampingZone<S> zone) {
  zone.linear = S(-1);
  return zone;
}
template <class S> JointLoad<S> broken(JointLoad<S> load) {
  load.joint = {};
  return load;
}
template <class S> AxisDrive<S> broken(AxisDrive<S> drive) {
  drive.joint = {};
  return drive;
}
template <class S> Coupling<S> broken(Coupling<S> coupling) {
  coupling.ratio_a = S(0);
  return coupling;
}
template <class S> SensorMount<S> broken(SensorMount<S> mount) {
  mount.on = {};
  return mount;
}
template <class S> Blow<S> broken(Blow<S> blow) {
  blow.impulse = S(-1);
  return blow;
}
template <class S> CharacterInput<S> broken(CharacterInput<S> input) {
  input.jump = S(-1);
  return input;
}
template <class S> VehicleInput<S> broken(VehicleInput<S> input) {
  input.brake = S(2);
  return input;
}
/// The record with no body, where it should act on one.
template <class Record> Record broken(Record record) {
  record.body = {};
  return record;
}

template <class S> class CommandData : public ::testing::Test {};
TYPED_TEST_SUITE(CommandData, AllScalars);

TYPED_TEST(CommandData, commands_given_as_data_do_what_the_calls_do) {
  using S = TypeParam;
  World<S> called(settings<S>()), told(settings<S>());
  const auto both = [&](const Command<S>& command, auto&& call) {
    const bool a = static_cast<bool>(call(called)), b = told.apply(command);
    EXPECT_EQ(a, b) << command.index();
    EXPECT_EQ(called.fault(), told.fault());
    EXPECT_EQ(called.hash(), told.hash()) << command.index();
    return a;
  };
  const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
  EXPECT_TRUE(both(AddShape<S>{{ball}}, [&](auto& w) { return w.add_shape(std::span<const Child<S>>(&ball, 1)); }));
  EXPECT_TRUE(both(AddShape<S>{{ball, ball}}, [&](auto& w) {
    const Child<S> two[] = {ball, ball};
    return w.add_shape(std::span<const Child<S>>(two));
  }));
  const ShapeId shape = {0, 1};
  const BodyDefinition<S> d = moving<S>(shape, {0, 2, 0}, {1, 0, 0}), e = moving<S>(shape, {0, 4, 0});
  EXPECT_TRUE(both(CreateBody<S>{d}, [&](auto& w) { return w.create(d); }));
  EXPECT_TRUE(both(CreateBody<S>{e}, [&](auto& w) { return w.create(e); }));
  const BodyId a = called.bodies()[0], b = called.bodies()[1];
  EXPECT_TRUE(both(RemoveShape{{1, 1}}, [](auto& w) { return w.remove_shape({1, 1}); }));
  EXPECT_FALSE(both(RemoveShape{shape}, [&](auto& w) { return w.remove_shape(shape); }));
  EXPECT_TRUE(both(WakeBody{a}, [&](auto& w) { return w.wake(a); }));
  const Pose<S> pose = {vec<S>(1, 2, 3), turn<S>({0, 1, 0}, 1)};
  EXPECT_TRUE(both(SetPose<S>{a, pose}, [&](auto& w) { return w.set_pose(a, pose); }));
  const Vec3<S> v = vec<S>(1, -2, 3), u = vec<S>(0.5, 0.25, -1);
  EXPECT_TRUE(both(SetVelocity<S>{a, v, u}, [&](auto& w) { return w.set_velocity(a, v, u); }));
  EXPECT_TRUE(both(ApplyForce<S>{a, v, u}, [&](auto& w) { return w.apply_force(a, v, u); }));
  EXPECT_TRUE(both(ApplyImpulse<S>{a, v, u}, [&](auto& w) { return w.apply_impulse(a, v, u); }));
  Material<S> material;
  material.friction = num<S>(0.25);
  EXPECT_TRUE(both(SetMaterial<S>{a, material}, [&](auto& w) { return w.set_material(a, material); }));
  EXPECT_TRUE(both(SetFilter{a, {2, 3, 4}}, [&](auto& w) { return w.set_filter(a, {2, 3, 4}); }));
  EXPECT_TRUE(both(SetMotion<S>{a, S(1), S(1), S(2), body_flag::kLockX},
                   [&](auto& w) { return w.set_motion(a, S(1), S(1), S(2), body_flag::kLockX); }));
  EXPECT_TRUE(both(SetUserData{a, 9}, [&](auto& w) { return w.set_user_data(a, 9); }));
  EXPECT_TRUE(both(SetGravity<S>{u}, [&](auto& w) { return w.set_gravity(u); }));
  JointProperties<S> joint = called.joint_at(JointType::ball, a, b, pose);
  EXPECT_TRUE(both(CreateJoint<S>{joint}, [&](auto& w) { return w.create(joint); }));
  joint.user_data = 3;
  EXPECT_TRUE(both(SetJoint<S>{{0, 1}, joint}, [&](auto& w) { return w.set_joint({0, 1}, joint); }));
  called.step();
  told.step();
  EXPECT_TRUE(both(DestroyJoint{{0, 1}}, [](auto& w) { return w.destroy(JointId{0, 1}); }));
  EXPECT_TRUE(both(DestroyBody{a}, [&](auto& w) { return w.destroy(a); }));
  EXPECT_FALSE(both(DestroyBody{a}, [&](auto& w) { return w.destroy(a); }));
  const std::vector<std::int16_t> heights(9, 0), one = {5};
  const BlobRef field = height_field_blob(height_field({10, 0, 3, 3, 512}, heights, {}).value());
  const ShapeId ground = called.add_shape(field);
  EXPECT_EQ(told.add_shape(field), ground);
  EXPECT_TRUE(both(SetHeights{ground, 0, 1, 1, 1, 1, one}, [&](auto& w) {
    return w.set_heights(ground, 0, {1, 1, 1, 1, one});
  }));
  EXPECT_FALSE(both(SetHeights{ground, 1, 1, 1, 1, 1, one}, [&](auto& w) {
    return w.set_heights(ground, 1, {1, 1, 1, 1, one});
  }));
  static_assert(std::variant_size_v<Command<S>> == 110, "a command more: test it here");

  EXPECT_TRUE(both(SleepBody{b}, [&](auto& w) { return w.sleep(b); }));
  const BodyMass<S> heavy = {S(1), S(4), Vec3<S>::zero()};
  EXPECT_TRUE(both(SetMass<S>{b, heavy}, [&](auto& w) { return w.set_mass(b, heavy); }));
  EXPECT_TRUE(both(SetEnabled{b, 0}, [&](auto& w) { return w.set_enabled(b, false); }));
  EXPECT_TRUE(both(SetEnabled{b, 1}, [&](auto& w) { return w.set_enabled(b, true); }));
  EXPECT_TRUE(both(SetType<S>{b, kinematic}, [&](auto& w) { return w.set_type(b, kinematic); }));
  EXPECT_TRUE(both(MoveTo<S>{b, pose}, [&](auto& w) { return w.move_to(b, pose); }));
  EXPECT_TRUE(both(SetType<S>{b, dynamic, heavy}, [&](auto& w) { return w.set_type(b, dynamic, heavy); }));
  EXPECT_TRUE(both(SetShape<S>{b, shape, heavy}, [&](auto& w) { return w.set_shape(b, shape, heavy); }));
  EXPECT_FALSE(both(SetShape<S>{b, {9, 1}, heavy}, [&](auto& w) { return w.set_shape(b, {9, 1}, heavy); }));
  EXPECT_FALSE(both(MoveTo<S>{b, pose}, [&](auto& w) { return w.move_to(b, pose); }));

  // Records: of each kind the same three, and one for its input.
  EXPECT_TRUE(both(WakeBody{b}, [&](auto& w) { return w.wake(b); }));
  const auto tell = [&](auto id, auto input, bool taken) {
    EXPECT_EQ(both(SetInputOf<decltype(input)>{id, input}, [&](auto& w) { return w.set_input(id, input); }), taken);
  };
  const auto each = [&](auto record, auto id, auto... input) {
    using Record = decltype(record);
    EXPECT_TRUE(both(AddRecord<Record>{record}, [&](auto& w) { return w.add(record); }));
    EXPECT_FALSE(both(AddRecord<Record>{broken(record)}, [&](auto& w) { return w.add(broken(record)); }));
    EXPECT_TRUE(both(SetRecordOf<Record>{id, record}, [&](auto& w) { return w.set(id, record); }));
    EXPECT_NE(called.find(id), nullptr);
    (..., (tell(id, input, true), tell(id, broken(input), false)));
    called.step();
    told.step();
    EXPECT_EQ(called.hash(), told.hash());
    EXPECT_TRUE(both(RemoveRecord<decltype(id)>{id}, [&](auto& w) { return w.remove(id); }));
    EXPECT_FALSE(both(RemoveRecord<decltype(id)>{id}, [&](auto& w) { return w.remove(id); }));
    EXPECT_EQ(called.find(id), nullptr);
    (..., tell(id, input, false));
  };
  each(ForceZone<S>{}, ForceZoneId{0, 1});
  each(Attractor<S>{}, AttractorId{0, 1});
  BodySpring<S> spring;
  spring.a = b;
  each(spring, BodySpringId{0, 1});
  Thruster<S> thruster;
  thruster.body = b;
  each(thruster, ThrusterId{0, 1});
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = b;
  each(buoyancy, BuoyancyId{0, 1});
  each(BodyDrag<S>{b, S(1), S(1), S(1)}, DragId{0, 1});
  Explosion<S> explosion;
  explosion.wave_duration = S(1);
  each(explosion, ExplosionId{0, 1});
  each(Water<S>{}, WaterId{0, 1});
  AeroSurface<S> surface;
  surface.body = b;
  each(surface, AeroSurfaceId{0, 1});
  MaterialPair<S> pair;
  pair.kind_a = 1;
  pair.kind_b = 2;
  each(pair, MaterialPairId{0, 1});
  each(KindGhost<S>{1, 2}, KindGhostId{0, 1});
  each(KindResponse<S>{1, 2}, KindResponseId{0, 1});
  each(DampingZone<S>{}, DampingZoneId{0, 1});
  Breakable<S> breakable;
  breakable.body = b;
  each(breakable, BreakableId{0, 1}, Blow<S>{.impulse = S(1)});
  const ShapeId round = called.add_shape(Sphere<S>{S(1)});
  EXPECT_EQ(told.add_shape(Sphere<S>{S(1)}), round);
  BodyDefinition<S> mover = still<S>(round, {0, 50, 0});
  mover.type = BodyType::kinematic;
  EXPECT_TRUE(both(CreateBody<S>{mover}, [&](auto& world) { return world.create(mover); }));
  CharacterSettings<S> character;
  character.body = called.bodies().front();  // its slot was free
  each(character, CharacterId{0, 1}, CharacterInput<S>{vec<S>(1, 0, 0), S(2)});
  VehicleSettings<S> vehicle;
  vehicle.body = b;
  each(vehicle, VehicleId{0, 1}, VehicleInput<S>{.throttle = S(1)});
  const S low = S(1), high = S(2);
  WheelSettings<S> wheel;
  wheel.body = b;
  wheel.radius = high;
  each(wheel, WheelId{0, 1});
  EXPECT_FALSE(both(SetWheelSpin<S>{{0, 1}, high}, [&](auto& w) { return w.set_spin({0, 1}, high); })) << "gone";
  const WheelId spun = called.add(wheel);
  ASSERT_EQ(told.apply(AddRecord<WheelSettings<S>>{wheel}), spun);
  EXPECT_TRUE(both(SetWheelSpin<S>{spun, high}, [&](auto& w) { return w.set_spin(spun, high); }));
  EXPECT_EQ(called.state(spun)->spin, high);
  const S most = Limits<S>::speed();
  EXPECT_FALSE(both(SetWheelSpin<S>{spun, most}, [&](auto& w) { return w.set_spin(spun, most); }));
  EXPECT_TRUE(both(RemoveRecord<WheelId>{spun}, [&](auto& w) { return w.remove(spun); }));
  each(SurfaceVelocity<S>{b, vec<S>(1, 0, 0), vec<S>(0, 1, 0)}, SurfaceVelocityId{0, 1});
  each(OneWay<S>{b}, OneWayId{0, 1});
  const Ghost<S> ghost = {b, character.body}, of_one = {b, b};  // far apart: a step would end it
  EXPECT_TRUE(both(AddRecord<Ghost<S>>{ghost}, [&](auto& w) { return w.add(ghost); }));
  EXPECT_FALSE(both(AddRecord<Ghost<S>>{of_one}, [&](auto& w) { return w.add(of_one); }));
  EXPECT_TRUE(both(SetRecordOf<Ghost<S>>{{0, 1}, ghost}, [&](auto& w) { return w.set(GhostId{0, 1}, ghost); }));
  EXPECT_TRUE(both(RemoveRecord<GhostId>{{0, 1}}, [](auto& w) { return w.remove(GhostId{0, 1}); }));
  EXPECT_TRUE(both(AddRecord<Ghost<S>>{ghost}, [&](auto& w) { return w.add(ghost); }));
  called.step();
  told.step();
  EXPECT_EQ(called.hash(), told.hash());
  EXPECT_FALSE(both(RemoveRecord<GhostId>{{0, 2}}, [](auto& w) { return w.remove(GhostId{0, 2}); }));
  each(HitReport<S>{b, S(2)}, HitReportId{0, 1});
  each(ContactReport<S>{b}, ContactReportId{0, 1});
  const auto joined = [&](JointType type, double x) {
    const Pose<S> frame = {vec<S>(x, 0, 0), Quat<Unit<S>>::identity()};
    const JointProperties<S> made = called.joint_at(type, {}, b, frame);
    EXPECT_TRUE(both(CreateJoint<S>{made}, [&](auto& world) { return world.create(made); }));
    return called.joints().back();
  };
  JointLoad<S> load;
  load.joint = joined(JointType::hinge, 0);
  each(load, JointLoadId{0, 1});
  const JointId hinge = load.joint;
  EXPECT_TRUE(both(SetJointLimits<S>{hinge, -low, low}, [&](auto& w) { return w.set_limits(hinge, -low, low); }));
  EXPECT_FALSE(both(SetJointLimits<S>{hinge, high, low}, [&](auto& w) { return w.set_limits(hinge, high, low); }));
  EXPECT_TRUE(both(SetJointMotor<S>{hinge, low, high}, [&](auto& w) { return w.set_motor(hinge, low, high); }));
  EXPECT_FALSE(both(SetJointMotor<S>{hinge, low, -high}, [&](auto& w) { return w.set_motor(hinge, low, -high); }));
  EXPECT_TRUE(both(SetJointSpring<S>{hinge, high, low}, [&](auto& w) { return w.set_spring(hinge, high, low); }));
  EXPECT_FALSE(both(SetJointSpring<S>{hinge, high, -low}, [&](auto& w) { return w.set_spring(hinge, high, -low); }));
  EXPECT_TRUE(both(SetJointTarget<S>{hinge, low}, [&](auto& w) { return w.set_target(hinge, low); }));
  EXPECT_FALSE(both(SetJointTarget<S>{{9, 1}, low}, [&](auto& w) { return w.set_target({9, 1}, low); }));
  each(gears<S>(load.joint, 1, joined(JointType::hinge, 0.25), 2), CouplingId{0, 1});
  AxisDrive<S> drive;
  drive.joint = joined(JointType::six_axis, 0.5);
  each(drive, AxisDriveId{0, 1});
  mover.sensor = true;
  EXPECT_TRUE(both(CreateBody<S>{mover}, [&](auto& world) { return world.create(mover); }));
  SensorMount<S> mount;
  mount.sensor = called.bodies().back();
  mount.on = b;
  each(mount, SensorMountId{0, 1});
}

TYPED_TEST(CommandData, a_command_returns_what_it_made) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
  const ShapeId shape = w.apply(AddShape<S>{{ball}});
  EXPECT_TRUE(w.contains(shape));
  const BodyId body = w.apply(CreateBody<S>{moving<S>(shape, {0, 2, 0})});
  EXPECT_TRUE(w.contains(body));
  const JointId joint = w.apply(CreateJoint<S>{w.joint_at(JointType::ball, {}, body, Pose<S>::identity())});
  EXPECT_TRUE(w.contains(joint));
  EXPECT_TRUE(w.apply(DestroyBody{body}));
  EXPECT_FALSE(w.apply(CreateBody<S>{moving<S>({7, 1}, {0, 2, 0})}));
  EXPECT_STREQ(w.fault().command, "create_body");
}

}  // namespace
}  // namespace isostep::test
