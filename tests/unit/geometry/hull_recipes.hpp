// Recipes of hulls: rocks, prisms, frusta and cones, with points on a grid of 1/1024 m.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "isostep/geometry/baked/grid_point.hpp"
#include "scenes/shapes.hpp"

namespace isostep::test {

/// 64 steps of the grid of hulls, of 2^-16 m, are one of 1/1024 m.
inline GridPoint in_steps(double x, double y, double z) {
  const auto steps = [](double metres) { return static_cast<std::int32_t>(std::floor(1024 * metres + 0.5)) * 64; };
  return {steps(x), steps(y), steps(z)};
}

/// Points near an ellipsoid.
inline std::vector<GridPoint> rock(double a, double b, double c, scenes::Draws& draws) {
  std::vector<GridPoint> points;
  const int count = 12 + static_cast<int>(std::floor(20 * a));
  const double radius = 0.25 + 0.25 * b;
  for (int i = 0; i < count; ++i) {
    double x = draws.between(-1, 1), y = draws.between(-1, 1), z = draws.between(-1, 1);
    double length = std::sqrt(x * x + y * y + z * z);
    if (length < 1.0 / 16) x = length = 1, y = z = 0;
    points.push_back(in_steps(x / length * radius, y / length * (0.6 + 0.4 * c) * radius, z / length * radius));
  }
  return points;
}
inline void add_ring(std::vector<GridPoint>& points, int corners, double radius, double y) {
  for (int i = 0; i < corners; ++i) {
    const double angle = scenes::kTurn * i / corners;
    points.push_back(in_steps(radius * std::cos(angle), y, radius * std::sin(angle)));
  }
}
inline std::vector<GridPoint> prism(double a, double b, double c) {
  std::vector<GridPoint> points;
  const double h = 0.15 + 0.35 * c;
  for (const double y : {h, -h}) add_ring(points, 5 + static_cast<int>(std::floor(8 * a)), 0.2 + 0.3 * b, y);
  return points;
}
inline std::vector<GridPoint> frustum(double a, double b, double c) {
  std::vector<GridPoint> points;
  const double hx = 0.2 + 0.25 * a, hy = 0.2 + 0.25 * b, hz = 0.2 + 0.25 * c;
  for (const double x : {-hx, hx}) {
    for (const double z : {-hz, hz}) {
      points.push_back(in_steps(x, -hy, z));
      points.push_back(in_steps(0.6 * x, hy, 0.6 * z));
    }
  }
  return points;
}
inline std::vector<GridPoint> pyramid(double a, double b, double c) {
  std::vector<GridPoint> points;
  const double h = 0.2 + 0.25 * c;
  add_ring(points, 5 + static_cast<int>(std::floor(8 * a)), 0.2 + 0.25 * b, -h);
  points.push_back(in_steps(0, h, 0));
  return points;
}

/// The n-th of a scene: draws a, b, c and a yaw, then the rock's points.
inline std::vector<GridPoint> drawn_hull(int n, scenes::Draws& draws) {
  const double a = draws.unit(), b = draws.unit(), c = draws.unit();
  draws.unit();
  switch (n % 4) {
    case 0: return rock(a, b, c, draws);
    case 1: return prism(a, b, c);
    case 2: return frustum(a, b, c);
    default: return pyramid(a, b, c);
  }
}

}  // namespace isostep::test
