// Materials of triangles: one surface of ice and rubber slows boxes as two bodies of those materials do.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace ground_materials_test {

constexpr std::uint32_t kExponent = 10;
constexpr int kColumns = 25, kRows = 9;  // of half a metre: 12 m long, the first half ice
constexpr double kIce = 0, kRubber = 0.875;

SurfaceMaterial listed(double friction, double restitution = 0) {
  return surface_material(friction, restitution).value();
}

template <class S> class GroundMaterials : public testing::Test {
 protected:
  /// Flat, from x = 0 and z = -2 on; material 0 before the middle, 1 behind it, 2 in the last row. Of `only` one,
  /// where that is not negative: the rest are ghosts.
  static BlobRef ground(bool field, const std::vector<SurfaceMaterial>& table, int only) {
    std::vector<std::uint8_t> of_cells, of_triangles;
    std::vector<MeshPoint> points;
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k < kRows; ++k) {
      for (int i = 0; i < kColumns; ++i) {
        points.push_back({512 * i, 0, 512 * k - 2048});
        if (i + 1 == kColumns || k + 1 == kRows) continue;
        const auto at = static_cast<std::uint32_t>(k * kColumns + i), below = at + kColumns;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
        const int number = k + 2 == kRows ? 2 : 2 * (i + 1) < kColumns ? 0 : 1;
        of_cells.push_back(only < 0 || only == number ? static_cast<std::uint8_t>(number) : kGhostMaterial);
        for (int half = 0; half < 2; ++half) of_triangles.push_back(of_cells.back());
      }
    }
    if (!field) return mesh_blob(triangle_mesh(points, triangles, {of_triangles, table}, kExponent).value());
    const std::vector<std::int16_t> heights(points.size(), 0);
    return height_field_blob(height_field({kExponent, 0, kColumns, kRows, 512}, heights, {of_cells, table}).value());
  }
  static void add(World<S>& world, bool field, const std::vector<SurfaceMaterial>& table, double friction,
                  double restitution = 0, int only = -1) {
    BodyDefinition<S> d = still<S>(world.add_shape(ground(field, table, only)), {0, 0, field ? -2.0 : 0.0});
    d.material.friction = num<S>(friction);
    d.material.restitution = num<S>(restitution);
    ASSERT_TRUE(world.create(d));
  }
  static BodyId add_slider(World<S>& world, double x, double z) {
    BodyDefinition<S> d = moving<S>(add_box(world, 0.2, 0.25, 0.2), {x, 0.25, z}, {4, 0, 0});
    d.material.friction = num<S>(kRubber);
    return world.create(d);
  }
};
TYPED_TEST_SUITE(GroundMaterials, AllScalars);

TYPED_TEST(GroundMaterials, what_slides_over_ice_stops_on_rubber_as_on_a_body_of_each) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    World<S> one(settings<S>(-10)), two(settings<S>(-10));
    this->add(one, field, {listed(kIce), listed(kRubber)}, 0.3);
    this->add(two, field, {}, kIce, 0, 0);
    this->add(two, field, {}, kRubber, 0, 1);
    const BodyId a = this->add_slider(one, 1, 0.1), b = this->add_slider(two, 1, 0.1);
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(one.step().clean());
      ASSERT_TRUE(two.step().clean());
    }
    EXPECT_NEAR(to_double(one.velocity(a).x), 4, 0.01) << "ice takes nothing";
    EXPECT_NEAR(to_double(two.velocity(b).x), 4, 0.01);
    for (int frame = 0; frame < 180; ++frame) {
      ASSERT_TRUE(one.step().clean());
      ASSERT_TRUE(two.step().clean());
    }
    const double stopped = to_double(one.pose(a).position.x);
    EXPECT_NEAR(to_double(one.velocity(a).x), 0, 1e-3) << "rubber stops it";
    EXPECT_GT(stopped, 6.5);
    EXPECT_LT(stopped, 7.25) << "v^2 / (2 mu g) is 0.91 m";
    EXPECT_NEAR(stopped, to_double(two.pose(b).position.x), 0.05);
  }
}

TYPED_TEST(GroundMaterials, a_number_beyond_the_table_is_of_the_bodys_own_material) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    World<S> with(settings<S>(-10)), without(settings<S>(-10));
    this->add(with, field, {listed(kIce), listed(kIce)}, 0.5);
    this->add(without, field, {}, 0.5);
    const BodyId a = this->add_slider(with, 1, 1.75), b = this->add_slider(without, 1, 1.75);
    run(with, 90);
    run(without, 90);
    EXPECT_EQ(with.pose(a).position.x, without.pose(b).position.x);
    EXPECT_NEAR(to_double(with.velocity(a).x), 0, 1e-3);
  }
}

