// Drawing: what a DebugDraw is told of worlds whose shapes, contacts and joints are known from their building.
// SPDX-License-Identifier: MIT
#include "isostep/draw/debug_draw.hpp"

#include <algorithm>

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/particles/particle_state.hpp"
#include "unit/world/edited_state.hpp"

namespace isostep::test {
namespace {

struct ToldPart {
  DrawnBody body;
  DrawnPart part;
};

/// Keeps all that it is told.
struct Told : DebugDraw {
  void body(const DrawnBody& drawn) override { bodies.push_back(drawn); }
  void part(const DrawnBody& of, const DrawnPart& drawn) override { parts.push_back({of, drawn}); }
  void line(const DrawnLine& drawn) override { lines.push_back(drawn); }
  void mass(const DrawnMass& drawn) override { masses.push_back(drawn); }
  void box(const DrawnBox& drawn) override { boxes.push_back(drawn); }
  void island(const DrawnIsland& drawn) override { islands.push_back(drawn); }
  void contact(const DrawnContact& drawn) override { contacts.push_back(drawn); }
  void joint(const DrawnJoint& drawn) override { joints.push_back(drawn); }
  void wheel(const DrawnWheel& drawn) override { wheels.push_back(drawn); }
  void character(const DrawnCharacter& drawn) override { characters.push_back(drawn); }
  void particle(const DrawnParticle& drawn) override { particles.push_back(drawn); }
  void spring(const DrawnSpring& drawn) override { springs.push_back(drawn); }
  void link(const DrawnLink& drawn) override { links.push_back(drawn); }
  void collider(const DrawnCollider& drawn) override { colliders.push_back(drawn); }

  std::vector<DrawnBody> bodies;
  std::vector<ToldPart> parts;
  std::vector<DrawnLine> lines;
  std::vector<DrawnMass> masses;
  std::vector<DrawnBox> boxes;
  std::vector<DrawnIsland> islands;
  std::vector<DrawnContact> contacts;
  std::vector<DrawnJoint> joints;
  std::vector<DrawnWheel> wheels;
  std::vector<DrawnCharacter> characters;
  std::vector<DrawnParticle> particles;
  std::vector<DrawnSpring> springs;
  std::vector<DrawnLink> links;
  std::vector<DrawnCollider> colliders;
};

constexpr DrawOptions everything() { return {.masses = true, .boxes = true, .islands = true}; }

template <class W> Told told(const W& world, const DrawOptions& options = everything()) {
  Told to;
  draw(world, to, options);
  return to;
}
D3 real(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A crate of 1 x 2 x 3 m and 6 kg on the ground, above the point (4, 0, 5), its material's friction 0.6.
template <class S> struct Crate {
  explicit Crate(D3 velocity = {0, 0, 0}, double height = 1) : world(settings<S>()) {
    ground = add_ground(world);
    BodyDefinition<S> definition = moving<S>(add_box(world, 0.5, 1, 1.5), {4, height, 5}, velocity);
    definition.user_data = 42;
    definition.density = S(1);
    body = world.create(definition);
  }
  World<S> world;
  BodyId ground, body;
};

/// Equal numbers, whatever lies between their bytes.
void expect_same(const ToldPart& a, const ToldPart& b) {
  EXPECT_EQ(a.body.body, b.body.body);
  EXPECT_EQ(a.body.awake, b.body.awake);
  EXPECT_EQ(a.body.island, b.body.island);
  EXPECT_EQ(a.part.type, b.part.type);
  EXPECT_EQ(a.part.radius, b.part.radius);
  EXPECT_TRUE(std::equal(a.part.half, a.part.half + 3, b.part.half));
  EXPECT_TRUE(std::equal(a.part.pose.position, a.part.pose.position + 3, b.part.pose.position));
  EXPECT_TRUE(std::equal(a.part.pose.orientation, a.part.pose.orientation + 4, b.part.pose.orientation));
}
void expect_same(const DrawnContact& a, const DrawnContact& b) {
  EXPECT_EQ(a.a, b.a);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.asleep, b.asleep);
  ASSERT_EQ(a.count, b.count);
  for (std::uint32_t i = 0; i < a.count; ++i) {
    EXPECT_EQ(real(a.points[i].position), real(b.points[i].position));
    EXPECT_EQ(a.points[i].force, b.points[i].force);
    EXPECT_EQ(a.points[i].feature, b.points[i].feature);
  }
}
template <class T> void expect_same(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i]);
}

template <class S> class DebugDraws : public ::testing::Test {};
TYPED_TEST_SUITE(DebugDraws, AllScalars);

