// Height fields against meshes of the same triangles, and what is refused, of input and of bytes.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/height_field.hpp"

#include <gtest/gtest.h>

#include "sample.hpp"
#include "unit/geometry/baked_surface.hpp"

namespace isostep::test {
namespace height_field_test {

static_assert(TriangleGeometry<BakedHeightField>);

using Heights = std::vector<std::int16_t>;
using Materials = std::vector<std::uint8_t>;

Heights random_heights(Random& random, std::uint32_t count, std::uint32_t range) {
  Heights heights(count);
  const int low = -static_cast<int>(range);
  for (std::int16_t& h : heights) h = static_cast<std::int16_t>(low + static_cast<int>(random() % (2 * range)));
  return heights;
}

/// One cell in six is a hole.
Materials random_materials(Random& random, std::uint32_t count) {
  Materials materials(count);
  for (std::uint8_t& m : materials) {
    const bool is_hole = random() % 6 == 0;
    m = static_cast<std::uint8_t>(is_hole ? BakedHeightField::kHole : random() % kGhostMaterial);
  }
  materials[count / 2] = 7;
  return materials;
}

/// A field, and the mesh of those of its triangles that are there.
struct Pair {
  BakedHeightField field;
  TriangleMesh mesh;
  std::vector<std::uint32_t> id_of;  // by triangle of the mesh

  Pair(const HeightGrid& grid, const Heights& heights, const Materials& materials)
      : Pair(height_field(grid, heights, materials).value(), surface_of(grid, heights)) {}

 private:
  Pair(const BakedHeightField& of, const Surface& surface) : Pair(of, surface, ids(of)) {}
  Pair(const BakedHeightField& of, const Surface& surface, const std::vector<std::uint32_t>& kept)
      : field(of), mesh(mesh_of(of, surface, kept)), id_of(kept) {}

  static std::vector<std::uint32_t> ids(const BakedHeightField& of) {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t id = 0; id < of.triangle_count(); ++id) {
      if (of.has_triangle(id)) kept.push_back(id);
    }
    return kept;
  }
  static TriangleMesh mesh_of(const BakedHeightField& of, const Surface& surface,
                              const std::vector<std::uint32_t>& kept) {
    std::vector<MeshTriangle> triangles;
    Materials materials;
    for (const std::uint32_t id : kept) {
      triangles.push_back(surface.triangles[id]);
      materials.push_back(of.materials()[id / 2]);
    }
    return triangle_mesh(surface.points, triangles, materials, of.exponent()).value();
  }
};

void expect_same_triangles(const Pair& pair) {
  ASSERT_EQ(pair.field.exponent(), pair.mesh.exponent());
  for (std::uint32_t t = 0; t < pair.mesh.triangle_count(); ++t) {
    const std::uint32_t id = pair.id_of[t];
    ASSERT_TRUE(pair.field.triangle(id) == pair.mesh.triangle(t)) << id;
    EXPECT_GT(pair.field.triangle(id).normal().y, 0);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t across = pair.mesh.neighbour(t, k);
      ASSERT_EQ(pair.field.neighbour(id, k), across == kNoTriangle ? across : pair.id_of[across]) << id;
    }
  }
}

TEST(HeightField, has_the_triangles_of_a_mesh_over_the_same_terrain) {
  const Surface surface = terrain();
  const Pair pair(surface.grid, surface.heights, {});
  EXPECT_EQ(pair.field.triangle_count(), 20000u);
  EXPECT_EQ(pair.mesh.triangle_count(), 20000u);
  expect_same_triangles(pair);
  std::size_t kinds[5] = {};
  for (std::uint32_t t = 0; t < 20000; ++t) {
    for (const EdgeKind kind : pair.field.triangle(t).edges) ++kinds[static_cast<int>(kind)];
  }
  EXPECT_EQ(kinds[static_cast<int>(EdgeKind::border)], 400u);
  EXPECT_GT(kinds[static_cast<int>(EdgeKind::convex)], 10000u);
  EXPECT_GT(kinds[static_cast<int>(EdgeKind::concave)], 10000u);
  EXPECT_EQ(kinds[static_cast<int>(EdgeKind::fold)], 0u);
}