TYPED_TEST(GroundMaterials, what_falls_bounces_as_the_triangles_say) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    World<S> world(settings<S>(-10));
    this->add(world, field, {listed(0.5, 0.75), listed(0.5, 0)}, 0.5, 1);
    const ShapeId ball = add_ball(world, 0.25);
    const BodyId springy = world.create(moving<S>(ball, {2.3, 1.25, 0.1})),
                 dead = world.create(moving<S>(ball, {8.3, 1.25, 0.1}));
    double most[2] = {0, 0};  // [m/s] upwards
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(world.step().clean());
      most[0] = std::max(most[0], to_double(world.velocity(springy).y));
      most[1] = std::max(most[1], to_double(world.velocity(dead).y));
    }
    EXPECT_NEAR(most[0], 0.75 * std::sqrt(20.0), 0.2) << "of a fall of 1 m";
    EXPECT_LT(most[1], 0.05);
  }
}

TEST(SurfaceMaterials, tables_are_part_of_the_content_and_only_if_they_hold_something) {
  const std::vector<MeshPoint> points = {{0, 0, 0}, {0, 0, 1024}, {1024, 0, 0}};
  const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}};
  const std::vector<std::uint8_t> numbers = {1};
  const std::vector<SurfaceMaterial> table = {listed(0.5), listed(0.25, 1)};
  const TriangleMesh plain = triangle_mesh(points, triangles, numbers, 10).value(),
                     with = triangle_mesh(points, triangles, {numbers, table}, 10).value();
  EXPECT_EQ(plain.bytes().size() + 4 + 2 * 4, with.bytes().size());
  EXPECT_EQ(plain.bytes(), triangle_mesh(points, triangles, {numbers, {}}, 10).value().bytes());
  const TriangleMesh read = read_triangle_mesh(with.bytes()).value();
  ASSERT_EQ(read.table().size(), 2u);
  EXPECT_TRUE(read.table()[1] == table[1]);
  EXPECT_EQ(read.bytes(), with.bytes());
  std::vector<std::uint8_t> empty_table = plain.bytes();
  empty_table.insert(empty_table.end(), 4, 0);
  EXPECT_FALSE(read_triangle_mesh(empty_table).ok()) << "one content, one form";

  const std::vector<std::int16_t> heights(4, 0);
  const HeightGrid grid = {10, 0, 2, 2, 1024};
  const BakedHeightField field = height_field(grid, heights, {numbers, table}).value();
  EXPECT_EQ(field.bytes().size(), height_field(grid, heights, numbers).value().bytes().size() + 4 + 2 * 4);
  EXPECT_TRUE(read_height_field(field.bytes()).value().table()[1] == table[1]);
}

TEST(SurfaceMaterials, what_is_no_material_is_refused) {
  const auto place = [](const auto& result) { return result.ok() ? "" : std::string(result.error().place.view()); };
  EXPECT_EQ(place(surface_material(-0.1, 0)), "friction");
  EXPECT_EQ(place(surface_material(16.5, 0)), "friction");
  EXPECT_EQ(place(surface_material(std::nan(""), 0)), "friction");
  EXPECT_EQ(place(surface_material(0, 1.01)), "restitution");
  EXPECT_EQ(surface_material(1, 0.5).value().friction, 1024);
  const std::vector<MeshPoint> points = {{0, 0, 0}, {0, 0, 1024}, {1024, 0, 0}};
  const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}};
  const std::vector<SurfaceMaterial> bad = {listed(0.5), {1, 1025}}, many(255, listed(1));
  const std::vector<std::uint8_t> numbers = {0}, ghosts = {kGhostMaterial};
  EXPECT_EQ(place(triangle_mesh(points, triangles, {numbers, bad}, 10)), "table[1]");
  EXPECT_EQ(place(triangle_mesh(points, triangles, {numbers, many}, 10)), "table");
  EXPECT_EQ(place(triangle_mesh(points, triangles, ghosts, 10)), "materials");
  const std::vector<std::int16_t> heights(4, 0);
  EXPECT_EQ(place(height_field({10, 0, 2, 2, 1024}, heights, {numbers, bad})), "table[1]");
  EXPECT_EQ(place(height_field({10, 0, 2, 2, 1024}, heights, ghosts)), "materials");
}

}  // namespace ground_materials_test
}  // namespace isostep::test