TYPED_TEST(DebugDraws, TellsBodiesWithTheirShapesWhereTheyAre) {
  const Crate<TypeParam> crate({1, 0, 2});
  const Told all = told(crate.world);
  ASSERT_EQ(all.bodies.size(), 2u);
  ASSERT_EQ(all.parts.size(), 2u);
  EXPECT_EQ(all.bodies[0].body, crate.ground);
  EXPECT_EQ(all.bodies[0].type, BodyType::static_);
  EXPECT_FALSE(all.bodies[0].awake);
  EXPECT_EQ(all.parts[0].part.type, ShapeType::half_space);
  expect_near(real(all.parts[0].part.normal), {0, 1, 0}, 1e-6);
  EXPECT_EQ(all.bodies[1].body, crate.body);
  EXPECT_EQ(all.bodies[1].type, BodyType::dynamic);
  EXPECT_EQ(all.bodies[1].user_data, 42u);
  EXPECT_TRUE(all.bodies[1].awake);
  EXPECT_EQ(all.bodies[1].island, DrawnBody::kNoIsland);
  expect_near(real(all.bodies[1].velocity), {1, 0, 2}, 1e-4);
  EXPECT_EQ(all.parts[1].body.body, crate.body);
  EXPECT_EQ(all.parts[1].part.type, ShapeType::box);
  EXPECT_EQ(real(all.parts[1].part.half), (D3{0.5, 1, 1.5}));
  EXPECT_EQ(real(all.parts[1].part.pose.position), (D3{4, 1, 5}));
}

TYPED_TEST(DebugDraws, PlacesPartsOfCompoundAndTurnedBodies) {
  using S = TypeParam;
  World<S> world(settings<S>());
  const Child<S> parts[] = {{primitive_of(Sphere<S>{S(0.5)}), Pose<S>::identity()},
                            {primitive_of(Sphere<S>{S(0.25)}), {vec<S>(2, 0, 0), Quat<Unit<S>>::identity()}}};
  BodyDefinition<S> definition = moving<S>(world.add_shape(std::span<const Child<S>>(parts)), {1, 2, 3});
  definition.orientation = turn<S>({0, 0, 1}, kPi / 2);  // x to y
  world.create(definition);
  const Told all = told(world);
  ASSERT_EQ(all.parts.size(), 2u);
  expect_near(real(all.parts[0].part.pose.position), {1, 2, 3}, 1e-3);
  expect_near(real(all.parts[1].part.pose.position), {1, 4, 3}, 1e-3);
  EXPECT_EQ(all.parts[1].part.child, 1u);
  EXPECT_EQ(all.parts[1].part.radius, 0.25f);
}

TYPED_TEST(DebugDraws, TellsWhichPartsSense) {
  using S = TypeParam;
  World<S> w{settings<S>()};
  Child<S> parts[] = {{primitive_of(Sphere<S>{S(0.5)}), Pose<S>::identity()},
                      {primitive_of(Sphere<S>{S(1)}), Pose<S>::identity()}};
  parts[1].traits.with(part_flag::kSensor);
  const ShapeId shape = w.add_shape(std::span<const Child<S>>(parts));
  BodyDefinition<S> zone = still<S>(shape, {4, 0, 0});
  zone.sensor = true;
  w.create(still<S>(shape, {0, 0, 0}));
  w.create(zone);
  const Told all = told(w);
  ASSERT_EQ(all.parts.size(), 4u);
  EXPECT_FALSE(all.parts[0].part.sensor);
  EXPECT_TRUE(all.parts[1].part.sensor);
  EXPECT_TRUE(all.parts[2].part.sensor) << "as its body";
  EXPECT_TRUE(all.parts[3].part.sensor);
}