TEST(HeightField, has_the_triangles_of_a_mesh_with_holes_and_every_scale) {
  Random random(1);
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    const std::uint32_t columns = 2 + random() % 12, rows = 2 + random() % 12;
    const HeightGrid grid = {trial % 17, trial % 8, columns, rows, 1 + random() % 70000};
    const std::uint32_t range = trial % 3 == 0 ? 32768 : 2;  // of few heights, many edges are flat
    const Heights heights = random_heights(random, columns * rows, range);
    const Materials materials = random_materials(random, (columns - 1) * (rows - 1));
    ASSERT_NO_FATAL_FAILURE(expect_same_triangles(Pair(grid, heights, materials))) << trial;
  }
}

/// Cells that are no one's own tell their neighbours how the ground goes on, and are nowhere found.
TEST(HeightField, ghosts_are_neighbours_and_nothing_else) {
  Random random(11);
  const std::uint32_t columns = 21, rows = 17, cells = (columns - 1) * (rows - 1);
  const HeightGrid grid = {10, 1, columns, rows, 300};
  const Heights heights = random_heights(random, columns * rows, 500);
  Materials solid(cells, 3), ghosts(cells, 3), holes(cells, 3);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (random() % 4 == 0) ghosts[cell] = kGhostMaterial, holes[cell] = BakedHeightField::kHole;
  }
  const BakedHeightField whole = height_field(grid, heights, solid).value(),
                         with = height_field(grid, heights, ghosts).value(),
                         without = height_field(grid, heights, holes).value();
  const TriangleMesh mesh = [&] {
    const Surface surface = surface_of(grid, heights);
    Materials of_triangles;
    for (const std::uint8_t number : ghosts) of_triangles.insert(of_triangles.end(), 2, number);
    return triangle_mesh(surface.points, surface.triangles, of_triangles, 10).value();
  }();
  EXPECT_EQ(queried(with, whole.bounds()), queried(without, whole.bounds()));
  std::vector<std::uint32_t> of_mesh = queried(mesh, whole.bounds());
  std::sort(of_mesh.begin(), of_mesh.end());
  EXPECT_EQ(of_mesh, queried(with, whole.bounds()));
  ASSERT_NO_FATAL_FAILURE(expect_queries_find_all(with, 5, 200));
  ASSERT_NO_FATAL_FAILURE(expect_queries_find_all(mesh, 5, 200));
  for (std::uint32_t id = 0; id < whole.triangle_count(); ++id) {
    const bool there = ghosts[id / 2] != kGhostMaterial;
    ASSERT_EQ(with.has_triangle(id), there);
    ASSERT_EQ(mesh.has_triangle(id), there);
    if (!there) continue;
    ASSERT_TRUE(with.triangle(id) == whole.triangle(id)) << "with the neighbours of the whole";
    ASSERT_TRUE(mesh.triangle(id) == whole.triangle(id));
    for (int k = 0; k < 3; ++k) ASSERT_EQ(with.neighbour(id, k), whole.neighbour(id, k));
  }
}

TEST(HeightField, queries_find_what_all_triangles_say) {
  Random random(2);
  for (std::uint32_t trial = 0; trial < sampled(60u, 20u); ++trial) {
    const std::uint32_t columns = 2 + random() % 40, rows = 2 + random() % 40;
    const HeightGrid grid = {10, trial % 8, columns, rows, 1 + random() % 2000};
    const Heights heights = random_heights(random, columns * rows, 1 + random() % 32768);
    const Materials materials = random_materials(random, (columns - 1) * (rows - 1));
    const BakedHeightField field = height_field(grid, heights, materials).value();
    ASSERT_NO_FATAL_FAILURE(expect_queries_find_all(field, 3 + trial, 200)) << trial;
  }
  const Surface surface = terrain();
  expect_queries_find_all(height_field(surface.grid, surface.heights, {}).value(), 4, 500);
}

