// Hulls as bodies of worlds: at rest, in queries, through snapshots, files and recordings.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/replay/recorder.hpp"
#include "scenes/hull_recipes.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace hulls_test {

BlobRef blob_of(const std::vector<scenes::Point>& points) {
  std::vector<D3> own;
  for (const scenes::Point& p : points) own.push_back({p.x, p.y, p.z});
  return hull_blob(std::span<const D3>(own)).value();
}
/// 0.5 m high, wider below.
BlobRef frustum() { return blob_of(scenes::frustum_points(0.5, 0.2, 0.5)); }

template <class S> class Hulls : public ::testing::Test {};
TYPED_TEST_SUITE(Hulls, AllScalars);

TYPED_TEST(Hulls, one_on_another_on_a_box_comes_to_rest) {
  using S = TypeParam;
  World<S> world(settings<S>());
  world.create(still<S>(add_box<S>(world, 5, 1, 5), {0, -1, 0}));
  const ShapeId shape = world.add_shape(frustum());
  const BodyId below = world.create(moving<S>(shape, {0, 0.3, 0})), above = world.create(moving<S>(shape, {0, 0.9, 0}));
  run(world, 120);
  EXPECT_NEAR(to_double(world.pose(below).position.y), 0.25, 0.003);
  EXPECT_NEAR(to_double(world.pose(above).position.y), 0.75, 0.005);
  EXPECT_LT(length(real(world.view(above).state->velocity)), 1e-3);
  EXPECT_TRUE(settle(world, 120));
}

TYPED_TEST(Hulls, rolls_about_its_centre_of_mass_not_its_origin) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  std::vector<scenes::Point> points = scenes::prism_points(0.4, 0.2, 0.3);
  for (scenes::Point& p : points) p.x += 2;
  BodyDefinition<S> d = moving<S>(world.add_shape(blob_of(points)), {0, 0, 0});
  d.angular_velocity = vec<S>(0, 1, 0);
  const BodyId body = world.create(d);
  const D3 start = real(world.view(body).state->centre);
  EXPECT_NEAR(start.x, 2, 0.05);
  run(world, 60);
  expect_near(real(world.view(body).state->centre), start, 1e-3);
  EXPECT_NEAR(to_double(world.pose(body).position.x), 2 - 2 * std::cos(1.0), 0.05);
}

TYPED_TEST(Hulls, every_kind_of_body_meets_it) {
  using S = TypeParam;
  const ShapeType types[] = {ShapeType::sphere, ShapeType::box, ShapeType::capsule, ShapeType::hull};
  for (const ShapeType type : types) {
    World<S> world(settings<S>());
    world.create(still<S>(world.add_shape(frustum()), {0, -0.25, 0}));
    const ShapeId shape = type == ShapeType::sphere    ? add_ball<S>(world, 0.125)
                          : type == ShapeType::box     ? add_box<S>(world, 0.125, 0.125, 0.125)
                          : type == ShapeType::capsule ? world.add_shape(Capsule<S>{num<S>(0.125), num<S>(0.0625)})
                                                       : world.add_shape(blob_of(scenes::prism_points(0, 0, 0)));
    BodyDefinition<S> d = moving<S>(shape, {0, 0.25, 0});
    d.material.rolling_resistance = num<S>(0.02);
    const BodyId body = world.create(d);
    run(world, 90);
    const double y = to_double(world.pose(body).position.y);
    EXPECT_GT(y, 0.1) << kShapeNames[static_cast<int>(type)];
    EXPECT_LT(y, 0.25) << kShapeNames[static_cast<int>(type)];
    EXPECT_GT(world.counts().contacts, 0u);
  }
}

TYPED_TEST(Hulls, queries_see_it) {
  using S = TypeParam;
  World<S> world(settings<S>());
  const BodyId body = world.create(still<S>(world.add_shape(frustum()), {3, 0, 0}));
  const auto hit = world.cast_ray(vec<S>(3, 4, 0), vec<S>(0, -8, 0));
  ASSERT_TRUE(hit && hit->body == body);
  EXPECT_NEAR(to_double(hit->point.y), 0.25, 2e-3);
  EXPECT_NEAR(to_double(hit->normal.y), 1, 1e-4);
  EXPECT_FALSE(world.cast_ray(vec<S>(3, 4, 1), vec<S>(0, -8, 0)));
  const auto nearest = world.closest_point(vec<S>(3, 1.25, 0), S(2));
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(to_double(nearest->distance), 1, 2e-3);
  std::vector<BodyId> found;
  world.overlap_shape(primitive_of(Sphere<S>{num<S>(0.5)}), {vec<S>(3, 0.625, 0), Quat<Unit<S>>::identity()}, found);
  EXPECT_EQ(found, std::vector<BodyId>{body});
  found.clear();
  world.overlap_shape(Hull<S>{1}.primitive(), Pose<S>::identity(), found);
  EXPECT_EQ(world.fault(), Fault::bad_shape);
  EXPECT_STREQ(world.fault().field, "primitive.blob");
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(Hulls, a_world_that_goes_back_before_its_shape_makes_the_same_future) {
  using S = TypeParam;
  World<S> world(settings<S>());
  add_ground(world);
  typename World<S>::Snapshot before;
  world.save(before);
  const BlobRef blob = frustum();
  const auto play = [&] {
    const ShapeId shape = world.add_shape(blob);
    world.create(moving<S>(shape, {0, 1, 0}));
    run(world, 50);
    EXPECT_GT(world.counts().contacts, 0u);
    return world.hash();
  };
  const std::uint64_t hash = play();
  EXPECT_TRUE(world.load(before));
  EXPECT_TRUE(world.state().geometry->empty());
  EXPECT_EQ(play(), hash);
}

TYPED_TEST(Hulls, files_and_recordings_carry_it) {
  using S = TypeParam;
  World<S> world(settings<S>());
  std::vector<std::uint8_t> log;
  world.record_to(&log);
  add_ground(world);
  for (int i = 0; i < 3; ++i)
    world.create(moving<S>(world.add_shape(i == 1 ? blob_of(scenes::cone_points(0.5, 0.5, 0.5)) : frustum()),
                           {0.1 * i, 0.5 + 0.7 * i, 0}));
  for (int i = 0; i < 40; ++i) world.step();
  World<S> played(settings<S>()), read;
  EXPECT_TRUE(play_commands<EveryCommand<S>>(
                  log, [&](const auto& c) { return static_cast<bool>(played.apply(c)); }, [&] { played.step(); })
                  .ok());
  EXPECT_EQ(played.hash(), world.hash());
  const std::vector<std::uint8_t> bytes = bytes_of(world);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  world.record_to(nullptr);
  for (int i = 0; i < 40; ++i) {
    world.step();
    read.step();
    ASSERT_EQ(read.hash(), world.hash()) << i;
  }
  EXPECT_EQ(world.state().geometry->names().size(), 2u);
}

}  // namespace hulls_test
}  // namespace isostep::test
