// Triangles as they come, for the tests of meshes, and what all pairs of them say of neighbours.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "unit/geometry/baked_surface.hpp"

namespace isostep::test {

inline constexpr std::int32_t kFar = MeshPoint::kLimit - 1;

using Points = std::vector<MeshPoint>;
using Triangles = std::vector<MeshTriangle>;
using Materials = std::vector<std::uint8_t>;
using Place = std::array<std::int32_t, 3>;

inline Place place_of(MeshPoint p) { return {p.x, p.y, p.z}; }

struct Soup {
  Points points;
  Triangles triangles;
  Materials materials;

  Result<TriangleMesh> mesh(int exponent = 10) const { return triangle_mesh(points, triangles, materials, exponent); }
};

/// Triangles between points of a small grid, as long as no edge would have two in one direction: borders, sheets,
/// folds and ridges as they come. Each triangle has points of its own, so that only their places tell of neighbours.
inline Soup random_soup(Random& random, std::uint32_t width, int tries) {
  Soup soup;
  std::set<std::pair<Place, Place>> taken;
  const auto draw = [&] { return 3 * static_cast<std::int32_t>(random() % width) - 4; };
  for (int n = 0; n < tries; ++n) {
    MeshPoint p[3];
    for (MeshPoint& point : p) {
      point.x = draw();
      point.y = draw();
      point.z = draw();
    }
    bool fits = !(cross(p[1] - p[0], p[2] - p[0]) == GridVector{0, 0, 0});
    for (int k = 0; k < 3; ++k) fits = fits && !taken.count({place_of(p[k]), place_of(p[(k + 1) % 3])});
    if (!fits) continue;
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int k = 0; k < 3; ++k) {
      taken.insert({place_of(p[k]), place_of(p[(k + 1) % 3])});
      soup.points.push_back(p[k]);
    }
    soup.triangles.push_back({{first, first + 1, first + 2}});
    soup.materials.push_back(static_cast<std::uint8_t>(random()));
  }
  return soup;
}

/// Six times the volume of a tetrahedron, by its determinant; for small coordinates.
inline std::int64_t volume(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d) {
  const GridVector u = b - a, v = c - a, w = d - a;
  return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) + u.z * (v.x * w.y - v.y * w.x);
}

/// Checks all edges against all edges, and counts their kinds.
inline void expect_neighbours_of_all_pairs(const TriangleMesh& mesh, std::map<EdgeKind, int>& kinds) {
  std::vector<BakedTriangle> all;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) all.push_back(mesh.triangle(t));
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const MeshPoint a = all[t].points[k], b = all[t].points[(k + 1) % 3], c = all[t].points[(k + 2) % 3];
      std::uint32_t neighbour = kNoTriangle;
      EdgeKind kind = EdgeKind::border;
      for (std::uint32_t u = 0; u < all.size(); ++u) {
        for (int j = 0; j < 3; ++j) {
          if (!(all[u].points[j] == b) || !(all[u].points[(j + 1) % 3] == a)) continue;
          ASSERT_EQ(neighbour, kNoTriangle);
          neighbour = u;
          const MeshPoint d = all[u].points[(j + 2) % 3];
          const std::int64_t above = volume(a, b, c, d);
          const bool turned = dot(all[t].normal(), all[u].normal()) < 0;
          kind = above < 0   ? EdgeKind::convex
                 : above > 0 ? EdgeKind::concave
                 : turned    ? EdgeKind::fold
                             : EdgeKind::flat;
          ASSERT_EQ(all[t].opposite[k], d);
          ASSERT_EQ(all[t].neighbour_normal(k), all[u].normal());
          ASSERT_EQ(mesh.edge(t, k).edge(), static_cast<std::uint32_t>(j));
        }
      }
      ASSERT_EQ(mesh.neighbour(t, k), neighbour);
      ASSERT_EQ(all[t].edges[k], kind);
      ASSERT_EQ(all[t].has_neighbour(k), neighbour != kNoTriangle);
      ++kinds[kind];
    }
  }
}

inline const Points kSquare = {{0, 0, 0}, {0, 0, 8}, {8, 0, 0}, {8, 0, 8}, {4, 5, 4}, {4, 9, 4}};

}  // namespace isostep::test