TEST(HeightField, queries_ascend) {
  const Surface surface = terrain();
  const BakedHeightField field = height_field(surface.grid, surface.heights, {}).value();
  BoxDraws draws(5, field.bounds());
  for (int n = 0; n < 200; ++n) {
    const std::vector<std::uint32_t> ids = queried(field, draws.box());
    ASSERT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  }
  EXPECT_EQ(queried(field, field.bounds()).size(), 20000u);
}

TEST(HeightField, traversals_may_shrink_and_end) {
  const Surface surface = terrain();
  const BakedHeightField field = height_field(surface.grid, surface.heights, {}).value();
  expect_traversals_may_shrink(field, 12345);
  expect_visits_end_when_told(field);
  EXPECT_TRUE(field.traverse([](const MeshBox&) { return false; }, [](std::uint32_t) { return false; }));
}

TEST(HeightField, a_strip_as_long_as_the_grid_has_one_block_at_the_top) {
  constexpr std::uint32_t kColumns = 1u << 23;
  Heights heights(2 * kColumns, 0);
  heights[5000000] = 9;
  const BakedHeightField field = height_field({0, 0, kColumns, 2, 1}, heights, {}).value();
  EXPECT_EQ(field.bounds().high[0], MeshPoint::kLimit - 1);
  EXPECT_EQ(field.bounds().high[1], 9);
  const std::vector<std::uint32_t> expected = {2 * 4999999, 2 * 4999999 + 1, 2 * 5000000};
  EXPECT_EQ(queried(field, {{INT64_MIN, 5, INT64_MIN}, {INT64_MAX, 100, INT64_MAX}}), expected);
  std::vector<std::uint32_t> reached;
  field.traverse([](const MeshBox& box) { return box.high[1] >= 5; },
                 [&](std::uint32_t id) {
                   reached.push_back(id);
                   return true;
                 });
  EXPECT_EQ(reached, (std::vector<std::uint32_t>{2 * 4999999, 2 * 4999999 + 1, 2 * 5000000, 2 * 5000000 + 1}));
}

TEST(HeightField, other_heights_give_the_field_that_they_would_have_made) {
  Random random(6);
  const std::uint32_t columns = 37, rows = 23;
  const HeightGrid grid = {10, 2, columns, rows, 100};
  Materials materials = random_materials(random, (columns - 1) * (rows - 1));
  Heights heights = random_heights(random, columns * rows, 1000);
  BakedHeightField field = height_field(grid, heights, materials).value();
  for (int trial = 0; trial < 300; ++trial) {
    const std::uint32_t column = random() % columns, row = random() % rows;
    const std::uint32_t wide = 1 + random() % (columns - column), deep = 1 + random() % (rows - row);
    const Heights patch = random_heights(random, wide * deep, 1 + random() % 3000);
    const bool materials_too = wide > 1 && deep > 1 && trial % 2 == 0;
    const Materials numbers = materials_too ? random_materials(random, (wide - 1) * (deep - 1)) : Materials{};
    const std::vector<std::uint8_t> before = field.bytes();
    const Result<BakedHeightField> changed = field.with_heights({column, row, wide, deep, patch, numbers});
    ASSERT_TRUE(changed.ok()) << fault_text(changed);
    EXPECT_EQ(field.bytes(), before) << "the field itself stays";
    for (std::uint32_t k = 0; k < deep; ++k) {
      for (std::uint32_t i = 0; i < wide; ++i) heights[(row + k) * columns + column + i] = patch[k * wide + i];
    }
    for (std::uint32_t cell = 0; cell < numbers.size(); ++cell)
      materials[(row + cell / (wide - 1)) * (columns - 1) + column + cell % (wide - 1)] = numbers[cell];
    const BakedHeightField fresh = height_field(grid, heights, materials).value();
    ASSERT_EQ(changed.value().bytes(), fresh.bytes());
    std::vector<MeshBox> nodes, fresh_nodes;  // all of the pyramid
    const auto list = [](std::vector<MeshBox>& to) {
      return [&to](const MeshBox& box) {
        to.push_back(box);
        return true;
      };
    };
    const auto visit = [](std::uint32_t) { return true; };
    changed.value().traverse(list(nodes), visit);
    fresh.traverse(list(fresh_nodes), visit);
    ASSERT_EQ(nodes.size(), fresh_nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(nodes[n].low[axis], fresh_nodes[n].low[axis]);
        ASSERT_EQ(nodes[n].high[axis], fresh_nodes[n].high[axis]);
      }
    }
    field = changed.value();
  }
  const char* const kLeaves = "heights: the rectangle is empty or leaves the field";
  const auto fault = [&](std::uint32_t column, std::uint32_t row, std::uint32_t wide, std::uint32_t deep,
                         const Heights& patch, const Materials& numbers = {}) {
    return fault_text(field.with_heights({column, row, wide, deep, patch, numbers}));
  };
  EXPECT_EQ(fault(30, 0, 8, 1, Heights(8)), kLeaves);
  EXPECT_EQ(fault(0, 20, 1, 4, Heights(4)), kLeaves);
  EXPECT_EQ(fault(38, 0, 1, 1, Heights(1)), kLeaves);
  EXPECT_EQ(fault(0, 24, 1, 1, Heights(1)), kLeaves);
  EXPECT_EQ(fault(1, 0, 0xffffffffu, 1, {}), kLeaves);
  EXPECT_EQ(fault(1, 0, 0, 1, {}), kLeaves);
  EXPECT_EQ(fault(0, 0, 2, 2, Heights(3)), "heights: 3 heights for 4 places");
  EXPECT_EQ(fault(0, 0, 3, 2, Heights(6), Materials(3)), "materials: 3 materials for 2 cells");
  EXPECT_EQ(fault(0, 0, columns, rows, Heights(columns * rows),
                  Materials((columns - 1) * (rows - 1), BakedHeightField::kHole)),
            "materials: every cell is a hole or a ghost");
}