/// Every line of a shape lies on its surface or within it, and on each axis the outline reaches as far as the shape.
TYPED_TEST(DebugDraws, OutlinesPartsByLines) {
  using S = TypeParam;
  const std::pair<Primitive<S>, D3> cases[] = {{primitive_of(Sphere<S>{S(0.5)}), {0.5, 0.5, 0.5}},
                                               {primitive_of(Box<S>{{S(0.5), S(1), S(1.5)}}), {0.5, 1, 1.5}},
                                               {primitive_of(Capsule<S>{S(0.5), S(1)}), {0.5, 1.5, 0.5}}};
  for (const auto& [primitive, reach] : cases) {
    SCOPED_TRACE(kShapeNames[static_cast<std::uint32_t>(primitive.type)]);
    World<S> world(settings<S>());
    const Child<S> part = {primitive, Pose<S>::identity()};
    world.create(moving<S>(world.add_shape(std::span<const Child<S>>(&part, 1)), {1, 2, 3}));
    EXPECT_TRUE(told(world).lines.empty()) << "nobody asked for them";
    const Told all = told(world, {.lines = true});
    EXPECT_GE(all.lines.size(), 12u);
    D3 most = {0, 0, 0};
    for (const DrawnLine& line : all.lines) {
      EXPECT_EQ(line.body, all.bodies[0].body);
      for (const D3& end : {real(line.from), real(line.to)}) {
        const D3 p = end - D3{1, 2, 3};
        const Vec3<S> local = vec<S>(p);
        const Transform<S> here = Transform<S>::of(Pose<S>::identity());
        EXPECT_NEAR(to_double(closest_point(primitive, here, local).distance), 0, 1e-3);
        for (int axis = 0; axis < 3; ++axis) most[axis] = std::max(most[axis], std::abs(p[axis]));
      }
    }
    expect_near(most, reach, 1e-3);
  }
}

TYPED_TEST(DebugDraws, OutlinesHalfSpacesOnTheirSurface) {
  using S = TypeParam;
  World<S> world(settings<S>());
  world.create(still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(-3)}), {2, 7, 1}));
  const Told all = told(world, {.lines = true});
  ASSERT_EQ(all.lines.size(), 6u);
  for (const DrawnLine& line : all.lines) {
    EXPECT_NEAR(line.from[1], 4, 1e-4);
    EXPECT_NEAR(line.to[1], 4, 1e-4);
  }
}

TYPED_TEST(DebugDraws, TellsWhichPointOfAHalfSpaceIsNearest) {
  using S = TypeParam;
  World<S> world(settings<S>());
  world.create(still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(1), Unit<S>(0), Unit<S>(0)}, S(-3)}), {2, 7, 1}));
  const Told all = told(world);
  ASSERT_EQ(all.parts.size(), 1u);
  expect_near(real(all.parts[0].part.pose.position), {-1, 7, 1}, 1e-6);
  expect_near(real(all.parts[0].part.normal), {1, 0, 0}, 1e-6);
}

TYPED_TEST(DebugDraws, TellsTheMassAboutPrincipalAxes) {
  const Crate<TypeParam> crate;
  const Told all = told(crate.world);
  ASSERT_EQ(all.masses.size(), 1u);  // the ground has none
  const DrawnMass& mass = all.masses[0];
  EXPECT_NEAR(mass.mass, 6, 1e-3);
  expect_near(real(mass.frame.position), {4, 1, 5}, 1e-3);
  float inertia[3] = {mass.inertia[0], mass.inertia[1], mass.inertia[2]};
  std::sort(inertia, inertia + 3);  // m / 12 (a^2 + b^2) of edges 1, 2, 3
  EXPECT_NEAR(inertia[0], 2.5, 0.01);
  EXPECT_NEAR(inertia[1], 5, 0.01);
  EXPECT_NEAR(inertia[2], 6.5, 0.01);
}

TYPED_TEST(DebugDraws, TellsFatBoxesThatHoldTheShape) {
  const Crate<TypeParam> crate;
  const Told all = told(crate.world);
  const auto found =
      std::find_if(all.boxes.begin(), all.boxes.end(), [&](const DrawnBox& box) { return box.body == crate.body; });
  ASSERT_NE(found, all.boxes.end());
  expect_near(real(found->low), {3.5 - 0.1, 0 - 0.1, 3.5 - 0.1}, 1e-3);
  expect_near(real(found->high), {4.5 + 0.1, 2 + 0.1, 6.5 + 0.1}, 1e-3);
}

TYPED_TEST(DebugDraws, TellsFourPointsUnderACrateAndWhatTheyCarry) {
  Crate<TypeParam> crate;
  run(crate.world, 20);
  const Told all = told(crate.world);
  ASSERT_EQ(all.contacts.size(), 1u);
  const DrawnContact& contact = all.contacts[0];
  EXPECT_EQ(contact.a, crate.ground);
  EXPECT_EQ(contact.b, crate.body);
  EXPECT_FALSE(contact.asleep);
  expect_near(real(contact.normal), {0, 1, 0}, 1e-3);
  ASSERT_EQ(contact.count, 4u);
  double force = 0;
  bool seen[2][2] = {};
  for (const DrawnContact::Point& point : contact.points) {
    EXPECT_NEAR(std::fabs(point.position[0] - 4), 0.5, 1e-2);
    EXPECT_NEAR(point.position[1], 0, 5e-3);
    EXPECT_NEAR(std::fabs(point.position[2] - 5), 1.5, 1e-2);
    EXPECT_NEAR(point.separation, 0, 5e-3);
    seen[point.position[0] > 4][point.position[2] > 5] = true;
    force += point.force;
  }
  EXPECT_TRUE(seen[0][0] && seen[0][1] && seen[1][0] && seen[1][1]);
  EXPECT_NEAR(force, 60, 3);  // 6 kg at 10 m/s^2
}

