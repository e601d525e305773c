// Triangle meshes against all pairs of triangles, and what is refused.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include "unit/geometry/triangle_soup.hpp"

namespace isostep::test {
namespace triangle_mesh_test {

static_assert(TriangleGeometry<TriangleMesh>);

TEST(TriangleMesh, neighbours_are_what_all_pairs_of_edges_say) {
  Random random(1);
  std::map<EdgeKind, int> kinds;
  for (int trial = 0; trial < 300; ++trial) {
    const Soup soup = random_soup(random, 2 + static_cast<std::uint32_t>(trial % 3), 2 + trial);
    const Result<TriangleMesh> mesh = soup.mesh();
    if (soup.triangles.empty()) continue;
    ASSERT_TRUE(mesh.ok()) << fault_text(mesh);
    ASSERT_NO_FATAL_FAILURE(expect_neighbours_of_all_pairs(mesh.value(), kinds));
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      const BakedTriangle triangle = mesh.value().triangle(t);
      EXPECT_EQ(triangle.material, soup.materials[t]);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(triangle.points[k], soup.points[soup.triangles[t].vertices[k]]);
    }
  }
  for (const EdgeKind kind : {EdgeKind::border, EdgeKind::flat, EdgeKind::convex, EdgeKind::concave, EdgeKind::fold}) {
    EXPECT_GT(kinds[kind], 200) << static_cast<int>(kind);
  }
}

/// Six times the volume is up to 2^72 here, and the least of it that is not 0 is told from 0.
TEST(TriangleMesh, edges_are_told_apart_across_the_whole_grid) {
  constexpr std::int32_t kEnd = kFar - 1;
  const auto kind_with = [](std::int32_t rise) {  // of the fourth point, above the plane x + y + z = 0 of the others
    const Points points = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {0, rise - kEnd, kEnd}};
    const TriangleMesh mesh = triangle_mesh(points, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
    EXPECT_EQ(mesh.triangle(1).edges[0], mesh.triangle(0).edges[0]) << "seen from both sides";
    return mesh.triangle(0).edges[0];
  };
  EXPECT_EQ(kind_with(-1), EdgeKind::convex);
  EXPECT_EQ(kind_with(0), EdgeKind::flat);
  for (std::int32_t rise = 1; rise <= kEnd; rise *= 2) EXPECT_EQ(kind_with(rise), EdgeKind::concave) << rise;
  EXPECT_EQ(kind_with(2 * kEnd), EdgeKind::concave);

  const Points folded = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {-kEnd, kEnd - 1, 1}};
  const TriangleMesh mesh = triangle_mesh(folded, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
  EXPECT_EQ(mesh.triangle(0).edges[0], EdgeKind::flat);
  const Points back = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {-kEnd, kEnd + 1, -1}};
  const TriangleMesh sheet = triangle_mesh(back, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
  EXPECT_EQ(sheet.triangle(0).edges[0], EdgeKind::fold);
}

TEST(TriangleMesh, permuted_triangles_change_ids_only) {
  Random random(10);
  const Surface surface = terrain();
  Materials materials;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) materials.push_back(static_cast<std::uint8_t>(t % 251));
  const TriangleMesh mesh = triangle_mesh(surface.points, surface.triangles, materials, 10).value();
  std::vector<std::uint32_t> old_id(surface.triangles.size());
  for (std::uint32_t t = 0; t < old_id.size(); ++t) old_id[t] = t;
  std::shuffle(old_id.begin(), old_id.end(), random);
  Triangles triangles;
  Materials permuted;
  for (const std::uint32_t t : old_id) {
    triangles.push_back(surface.triangles[t]);
    permuted.push_back(materials[t]);
  }
  const TriangleMesh other = triangle_mesh(surface.points, triangles, permuted, 10).value();
  for (std::uint32_t t = 0; t < old_id.size(); ++t) {
    ASSERT_TRUE(other.triangle(t) == mesh.triangle(old_id[t]));
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t across = other.neighbour(t, k);
      ASSERT_EQ(across == kNoTriangle ? across : old_id[across], mesh.neighbour(old_id[t], k));
    }
  }
  BoxDraws draws(11, mesh.bounds());
  for (int n = 0; n < 100; ++n) {
    const MeshBox box = draws.box();
    std::vector<std::uint32_t> ids = queried(mesh, box), others;
    for (const std::uint32_t t : queried(other, box)) others.push_back(old_id[t]);
    std::sort(ids.begin(), ids.end());
    std::sort(others.begin(), others.end());
    ASSERT_EQ(ids, others);
  }
}

