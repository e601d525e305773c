// Polygons into triangles: they turn as the polygon does, and their areas are the polygon's.
// SPDX-License-Identifier: MIT
#include "tool/bake/triangulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace isostep::tool::bake {
namespace triangulate_test {

using V = Vec3<double>;

/// Twice the area vector.
V area_of(const V& a, const V& b, const V& c) { return cross(b - a, c - a); }

/// Triangles that all turn as the polygon, and whose areas sum up to its own, cover it without overlap.
void expect_covered(const std::vector<V>& polygon) {
  const auto triangles = triangulated(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  V whole = {0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) whole += area_of(polygon[0], polygon[i], polygon[i + 1]);
  double sum = 0;
  for (const auto& t : triangles) {
    const V area = area_of(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    EXPECT_GE(dot(area, whole), 0);
    sum += std::sqrt(dot(area, area));
  }
  EXPECT_NEAR(sum, std::sqrt(dot(whole, whole)), 1e-9 * sum);
}

TEST(Triangulated, CutsConvexPolygonsAndThoseWithDents) {
  expect_covered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  expect_covered({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  expect_covered({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  expect_covered({{0, 0, 5}, {0, 2, 5}, {1, 2, 5}, {1, 1, 5}, {2, 1, 5}, {2, 0, 5}});
  expect_covered({{2, 2, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}});
  expect_covered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

/// A star seen from its middle, in a plane that is not an axis's.
TEST(Triangulated, CutsStars) {
  std::mt19937 random(11);
  for (int n = 0; n < 200; ++n) {
    const int corners = 4 + n % 20;
    std::vector<V> star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, r = 0.2 + 1e-3 * (random() % 1000);
      const double x = r * std::cos(angle), y = r * std::sin(angle);
      star.push_back(V{1, 2, 2} * (x / 3) + V{2, 1, -2} * (y / 3) + V{5, 6, 7});
    }
    expect_covered(star);
  }
}

TEST(Triangulated, EndsOnWhatIsNoPolygon) {
  EXPECT_EQ(triangulated(std::vector<V>(7, V{1, 2, 3})).size(), 5u);
  EXPECT_EQ(triangulated(std::vector<V>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(triangulated(std::vector<V>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size(), 2u);
}

}  // namespace triangulate_test
}  // namespace isostep::tool::bake