std::string fault_of(const HeightGrid& grid, std::size_t heights = 6, const Materials& materials = {}) {
  return fault_text(height_field(grid, Heights(heights), materials));
}

TEST(HeightField, names_what_it_refuses) {
  EXPECT_EQ(fault_of({10, 0, 3, 2, 5}), "");
  EXPECT_EQ(fault_of({17, 0, 3, 2, 5}), "exponent: the exponent of a step is 0 to 16");
  EXPECT_EQ(fault_of({10, 8, 3, 2, 5}), "height_shift: a unit of height is 2^0 to 2^7 steps");
  EXPECT_EQ(fault_of({10, 0, 1, 6, 5}), "columns: a field has 2 columns or more");
  EXPECT_EQ(fault_of({10, 0, 6, 1, 5}), "rows: a field has 2 rows or more");
  EXPECT_EQ(fault_of({10, 0, 0, 0, 5}, 0), "columns: a field has 2 columns or more");
  EXPECT_EQ(fault_of({10, 0, 3, 2, 0}), "pitch: the pitch is 0 steps");
  const char* const kTooFar = "pitch: the last column or row has a coordinate of more than 23 bits";
  EXPECT_EQ(fault_of({10, 0, 3, 2, 1u << 22}), kTooFar);
  EXPECT_EQ(fault_of({10, 0, 2, 3, 1u << 22}), kTooFar);
  EXPECT_EQ(fault_of({10, 0, 3, 2, (1u << 22) - 1}), "");
  EXPECT_EQ(fault_of({10, 0, 0xffffffffu, 2, 0xffffffffu}), kTooFar);
  EXPECT_EQ(fault_of({10, 0, 4098, 4097, 1}), "cells: 16781312 cells, at most 16777216 are possible");
  EXPECT_EQ(fault_of({10, 0, 3, 2, 5}, 5), "heights: 5 heights for 6 places");
  EXPECT_EQ(fault_of({10, 0, 3, 2, 5}, 6, {1}), "materials: 1 materials for 2 cells");
  EXPECT_EQ(fault_of({10, 0, 3, 2, 5}, 6, {255, 255}), "materials: every cell is a hole or a ghost");
  EXPECT_EQ(fault_of({10, 0, 3, 2, 5}, 6, {255, 253}), "");
}

