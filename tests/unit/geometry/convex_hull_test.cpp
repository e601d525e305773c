// Convex hulls against every plane through three points, on grids so small that most points lie in planes and lines
// with others; and what hull builders are known to fail at.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "sample.hpp"
#include "unit/geometry/hull_recipes.hpp"

namespace isostep::test {
namespace convex_hull_test {

constexpr std::int32_t kFar = GridPoint::kLimit - 1;

using Face = std::vector<GridPoint>;  // ascending
bool before(GridPoint a, GridPoint b) { return a.key() < b.key(); }
struct Before {
  bool operator()(const Face& a, const Face& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
  }
};
using Faces = std::set<Face, Before>;

/// Corners of the polygon that the points of one plane span: those that no two others have between them, nor any three
/// around them.
Face corners_of(Face points, GridVector normal) {
  Face corners;
  for (const GridPoint p : points) {
    // A corner has a line through it with all others on one side, and none on its far half.
    bool corner = false;
    for (const GridPoint q : points) {
      if (q == p) continue;
      const GridVector side = cross(normal, q - p);
      bool left = true, right = true;
      for (const GridPoint r : points) {
        const std::int64_t across = dot(side, r - p), along = dot(q - p, r - p);
        const bool behind = across == 0 && along < 0;
        left = left && across >= 0 && !behind;
        right = right && across <= 0 && !behind;
      }
      corner = corner || left || right;
    }
    if (corner) corners.push_back(p);
  }
  std::sort(corners.begin(), corners.end(), before);
  return corners;
}

/// Every plane through three points that has all others on one side.
Faces brute_force(std::vector<GridPoint> points) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Faces faces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const GridVector normal = cross(points[j] - points[i], points[k] - points[i]);
        if (normal == GridVector{0, 0, 0}) continue;
        bool above = false, below = false;
        Face plane;
        for (const GridPoint p : points) {
          const std::int64_t height = dot(normal, p - points[i]);
          above = above || height > 0;
          below = below || height < 0;
          if (height == 0) plane.push_back(p);
        }
        if (above != below) faces.insert(corners_of(plane, normal));
      }
    }
  }
  return faces;
}

Faces faces_of(const ConvexHull& hull) {
  Faces faces;
  for (const std::uint8_t first : hull.faces) {
    Face face;
    std::uint8_t edge = first;
    do {
      face.push_back(hull.vertices[hull.half_edges[edge].origin]);
      edge = hull.half_edges[edge].next;
    } while (edge != first);
    std::sort(face.begin(), face.end(), before);
    faces.insert(face);
  }
  return faces;
}

void expect_sound(const ConvexHull& hull) {
  EXPECT_EQ(hull.vertices.size() + hull.faces.size(), hull.half_edges.size() / 2 + 2) << "Euler";
  EXPECT_TRUE(std::is_sorted(hull.vertices.begin(), hull.vertices.end(), before));
  std::size_t around = 0;
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const auto face = static_cast<std::uint8_t>(f);
    const GridPoint at = hull.vertices[hull.half_edges[hull.faces[f]].origin];
    std::uint8_t edge = hull.faces[f];
    do {
      EXPECT_EQ(hull.half_edges[edge].face, face);
      EXPECT_EQ(hull.destination(edge), hull.half_edges[hull.half_edges[edge].next].origin);
      EXPECT_LE(hull.half_edges[hull.faces[f]].origin, hull.half_edges[edge].origin) << "a face starts at its lowest";
      edge = hull.half_edges[edge].next;
      ++around;
    } while (edge != hull.faces[f]);
    for (const GridPoint vertex : hull.vertices) EXPECT_LE(dot(hull.normal(face), vertex - at), 0) << "outward";
  }
  EXPECT_EQ(around, hull.half_edges.size()) << "each half-edge belongs to one face";
  for (std::size_t e = 0; e < hull.half_edges.size(); e += 2) {
    EXPECT_LT(hull.half_edges[e].origin, hull.half_edges[e + 1].origin);
  }
}

bool same(const ConvexHull& a, const ConvexHull& b) {
  return a.vertices == b.vertices && a.half_edges == b.half_edges && a.faces == b.faces;
}

std::string_view fault_of(const std::vector<GridPoint>& points) {
  static Result<ConvexHull> hull = Error{};
  hull = convex_hull(points);
  return hull.ok() ? "" : hull.error().message.view();
}