TYPED_TEST(DebugDraws, TellsNoContactOfPartsThatHaveMovedApart) {
  using S = TypeParam;
  Crate<S> crate;
  run(crate.world, 20);
  ASSERT_EQ(told(crate.world).contacts.size(), 1u);
  crate.world.set_pose(crate.body, {vec<S>(4, 9, 5), Quat<Unit<S>>::identity()});
  EXPECT_TRUE(told(crate.world).contacts.empty());
}

TYPED_TEST(DebugDraws, TellsSleepersAndTheirIsland) {
  Crate<TypeParam> crate;
  ASSERT_TRUE(settle(crate.world));
  const Told all = told(crate.world);
  ASSERT_EQ(all.bodies.size(), 2u);
  EXPECT_FALSE(all.bodies[1].awake);
  EXPECT_EQ(all.bodies[1].island, 0u);
  ASSERT_EQ(all.islands.size(), 1u);
  EXPECT_EQ(all.islands[0].bodies, 1u);
  EXPECT_EQ(all.islands[0].contacts, 1u);
  EXPECT_LT(all.islands[0].low[0], 3.5f);
  EXPECT_GT(all.islands[0].high[2], 6.5f);
  ASSERT_EQ(all.contacts.size(), 1u);
  EXPECT_TRUE(all.contacts[0].asleep);
  EXPECT_EQ(all.contacts[0].count, 4u);
}

TYPED_TEST(DebugDraws, TellsTheAnchorsOfJoints) {
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

TYPED_TEST(DebugDraws, TellsWheelsWhereTheyStandAndWhatTheyBear) {
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

TYPED_TEST(DebugDraws, TurnsWheelsAsTheyRollAndTellsTheirGrip) {
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

TYPED_TEST(DebugDraws, TellsWheelsInTheAirOfNoGround) {
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

TYPED_TEST(DebugDraws, TellsCharactersAndWhatTheyStandOn) {
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

TYPED_TEST(DebugDraws, ChangesNoHash) {
  Crate<TypeParam> drawn({3, 0, 1}, 2), left({3, 0, 1}, 2);
  for (int i = 0; i < 40; ++i) {
    const std::uint64_t before = drawn.world.hash();
    told(drawn.world);
    ASSERT_EQ(drawn.world.hash(), before);
    drawn.world.step();
    left.world.step();
    ASSERT_EQ(drawn.world.hash(), left.world.hash()) << "step " << i;
  }
}

TYPED_TEST(DebugDraws, TellsTheSameAfterALoad) {
  using S = TypeParam;
  Crate<S> crate({1, 0, 0}, 1.2);
  for (const int steps : {15, 120}) {  // sliding, asleep
    run(crate.world, steps);
    typename World<S>::Snapshot saved;
    crate.world.save(saved);
    World<S> other(crate.world.settings());
    other.load(saved);
    const Told here = told(crate.world), there = told(other);
    EXPECT_FALSE(here.contacts.empty());
    expect_same(here.parts, there.parts);
    expect_same(here.contacts, there.contacts);
  }
}

TYPED_TEST(DebugDraws, TellsOnlyWhatIsAskedFor) {
  Crate<TypeParam> crate;
  run(crate.world, 5);
  const Told none = told(crate.world, {.bodies = false, .contacts = false, .joints = false});
  EXPECT_TRUE(none.bodies.empty() && none.parts.empty() && none.masses.empty() && none.boxes.empty());
  EXPECT_TRUE(none.contacts.empty());
  const Told some = told(crate.world, {.bodies = false});
  EXPECT_TRUE(some.bodies.empty());
  EXPECT_EQ(some.contacts.size(), 1u);
}

TYPED_TEST(DebugDraws, TakesTheCamerasPlaceBeforeItRounds) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  world.create(moving<S>(add_ball(world, 0.5), {200.125, -4, 0.5}));
  const Told all = told(world, {.origin = {200, -4, 0}});
  ASSERT_EQ(all.bodies.size(), 1u);
  EXPECT_EQ(real(all.bodies[0].pose.position), (D3{0.125, 0, 0.5}));
}

TYPED_TEST(DebugDraws, TellsParticlesWithWhatTiesThem) {
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

}  // namespace
}  // namespace isostep::test