TEST(HeightField, heights_reach_as_far_as_they_may) {
  const BakedHeightField field = height_field({0, 7, 2, 2, 1}, Heights{-32768, 32767, 0, 0}, {}).value();
  const BakedTriangle triangle = field.triangle(0);
  EXPECT_EQ(triangle.points[0], (MeshPoint{0, -32768 * 128, 0}));
  EXPECT_EQ(triangle.points[2], (MeshPoint{1, 32767 * 128, 0}));
  for (const MeshPoint p : triangle.points) EXPECT_TRUE(p.in_range());
}

TEST(HeightField, bytes_give_the_field_again) {
  Random random(7);
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    const std::uint32_t columns = 2 + random() % 20, rows = 2 + random() % 20;
    const HeightGrid grid = {trial % 17, trial % 8, columns, rows, 1 + random() % 1000};
    const Materials materials = random_materials(random, (columns - 1) * (rows - 1));
    const BakedHeightField field = height_field(grid, random_heights(random, columns * rows, 32768), materials).value();
    const std::vector<std::uint8_t> bytes = field.bytes();
    EXPECT_EQ(bytes.size(), 20 + 2 * columns * rows + (columns - 1) * (rows - 1));
    const Result<BakedHeightField> again = read_height_field(bytes);
    ASSERT_TRUE(again.ok()) << fault_text(again);
    EXPECT_TRUE(again.value().grid() == grid);
    EXPECT_EQ(again.value().bytes(), bytes);
    for (std::uint32_t id = 0; id < field.triangle_count(); ++id) {
      ASSERT_EQ(again.value().has_triangle(id), field.has_triangle(id));
      if (!field.has_triangle(id)) continue;
      ASSERT_TRUE(again.value().triangle(id) == field.triangle(id));
    }
  }
}

TEST(HeightField, bytes_are_as_written_down) {
  const std::vector<std::uint8_t> expected = {9, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0,    2,    0, 0,
                                              0, 0, 2, 0, 0, 1, 0, 2, 0, 3, 0, 0xfe, 0xff, 77};
  EXPECT_EQ(height_field({9, 1, 2, 2, 512}, Heights{1, 2, 3, -2}, Materials{77}).value().bytes(), expected);
}

TEST(HeightField, other_bytes_are_refused_or_are_a_field_with_those_bytes) {
  Random random(8);
  const auto materials = random_materials(random, 12);
  const std::vector<std::uint8_t> whole =
      height_field({10, 0, 5, 4, 512}, random_heights(random, 20, 900), materials).value().bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(read_height_field({whole.data(), size}).ok()) << size;
  }
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes = whole;
    for (int n = 0; n <= trial % 3; ++n) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (trial % 7 == 0) bytes.push_back(0);
    const Result<BakedHeightField> field = read_height_field(bytes);
    ++(field.ok() ? accepted : refused);
    if (!field) continue;
    ASSERT_EQ(field.value().bytes(), bytes);
    if (trial % 50 == 0) expect_queries_find_all(field.value(), static_cast<std::uint32_t>(trial), 50);
  }
  EXPECT_GT(refused, 5000);
  EXPECT_GT(accepted, 5000);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes(20 + random() % 20);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i % 4 == 0 ? random() % 4 : 0);
    const Result<BakedHeightField> field = read_height_field(bytes);
    if (!field) continue;
    ASSERT_EQ(field.value().bytes(), bytes);
  }
}

TEST(HeightField, a_triangle_takes_at_most_two_bytes_and_a_half) {
  const Surface surface = terrain();
  const BakedHeightField field = height_field(surface.grid, surface.heights, {}).value();
  const double each = static_cast<double>(field.memory()) / field.triangle_count();
  std::printf("height field: %.2f bytes a triangle\n", each);
  EXPECT_LE(each, 2.5);
  print_build_time("height field", field.triangle_count(),
                   [&] { EXPECT_TRUE(height_field(surface.grid, surface.heights, {}).ok()); });
}

}  // namespace height_field_test
}  // namespace isostep::test
