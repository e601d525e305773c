// Drawing: what a DebugDraw is told of bodies, shapes and contacts that are known from their building.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "isostep/collision/query/closest_point.hpp"
#include "unit/world/debug_draw_told.hpp"

namespace isostep::test {
namespace debug_draw_test {

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

}  // namespace debug_draw_test
}  // namespace isostep::test
