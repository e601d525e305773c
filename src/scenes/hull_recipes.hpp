// Recipes of hulls: rocks, prisms, frusta and cones, with points on a grid of 1/1024 m, so that every scalar and every
// engine gets one geometry.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "shapes.hpp"

namespace isostep::scenes {

/// Points near an ellipsoid. a, b, c in all recipes: 0 up to 1.
std::vector<Point> rock_points(double a, double b, double c, Draws& draws);
std::vector<Point> prism_points(double a, double b, double c);
std::vector<Point> frustum_points(double a, double b, double c);
std::vector<Point> cone_points(double a, double b, double c);

struct DrawnHull {
  std::vector<Point> points;  // [m]
  double yaw;                 // [rad]
};
/// A rock, prism, frustum, cone in turn: draws a, b, c and the yaw, then a rock's points.
DrawnHull drawn_hull(int n, Draws& draws);

ScenePart hull_part(const std::vector<Point>& points);

}  // namespace isostep::scenes
