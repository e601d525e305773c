// The points of the recipes.
// SPDX-License-Identifier: MIT
#include "hull_recipes.hpp"

#include <cmath>

namespace isostep::scenes {
namespace {


void add_ring(std::vector<Point>& points, int corners, double radius, double y) {
  for (int i = 0; i < corners; ++i) {
    const SinCos<double> angle = sin_cos(kTurn * i / corners);
    points.push_back(on_grid(Point{radius * angle.cos, y, radius * angle.sin}));
  }
}
int corners(double a) { return 5 + static_cast<int>(8 * a); }

}  // namespace

std::vector<Point> rock_points(double a, double b, double c, Draws& draws) {
  std::vector<Point> points;
  const int count = 12 + static_cast<int>(20 * a);
  const double radius = 0.25 + 0.25 * b;
  for (int i = 0; i < count; ++i) {
    double x = draws.between(-1, 1), y = draws.between(-1, 1), z = draws.between(-1, 1);
    double length = sqrt(x * x + y * y + z * z);
    if (length < 1.0 / 16) x = length = 1, y = z = 0;
    points.push_back(on_grid(Point{x / length * radius, y / length * (0.6 + 0.4 * c) * radius, z / length * radius}));
  }
  return points;
}
std::vector<Point> prism_points(double a, double b, double c) {
  std::vector<Point> points;
  const double h = 0.15 + 0.35 * c;
  for (const double y : {h, -h}) add_ring(points, corners(a), 0.2 + 0.3 * b, y);
  return points;
}
std::vector<Point> frustum_points(double a, double b, double c) {
  std::vector<Point> points;
  const double hx = 0.2 + 0.25 * a, hy = 0.2 + 0.25 * b, hz = 0.2 + 0.25 * c;
  for (const double x : {-hx, hx}) {
    for (const double z : {-hz, hz}) {
      points.push_back(on_grid(Point{x, -hy, z}));
      points.push_back(on_grid(Point{0.6 * x, hy, 0.6 * z}));
    }
  }
  return points;
}
std::vector<Point> cone_points(double a, double b, double c) {
  std::vector<Point> points;
  const double h = 0.2 + 0.25 * c;
  add_ring(points, corners(a), 0.2 + 0.25 * b, -h);
  points.push_back(on_grid(Point{0, h, 0}));
  return points;
}

DrawnHull drawn_hull(int n, Draws& draws) {
  const double a = draws.unit(), b = draws.unit(), c = draws.unit();
  DrawnHull drawn = {{}, kTurn * draws.unit()};
  switch (n % 4) {
    case 0: drawn.points = rock_points(a, b, c, draws); break;
    case 1: drawn.points = prism_points(a, b, c); break;
    case 2: drawn.points = frustum_points(a, b, c); break;
    default: drawn.points = cone_points(a, b, c); break;
  }
  return drawn;
}

ScenePart hull_part(const std::vector<Point>& points) {
  ScenePart part;
  part.type = ShapeType::hull;
  for (const Point p : points) part.points.push_back(vector_of(p));
  return part;
}

}  // namespace isostep::scenes