TEST(TriangleMesh, equal_points_unused_points_and_their_order_change_nothing) {
  Random random(12);
  const Soup soup = random_soup(random, 4, 300);  // with points of its own for each triangle
  const TriangleMesh mesh = soup.mesh().value();
  EXPECT_LT(mesh.points().size(), 65u) << "a grid of 4 x 4 x 4";

  Points shared(mesh.points().begin(), mesh.points().end());
  for (std::int32_t i = 0; i < 50; ++i) shared.push_back({1000 + i, 7, 7});
  std::shuffle(shared.begin(), shared.end(), random);
  Triangles triangles;
  for (const MeshTriangle& triangle : soup.triangles) {
    MeshTriangle other = {};
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(shared.begin(), shared.end(), soup.points[triangle.vertices[k]]);
      other.vertices[k] = static_cast<std::uint32_t>(at - shared.begin());
    }
    triangles.push_back(other);
  }
  EXPECT_EQ(triangle_mesh(shared, triangles, soup.materials, 10).value().bytes(), mesh.bytes());
}

std::string fault_of(const Triangles& triangles, const Points& points = kSquare) {
  return fault_text(triangle_mesh(points, triangles, {}, 10));
}

TEST(TriangleMesh, names_what_it_refuses) {
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 1}}}), "");
  EXPECT_EQ(fault_of({}), "triangles: there are no triangles");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 6}}}), "triangles[1]: vertex 6 of 6 points");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 2}}}), "triangles[1]: the triangle has no area: its points lie on a line");
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {kFar, 1, -kFar}, {-kFar, -1, kFar}}),
            "triangles[0]: the triangle has no area: its points lie on a line");
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {kFar, 1, -kFar}, {-kFar, -1, kFar - 1}}), "");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{1, 2, 3}}}),
            "triangles[1]: the triangle runs along an edge in the same direction as triangle 0");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 1}}, {{1, 4, 2}}}),
            "triangles[2]: the triangle is the third at an edge of triangle 0: 3 are there, at most 2 are possible");
  EXPECT_EQ(fault_of({{{3, 2, 1}}, {{0, 1, 2}}, {{1, 2, 0}}}),
            "triangles[2]: the triangle is there already, as triangle 1");
  EXPECT_EQ(fault_of({{{3, 2, 1}}, {{0, 1, 4}}, {{1, 3, 2}}}),
            "triangles[2]: the triangle is there already, as triangle 0");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{0, 2, 1}}}), "") << "a sheet with two sides";
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{0, 2, 1}}, {{1, 4, 2}}}),
            "triangles[2]: the triangle is the third at an edge of triangle 0: 3 are there, at most 2 are possible");
  for (const std::int32_t out : {MeshPoint::kLimit, -MeshPoint::kLimit, INT32_MIN, INT32_MAX}) {
    for (const MeshPoint p : {MeshPoint{out, 0, 0}, MeshPoint{0, out, 0}, MeshPoint{0, 0, out}}) {
      EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, p}),
                "points[3]: a coordinate has more than 23 bits and a sign");
    }
  }
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{kFar, -kFar, 0}, {0, kFar, -kFar}, {-kFar, 0, kFar}}), "");
}

TEST(TriangleMesh, names_exponents_materials_and_counts_that_it_refuses) {
  const Triangles one = {{{0, 1, 2}}};
  for (const int exponent : {-1, 17, INT32_MIN, INT32_MAX}) {
    EXPECT_EQ(fault_text(triangle_mesh(kSquare, one, {}, exponent)), "exponent: the exponent of a step is 0 to 16");
  }
  EXPECT_EQ(triangle_mesh(kSquare, one, {}, 16).value().exponent(), 16);
  EXPECT_EQ(fault_text(triangle_mesh(kSquare, one, Materials{1, 2}, 0)), "materials: 2 materials for 1 triangles");
  EXPECT_EQ(triangle_mesh(kSquare, one, Materials{255}, 0).value().triangle(0).material, 255);
  EXPECT_EQ(triangle_mesh(kSquare, one, {}, 0).value().triangle(0).material, 0);

  const Triangles many(TriangleMesh::kMaxTriangles + 1, one[0]);
  EXPECT_EQ(fault_of(many), "triangles: 4194305 triangles, at most 4194304 are possible");
  const Points crowd(TriangleMesh::kMaxPoints + 1, MeshPoint{});
  EXPECT_EQ(fault_of(one, crowd), "points: 12582913 points, at most 12582912 are possible");
}

}  // namespace triangle_mesh_test
}  // namespace isostep::test
