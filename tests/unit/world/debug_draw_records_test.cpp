// Drawing: what a DebugDraw is told of joints, wheels, characters, and of particles with what ties them.
// SPDX-License-Identifier: MIT
#include "isostep/particles/particle_state.hpp"
#include "unit/world/debug_draw_told.hpp"

namespace isostep::test {
namespace debug_draw_records_test {

template <class S> class DebugDrawsRecords : public ::testing::Test {};
TYPED_TEST_SUITE(DebugDrawsRecords, AllScalars);

TYPED_TEST(DebugDrawsRecords, TellsTheAnchorsOfJoints) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  const ShapeId ball = add_ball(world, 0.5);
  const BodyId a = world.create(moving<S>(ball, {0, 0, 0})), b = world.create(moving<S>(ball, {3, 0, 0}));
  const Pose<S> frame = {vec<S>(1, 2, 0), Quat<Unit<S>>::identity()};
  const JointId hinge = world.create(world.joint_at(JointType::hinge, a, b, frame));
  JointProperties<S> rod = world.joint_at(JointType::distance, BodyId{}, b, {vec<S>(3, 4, 0), frame.orientation});
  rod.frame_b = Pose<S>::identity();
  rod.lower = rod.upper = S(3.5);
  const JointId hung = world.create(rod);
  const Told all = told(world);
  ASSERT_EQ(all.joints.size(), 2u);
  EXPECT_EQ(all.joints[0].joint, hinge);
  EXPECT_EQ(all.joints[0].type, JointType::hinge);
  EXPECT_EQ(all.joints[0].a, a);
  EXPECT_EQ(all.joints[0].b, b);
  expect_near(real(all.joints[0].frame_a.position), {1, 2, 0}, 1e-3);
  expect_near(real(all.joints[0].frame_b.position), {1, 2, 0}, 1e-3);
  expect_near(real(all.joints[0].centre_b), {3, 0, 0}, 1e-3);
  EXPECT_NEAR(all.joints[0].error, 0, 1e-3);
  EXPECT_EQ(all.joints[1].joint, hung);
  EXPECT_EQ(all.joints[1].a, BodyId{});
  expect_near(real(all.joints[1].frame_a.position), {3, 4, 0}, 1e-3);
  expect_near(real(all.joints[1].frame_b.position), {3, 0, 0}, 1e-3);
  EXPECT_NEAR(all.joints[1].error, 0.5, 1e-3);  // 4 m apart where 3.5 m are asked
}

/// A cart of 40 kg with a steered wheel in front, that turns to the left, and two behind.
template <class S> struct Cart {
  explicit Cart(double turned = 0) : world(settings<S>()) {
    add_ground(world, 1);
    BodyDefinition<S> d = moving<S>(add_box(world, 0.5, 0.125, 1), {3, 0.5, 7});
    d.orientation = turn<S>({0, 1, 0}, turned);
    d.mass = S(40);
    body = world.create(d);
    VehicleSettings<S> vehicle;
    vehicle.body = body;
    vehicle.brake_torque = S(200);
    EXPECT_TRUE(world.set_input(world.add(vehicle), {.brake = S(1), .steer = S(1)})) << describe(world.fault());
    const double x[] = {0, 0.5, -0.5}, z[] = {1, -1, -1};
    for (int i = 0; i < 3; ++i) {
      WheelSettings<S> wheel;
      wheel.body = body;
      wheel.hard_point = vec<S>(x[i], 0, z[i]);
      wheel.stiffness = S(i == 0 ? 4000 : 2000);  // half of the weight is in front
      wheel.damping = S(i == 0 ? 300 : 150);
      wheel.radius = S(0.25);
      wheel.inertia = S(0.5);
      wheel.steer_angle = i == 0 ? num<S>(kSteer) : S(0);
      wheels[i] = world.add(wheel);
      EXPECT_TRUE(wheels[i]) << describe(world.fault());
    }
  }
  static constexpr double kSteer = 0.5;
  World<S> world;
  BodyId body;
  WheelId wheels[3];
};
D3 axis_of(const DrawnPose& pose, D3 local) {
  const float* const q = pose.orientation;
  return to_matrix(normalise(Quat<double>{q[0], q[1], q[2], q[3]})) * local;
}

TYPED_TEST(DebugDrawsRecords, TellsWheelsWhereTheyStandAndWhatTheyBear) {
  using S = TypeParam;
  for (const double turned : {0.0, 1.0}) {
    Cart<S> cart(turned);
    run(cart.world, 120);
    const Told all = told(cart.world);
    ASSERT_EQ(all.wheels.size(), 3u);
    const double c = std::cos(turned), s = std::sin(turned);
    double load = 0;
    for (int i = 0; i < 3; ++i) {
      const DrawnWheel& wheel = all.wheels[i];
      const double x = i == 0 ? 0 : i == 1 ? 0.5 : -0.5, z = i == 0 ? 1 : -1;
      EXPECT_EQ(wheel.wheel, cart.wheels[i]);
      EXPECT_EQ(wheel.body, cart.body);
      EXPECT_EQ(wheel.radius, 0.25f);
      expect_near(real(wheel.pose.position), {3 + c * x + s * z, 0.25, 7 + c * z - s * x}, 5e-3);
      EXPECT_NEAR(wheel.hard_point[0], wheel.pose.position[0], 5e-3);
      EXPECT_GT(wheel.hard_point[1], 0.4);
      const double steered = turned + (i == 0 ? cart.kSteer : 0);
      expect_near(axis_of(wheel.pose, {0, 1, 0}), {std::cos(steered), 0, -std::sin(steered)}, 5e-3);
      ASSERT_TRUE(wheel.ground);
      expect_near(real(wheel.contact), {wheel.pose.position[0], 0, wheel.pose.position[2]}, 5e-3);
      expect_near(real(wheel.normal), {0, 1, 0}, 1e-4);
      load += wheel.load;
    }
    EXPECT_NEAR(load, 400, 4);
  }
}

TYPED_TEST(DebugDrawsRecords, TurnsWheelsAsTheyRollAndTellsTheirGrip) {
  using S = TypeParam;
  Cart<S> cart;
  const WheelId id = cart.wheels[1];
  run(cart.world, 60);
  edit_parts(cart.world, [&](RecordParts<S>& parts) { parts.wheel_states[id.slot].angle = num<S>(kPi / 2); });
  const Told before = told(cart.world);
  const D3 still = axis_of(before.wheels[2].pose, {0, 0, 1}), turned = axis_of(before.wheels[1].pose, {0, 0, 1});
  EXPECT_NEAR(still.y, 0, 0.02);
  EXPECT_NEAR(turned.y, -1, 0.02);  // what was in front goes down
  cart.world.apply_impulse(cart.body, vec<S>(0, 0, 40));
  cart.world.step();
  double grip = 0;
  for (const DrawnWheel& drawn : told(cart.world).wheels) grip += drawn.grip[2];
  EXPECT_LT(grip, -100);  // brakes hold it back
}

TYPED_TEST(DebugDrawsRecords, TellsWheelsInTheAirOfNoGround) {
  using S = TypeParam;
  Cart<S> cart;
  cart.world.set_pose(cart.body, {vec<S>(0, 5, 0), Quat<Unit<S>>::identity()});
  cart.world.step();
  const Told all = told(cart.world);
  ASSERT_EQ(all.wheels.size(), 3u);
  EXPECT_FALSE(all.wheels[0].ground);
  EXPECT_EQ(all.wheels[0].load, 0);
  EXPECT_NEAR(all.wheels[0].hard_point[1] - all.wheels[0].pose.position[1], 0.3, 1e-3);  // its free length
  EXPECT_TRUE(told(cart.world, {.wheels = false}).wheels.empty());
}

TYPED_TEST(DebugDrawsRecords, TellsCharactersAndWhatTheyStandOn) {
  using S = TypeParam;
  World<S> world(settings<S>());
  BodyDefinition<S> floor = still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
  floor.orientation = turn<S>({0, 0, 1}, 0.5);
  const BodyId ground = world.create(floor);
  BodyDefinition<S> d = moving<S>(world.add_shape(Capsule<S>{S(0.25), S(0.5)}), {0, 0.875, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> walker;
  walker.body = world.create(d);
  const CharacterId id = world.add(walker);
  ASSERT_TRUE(id);
  Told all = told(world);
  ASSERT_EQ(all.characters.size(), 1u);
  EXPECT_EQ(all.characters[0].footing, Footing::airborne);
  EXPECT_FALSE(all.characters[0].ground);
  expect_near(real(all.characters[0].foot), {0, 0.875, 0}, 1e-3);
  run(world, 30);
  all = told(world);
  EXPECT_EQ(all.characters[0].character, id);
  EXPECT_EQ(all.characters[0].body, walker.body);
  EXPECT_EQ(all.characters[0].footing, Footing::floor);
  EXPECT_EQ(all.characters[0].ground, ground);
  expect_near(real(all.characters[0].normal), {-std::sin(0.5), std::cos(0.5), 0}, 5e-3);
  const D3 foot = real(all.characters[0].foot);
  EXPECT_NEAR(foot.y * std::cos(0.5) - foot.x * std::sin(0.5), 0, 5e-3);  // on the plane
  EXPECT_NEAR(all.characters[0].weight, 800, 1);
  EXPECT_TRUE(told(world, {.characters = false}).characters.empty());
}

TYPED_TEST(DebugDrawsRecords, TellsParticlesWithWhatTiesThem) {
  using S = TypeParam;
  ParticleWorld<S> world;
  ParticleMaterial<S> material;
  material.radius = S(0.25);
  const ParticleMaterialId heavy = world.add(material);
  const ParticleId a = world.create({.position = vec<S>(1, 2, 3), .material = heavy});
  const ParticleId b = world.create({.position = vec<S>(1, 5, 3), .pinned = true});
  Spring<S> spring;
  spring.type = SpringType::bungee;
  spring.a = a;
  spring.anchor = vec<S>(0, 9, 0);
  spring.stiffness = S(1);
  spring.rest_length = S(2);
  const SpringId bungee = world.add(spring);
  const LinkId rod = world.add(Link<S>{LinkType::rod, a, b, {S(0), S(0), S(0)}, S(2.5), S(0)});
  Collider<S> plane;
  plane.offset = S(-1);
  world.add(plane);
  const std::uint64_t hash = world.hash();
  const Told all = told(world);
  EXPECT_EQ(world.hash(), hash);
  ASSERT_EQ(all.particles.size(), 2u);
  EXPECT_EQ(all.particles[0].particle, a);
  EXPECT_EQ(all.particles[0].radius, 0.25f);
  EXPECT_FALSE(all.particles[0].pinned);
  EXPECT_EQ(real(all.particles[0].position), (D3{1, 2, 3}));
  EXPECT_TRUE(all.particles[1].pinned);
  ASSERT_EQ(all.springs.size(), 1u);
  EXPECT_EQ(all.springs[0].spring, bungee);
  EXPECT_EQ(real(all.springs[0].from), (D3{1, 2, 3}));
  EXPECT_EQ(real(all.springs[0].to), (D3{0, 9, 0}));
  EXPECT_EQ(all.springs[0].rest_length, 2.0f);
  EXPECT_EQ(all.springs[0].a, a);
  EXPECT_EQ(all.springs[0].b, ParticleId{});
  ASSERT_EQ(all.links.size(), 1u);
  EXPECT_EQ(all.links[0].link, rod);
  EXPECT_EQ(all.links[0].b, b);
  EXPECT_EQ(real(all.links[0].to), (D3{1, 5, 3}));
  EXPECT_NEAR(all.links[0].error, 0.5, 1e-3);  // 3 m apart where 2.5 m are asked
  ASSERT_EQ(all.colliders.size(), 1u);
  expect_near(real(all.colliders[0].start), {0, -1, 0}, 1e-6);
}

}  // namespace debug_draw_records_test
}  // namespace isostep::test
