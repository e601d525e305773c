// Bodies of many parts: surfaces among them, saves and files of them, and what fast bodies meet of them.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace compounds_test {

constexpr int kPosts = 12;  // children 2 to 13 of the yard

template <class S> class Compounds : public testing::Test {
 protected:
  static BlobRef patch(bool field) {
    if (field) return height_field_blob({9, 9, 0.5}, std::vector<double>(81, 0)).value();
    const std::vector<D3> points = {{0, 0, 0}, {0, 0, 4}, {4, 0, 0}, {4, 0, 4}};
    const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}, {{3, 2, 1}}};
    return mesh_blob(points, triangles, std::vector<std::uint8_t>{7, 8}).value();
  }
  /// A mesh over x 0 to 4, a height field over 6 to 10, z 0 to 4 each, and a row of posts along x beside them.
  static BodyId add_yard(World<S>& world) {
    const std::vector<BlobRef> blobs = {patch(false), patch(true)};
    std::vector<Child<S>> children = {part_at(primitive_of(Mesh<S>{1}), {0, 0, 0}),
                                      part_at(primitive_of(HeightField<S>{2}), {6, 0, 0})};
    for (int i = 0; i < kPosts; ++i)
      children.push_back(part_at(primitive_of(Box<S>{vec<S>(0.25, 0.5, 0.25)}), {1.0 * i, 0, -2}));
    return world.create(still<S>(world.add_shape(std::span<const Child<S>>(children), blobs)));
  }
  static ShapeId add_tray(World<S>& world, int wide, int deep) {
    std::vector<Child<S>> children;
    for (int i = 0; i < wide * deep; ++i)
      children.push_back(part_at(primitive_of(Box<S>{vec<S>(0.25, 0.125, 0.25)}),
                                 {0.5 * (i % wide) - 0.25 * wide, 0, 0.5 * (i / wide) - 0.25 * deep}));
    return world.add_shape(std::span<const Child<S>>(children));
  }
};
TYPED_TEST_SUITE(Compounds, AllScalars);

TYPED_TEST(Compounds, surfaces_and_solids_of_one_body_carry_what_lies_on_them) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  this->add_yard(world);
  const ShapeId box = add_box(world, 0.2, 0.25, 0.2);
  const D3 places[] = {{2, 0.4, 2}, {8, 0.4, 2}, {0, 0.9, -2}, {11, 0.9, -2}};
  std::vector<BodyId> bodies;
  for (const D3 at : places) bodies.push_back(world.create(moving<S>(box, at)));
  ASSERT_TRUE(settle(world));
  for (int n = 0; n < 4; ++n)
    EXPECT_NEAR(to_double(world.pose(bodies[static_cast<std::size_t>(n)]).position.y), n < 2 ? 0.25 : 0.75, 0.01) << n;
}

TYPED_TEST(Compounds, rays_name_the_child_and_its_triangle) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  const BodyId yard = this->add_yard(world);
  struct Shot {
    D3 from;
    std::uint32_t child, triangle;
    std::uint8_t material;
  };
  const Shot shots[] = {{{0.5, 2, 0.5}, 0, 0, 7},   {{3.5, 2, 3.5}, 0, 1, 8}, {{6.1, 2, 0.1}, 1, 0, 0},
                        {{9.9, 2, 3.9}, 1, 127, 0}, {{0, 2, -2}, 2, 0, 0},    {{11, 2, -2}, 13, 0, 0}};
  for (const Shot& shot : shots) {
    const auto hit = world.cast_ray(vec<S>(shot.from), vec<S>(0, -4, 0));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, yard);
    EXPECT_EQ(hit->child, shot.child);
    EXPECT_EQ(hit->triangle, shot.triangle);
    EXPECT_EQ(hit->material, shot.material);
    std::vector<OverlapHit> touched;
    const Primitive<S> ball = primitive_of(Sphere<S>{num<S>(0.125)});
    const double height = shot.child < 2 ? 0.1 : 0.6;
    world.overlap_shape(ball, {vec<S>(shot.from.x, height, shot.from.z), Quat<Unit<S>>::identity()}, touched);
    ASSERT_EQ(touched.size(), 1u);
    EXPECT_EQ(touched[0].child, shot.child);
  }
  QueryFilter each;
  each.per = HitPer::child;
  std::vector<RayCastHit<S>> posts;
  world.cast_ray_all(vec<S>(-2, 0.25, -2), vec<S>(16, 0, 0), posts, each);
  ASSERT_EQ(posts.size(), static_cast<std::size_t>(kPosts));
  for (std::uint32_t i = 0; i < posts.size(); ++i) EXPECT_EQ(posts[i].child, 2 + i) << "in order along the ray";
}

TYPED_TEST(Compounds, fast_bodies_do_not_pass_any_part) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  this->add_yard(world);
  const ShapeId ball = add_ball(world, 0.0625);
  const double speed = pick<S>(200, 200, 60, 200);
  const D3 from[] = {{2, 3, 1}, {8, 3, 1}, {5, 3, -2}, {11, 3, -2}};
  std::vector<BodyId> bodies;
  for (const D3 at : from) bodies.push_back(world.create(moving<S>(ball, at, {0, -speed, 0})));
  for (int frame = 0; frame < 20; ++frame) world.step();
  for (int n = 0; n < 4; ++n) {
    const double y = to_double(world.pose(bodies[static_cast<std::size_t>(n)]).position.y);
    EXPECT_GT(y, n < 2 ? 0 : 0.5) << n;
  }
}

TYPED_TEST(Compounds, worlds_that_load_or_read_them_go_on_alike) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  add_ground(world);
  const ShapeId tray = this->add_tray(world, 8, 6);
  for (int i = 0; i < 3; ++i) world.create(moving<S>(tray, {0.3 * i, 0.5 + 0.6 * i, 0.2 * i}));
  const ShapeId box = add_box(world, 0.125, 0.125, 0.125);
  for (int i = 0; i < 20; ++i) world.create(moving<S>(box, {0.4 * (i % 5) - 1, 3 + 0.3 * (i / 5), 0.1 * i - 1}));
  run(world, 20);
  typename World<S>::Snapshot then;
  world.save(then);
  const std::vector<std::uint8_t> bytes = bytes_of(world);
  run(world, 40);
  const std::uint64_t hash = world.hash();
  const ShapeId another = this->add_tray(world, 5, 5);  // another tree, which the snapshot does not have
  world.create(moving<S>(another, {0, 6, 0}));
  world.step();
  ASSERT_TRUE(world.load(then));
  World<S> read(settings<S>(-10));
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  EXPECT_NE(read.state().shapes[tray.slot]->tree, nullptr);
  run(world, 40);
  run(read, 40);
  EXPECT_EQ(world.hash(), hash);
  EXPECT_EQ(read.hash(), hash);
}

TYPED_TEST(Compounds, a_shape_that_is_removed_leaves_no_tree_to_the_next_in_its_place) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  const ShapeId tray = this->add_tray(world, 4, 4);
  ASSERT_TRUE(world.remove_shape(tray));
  const ShapeId ball = add_ball(world, 0.5);
  ASSERT_EQ(ball.slot, tray.slot);
  world.create(moving<S>(ball, {0, 0, 0}));
  EXPECT_EQ(world.state().shapes[ball.slot]->tree, nullptr);
  EXPECT_TRUE(world.cast_ray(vec<S>(0, 2, 0), vec<S>(0, -4, 0)));
  EXPECT_FALSE(world.cast_ray(vec<S>(0.9, 2, 0), vec<S>(0, -4, 0)));
}

}  // namespace compounds_test
}  // namespace isostep::test
