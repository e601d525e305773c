// Volume, centre and second moments of hulls against closed forms and against sums in double.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/geometry/hull_recipes.hpp"

namespace isostep::test {
namespace hull_mass_test {

constexpr double kDigit = 1.0 / (1 << HullMass::kFractionBits);

std::vector<GridPoint> block(GridPoint low, GridPoint high) {
  std::vector<GridPoint> corners;
  for (const std::int32_t x : {low.x, high.x}) {
    for (const std::int32_t y : {low.y, high.y}) {
      for (const std::int32_t z : {low.z, high.z}) corners.push_back({x, y, z});
    }
  }
  return corners;
}
HullMass mass_of(const std::vector<GridPoint>& points) { return hull_mass(convex_hull(points).value()); }

TEST(HullMass, of_blocks_is_the_closed_form) {
  constexpr std::int32_t kFar = GridPoint::kLimit - 1;
  const GridPoint blocks[][2] = {{{0, 0, 0}, {4, 4, 4}},
                                 {{-7, 3, 11}, {12, 8, 400}},
                                 {{kFar - 2000, -kFar, -1100}, {kFar, kFar, 1000}},
                                 {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}};
  for (const auto& [low, high] : blocks) {
    const HullMass mass = mass_of(block(low, high));
    const std::int64_t size[3] = {high.x - low.x, high.y - low.y, high.z - low.z};
    const std::int64_t sum[3] = {high.x + low.x, high.y + low.y, high.z + low.z};
    EXPECT_EQ(mass.volume6, 6 * size[0] * size[1] * size[2]);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(static_cast<double>(mass.centre[i]) * kDigit, static_cast<double>(sum[i]) / 2, 2 * kDigit);
      const double variance = static_cast<double>(size[i]) * static_cast<double>(size[i]) / 12;
      EXPECT_NEAR(static_cast<double>(mass.variance[i]) * kDigit, variance, 2 * kDigit + 1e-15 * variance);
      EXPECT_NEAR(static_cast<double>(mass.product[i]) * kDigit, 0, 2 * kDigit);
    }
  }
}

/// Of the corner (0, 0, 0), (a, 0, 0), (0, b, 0), (0, 0, c): centre a / 4, variance 3 a^2 / 80, product -b c / 80.
TEST(HullMass, of_a_tetrahedron_is_the_closed_form) {
  const double edge[3] = {4000, 700, 52000};
  const HullMass mass = mass_of({{0, 0, 0}, {4000, 0, 0}, {0, 700, 0}, {0, 0, 52000}});
  EXPECT_EQ(mass.volume6, 4000ll * 700 * 52000);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(mass.centre[i]) * kDigit, edge[i] / 4, 2 * kDigit);
    EXPECT_NEAR(static_cast<double>(mass.variance[i]) * kDigit, 3 * edge[i] * edge[i] / 80, 2 * kDigit);
    const double product = -edge[(i + 1) % 3] * edge[(i + 2) % 3] / 80;
    EXPECT_NEAR(static_cast<double>(mass.product[i]) * kDigit, product, 2 * kDigit);
  }
}

/// Slices at many heights: the area and moments of a cut are polynomials between vertices, which Gauss's rule sums
/// exactly; the oracle shares no formula with tetrahedra.
struct Sums {
  double volume = 0, first[3] = {}, second[6] = {};
};
constexpr int kRows[6] = {0, 1, 2, 1, 2, 0}, kColumns[6] = {0, 1, 2, 2, 0, 1};

/// The polygon of points at height y of the convex solid, as the hull of where its edges pass.
std::vector<std::array<double, 2>> cut(const ConvexHull& hull, double y) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t e = 0; e < hull.half_edges.size(); e += 2) {
    const GridPoint a = hull.vertices[hull.half_edges[e].origin], b = hull.vertices[hull.half_edges[e + 1].origin];
    if ((a.y < y) == (b.y < y)) continue;
    const double t = (y - a.y) / (b.y - a.y);
    points.push_back({a.x + t * (b.x - a.x), a.z + t * (b.z - a.z)});
  }
  double x = 0, z = 0;
  for (const auto& p : points)
    x += p[0] / static_cast<double>(points.size()), z += p[1] / static_cast<double>(points.size());
  std::sort(points.begin(), points.end(), [&](const auto& p, const auto& q) {
    return std::atan2(p[1] - z, p[0] - x) < std::atan2(q[1] - z, q[0] - x);
  });
  return points;
}
/// The integrals of 1, x, z, x x, z z, x z over a triangle, by its three mid-points: exact to degree two.
void add_cut(Sums& sums, const std::vector<std::array<double, 2>>& p, double y, double weight) {
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double area =
        ((p[i - 1][0] - p[0][0]) * (p[i][1] - p[0][1]) - (p[i - 1][1] - p[0][1]) * (p[i][0] - p[0][0])) / 2;
    const std::array<double, 2>* corners[3] = {&p[0], &p[i - 1], &p[i]};
    for (int k = 0; k < 3; ++k) {
      const auto &a = *corners[k], &b = *corners[(k + 1) % 3];
      const double at[3] = {(a[0] + b[0]) / 2, y, (a[1] + b[1]) / 2}, w = weight * area / 3;
      sums.volume += w;
      for (int n = 0; n < 3; ++n) sums.first[n] += w * at[n];
      for (int n = 0; n < 6; ++n) sums.second[n] += w * at[kRows[n]] * at[kColumns[n]];
    }
  }
}
Sums by_slices(const ConvexHull& hull) {
  const double nodes[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  std::vector<std::int32_t> heights;
  for (const GridPoint p : hull.vertices) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  Sums sums;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double middle = (heights[i] + heights[i - 1]) / 2.0, half = (heights[i] - heights[i - 1]) / 2.0;
    if (half == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const double y = middle + half * nodes[k];
      add_cut(sums, cut(hull, y), y, half * weights[k]);
    }
  }
  return sums;
}

TEST(HullMass, of_rocks_prisms_frusta_and_pyramids_is_what_slices_add_up_to) {
  scenes::Draws draws(11);
  for (int n = 0; n < 400; ++n) {
    std::vector<GridPoint> points = drawn_points(n, draws);
    for (GridPoint& p : points)
      p = {p.x + 400000, p.y - 70000, p.z + 3};  // where a hull has its origin does not matter
    const ConvexHull hull = convex_hull(points).value();
    const HullMass mass = hull_mass(hull);
    const Sums sums = by_slices(hull);
    EXPECT_NEAR(static_cast<double>(mass.volume6) / 6, sums.volume, 1e-10 * sums.volume) << n;
    double centre[3];
    for (int i = 0; i < 3; ++i) {
      centre[i] = sums.first[i] / sums.volume;
      EXPECT_NEAR(static_cast<double>(mass.centre[i]) * kDigit, centre[i], 1e-4) << n;
    }
    for (int k = 0; k < 6; ++k) {
      const double expected = sums.second[k] / sums.volume - centre[kRows[k]] * centre[kColumns[k]];
      const std::int64_t found = k < 3 ? mass.variance[k] : mass.product[k - 3];
      EXPECT_NEAR(static_cast<double>(found) * kDigit, expected, 40)
          << n << ' ' << k;  // of 1e8; of double's own digits
    }
  }
}

}  // namespace hull_mass_test
}  // namespace isostep::test