/// Points of a grid of `width` coarse steps, too coarse for anything flat. Of a few steps, most points lie in a line or
/// a plane with others.
std::vector<GridPoint> scattered(std::mt19937& random, int count, std::uint32_t width) {
  std::vector<GridPoint> points;
  const auto draw = [&] { return static_cast<std::int32_t>(random() % width) * 256 - 384; };
  for (int i = 0; i < count; ++i) {
    const std::int32_t x = draw(), y = draw(), z = draw();
    points.push_back({x, y, z});
  }
  return points;
}

TEST(ConvexHull, is_what_all_planes_through_three_points_say) {
  std::mt19937 random(1);
  int hulls = 0, merged = 0, inside = 0;
  const int trials = sampled(3000, 750);
  for (int trial = 0; trial < trials; ++trial) {
    const std::vector<GridPoint> points = scattered(random, 4 + trial % 24, 2 + static_cast<std::uint32_t>(trial % 7));
    const Faces expected = brute_force(points);
    const Result<ConvexHull> hull = convex_hull(points);
    ASSERT_EQ(hull.ok(), !expected.empty()) << trial;
    if (!hull.ok()) continue;
    ++hulls;
    expect_sound(hull.value());
    ASSERT_EQ(faces_of(hull.value()), expected) << trial;
    inside += hull.value().vertices.size() < points.size() ? 1 : 0;
    for (const Face& face : expected) merged += face.size() > 3 ? 1 : 0;
  }
  EXPECT_GT(hulls, trials * 5 / 6);
  EXPECT_GT(merged, trials * 2 / 3);
  EXPECT_GT(inside, trials / 3);
}

TEST(ConvexHull, depends_on_the_set_of_points_alone) {
  std::mt19937 random(2);
  scenes::Draws draws(7);
  for (int n = 0; n < 200; ++n) {
    const std::vector<GridPoint> drawn = drawn_points(n, draws);
    const Result<ConvexHull> hull = convex_hull(drawn);
    ASSERT_TRUE(hull.ok());
    for (int repeat = 0; repeat < 5; ++repeat) {
      std::vector<GridPoint> points = drawn;
      for (int i = 0; i < 3; ++i) points.push_back(points[random() % points.size()]);
      const GridPoint a = points[random() % points.size()], b = points[random() % points.size()];
      points.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});  // inside, for all have even coordinates
      std::shuffle(points.begin(), points.end(), random);
      const Result<ConvexHull> again = convex_hull(points);
      ASSERT_TRUE(again.ok() && same(hull.value(), again.value())) << n;
    }
  }
}

struct Counts {
  std::size_t vertices = 0, edges = 0, faces = 0;
  void add(const ConvexHull& hull) {
    vertices += hull.vertices.size();
    edges += hull.half_edges.size() / 2;
    faces += hull.faces.size();
  }
};

/// Against a brute-force hull of integers. Engines that compare floats with a tolerance lose a few faces.
TEST(ConvexHull, counts_of_two_scenes_are_exact) {
  scenes::Draws draws(2025), others(3131);
  Counts pit, terrain;
  for (int n = 0; n < 1000; ++n) pit.add(convex_hull(drawn_points(n, draws)).value());
  EXPECT_EQ(pit.vertices, 14007u);
  EXPECT_EQ(pit.edges, 28314u);
  EXPECT_EQ(pit.faces, 16307u);
  for (int n = 0; n < 200; ++n) {
    if (n % 3 == 0) terrain.add(convex_hull(drawn_points(n / 3, others)).value());
    else
      for (int i = 0; i < 4; ++i) others.unit();
  }
  EXPECT_EQ(terrain.vertices, 960u);
  EXPECT_EQ(terrain.edges, 1952u);
  EXPECT_EQ(terrain.faces, 1126u);
}

TEST(ConvexHull, reaches_the_corners_of_the_grid) {
  std::vector<GridPoint> cube;
  for (const std::int32_t x : {-kFar, kFar}) {
    for (const std::int32_t y : {-kFar, kFar}) {
      for (const std::int32_t z : {-kFar, kFar}) cube.push_back({x, y, z});
    }
  }
  std::mt19937 random(3);
  const auto draw = [&] { return static_cast<std::int32_t>(random() % (2u * kFar + 1)) - kFar; };
  for (int i = 0; i < 1000; ++i) {
    const std::int32_t x = draw(), y = draw(), z = draw();
    cube.push_back({x, y, z});
  }
  const Result<ConvexHull> hull = convex_hull(cube);
  ASSERT_TRUE(hull.ok());
  expect_sound(hull.value());
  EXPECT_EQ(hull.value().vertices.size(), 8u);
  EXPECT_EQ(hull.value().faces.size(), 6u);
}

TEST(ConvexHull, names_what_it_refuses) {
  EXPECT_EQ(fault_of({}), "the points span no volume");
  EXPECT_EQ(fault_of(std::vector<GridPoint>(50, {3, 4, 5})), "the points span no volume");
  std::vector<GridPoint> line, sheet;
  for (int i = 0; i < 40; ++i) {
    line.push_back({7 * i, -3 * i, 11 * i});
    sheet.push_back({10 * (i % 7), 10 * (i / 7), 3 * (i % 7) - 4 * (i / 7)});
  }
  EXPECT_EQ(fault_of(line), "the points span no volume");
  EXPECT_EQ(fault_of(sheet), "the points span no volume");
  sheet.push_back({10, 10, 2});  // three steps above the plane, which is not level
  constexpr const char* kFlat = "the points are flat: thinner than 4 steps of the grid or 1/1024 of their width";
  EXPECT_EQ(fault_of(sheet), kFlat);
  EXPECT_EQ(fault_of({{0, 0, 0}, {9000, 0, 0}, {0, 9000, 0}, {3000, 3000, 9}}), "");
  EXPECT_EQ(fault_of({{0, 0, 0}, {9000, 0, 0}, {0, 9000, 0}, {3000, 3000, 7}}), kFlat);
  EXPECT_EQ(fault_of({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, GridPoint::kLimit}}),
            "a coordinate has more than 19 bits");
  EXPECT_EQ(fault_of({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, -GridPoint::kLimit}}),
            "a coordinate has more than 19 bits");
}

/// No four in a plane: as many edges as three times the vertices, less six.
std::vector<GridPoint> round_points(int count) {
  std::vector<GridPoint> points;
  std::mt19937 random(4);
  std::normal_distribution<double> draw;
  while (static_cast<int>(points.size()) < count) {
    const double x = draw(random), y = draw(random), z = draw(random), length = std::sqrt(x * x + y * y + z * z);
    const auto steps = [&](double v) { return static_cast<std::int32_t>(std::lround(500000 * v / length)); };
    points.push_back({steps(x), steps(y), steps(z)});
  }
  return points;
}

TEST(ConvexHull, more_than_its_limits_is_refused_with_the_count) {
  EXPECT_EQ(fault_of(round_points(44)), "");  // 126 edges
  EXPECT_EQ(fault_of(round_points(45)), "the hull has 129 edges, at most 128 are possible");
  EXPECT_EQ(fault_of(round_points(100)), "the hull has 196 faces, at most 128 are possible");
  EXPECT_EQ(fault_of(round_points(129)), "the hull has 129 vertices, at most 128 are possible");
}

TEST(ConvexHull, simplified_keeps_the_furthest_points) {
  const std::vector<GridPoint> many = round_points(1000000);
  const Result<std::vector<GridPoint>> few = simplified(many, 40);
  ASSERT_TRUE(few.ok());
  EXPECT_EQ(few.value().size(), 40u);
  const Result<ConvexHull> hull = convex_hull(few.value());
  ASSERT_TRUE(hull.ok());
  EXPECT_EQ(hull.value().vertices.size(), 40u);
  expect_sound(hull.value());
  double least = 1e9;  // of the distances of faces from the middle
  for (std::uint32_t f = 0; f < hull.value().faces.size(); ++f) {
    const GridVector n = hull.value().normal(static_cast<std::uint8_t>(f));
    const GridPoint at = hull.value().vertices[hull.value().half_edges[hull.value().faces[f]].origin];
    const double length = std::sqrt(static_cast<double>(n.x) * static_cast<double>(n.x) +
                                    static_cast<double>(n.y) * static_cast<double>(n.y) +
                                    static_cast<double>(n.z) * static_cast<double>(n.z));
    least = std::min(least, static_cast<double>(dot(n, at - GridPoint{0, 0, 0})) / length);
  }
  EXPECT_GT(least, 0.75 * 500000) << "40 points of a sphere, none far from its neighbours";
  std::vector<GridPoint> shuffled = many;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
  EXPECT_EQ(simplified(shuffled, 40).value(), few.value());

  scenes::Draws draws(9);
  for (int n = 0; n < 40; ++n) {
    const std::vector<GridPoint> points = drawn_points(n, draws);
    const std::vector<GridPoint> all = simplified(points, 1000).value();
    EXPECT_TRUE(same(convex_hull(all).value(), convex_hull(points).value())) << "nothing was left out";
  }
  EXPECT_FALSE(simplified(many, 3).ok());
  EXPECT_FALSE(simplified(std::vector<GridPoint>(9, {1, 2, 3}), 8).ok());
}

}  // namespace convex_hull_test
}  // namespace isostep::test
