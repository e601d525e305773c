// Nearest points of segments and triangles, and the corners of solids, in double: what the oracles of distances share.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "distance.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::scenes {

inline Vec3<double> nearest_on_segment(Vec3<double> p, Vec3<double> from, Vec3<double> to) {
  const Vec3<double> way = to - from;
  const double square = dot(way, way);
  return from + way * (square > 0 ? clamp(dot(p - from, way) / square, 0.0, 1.0) : 0.0);
}
/// The nearest point of the triangle: over its inside that of its plane, else of its sides.
inline Vec3<double> nearest_on_triangle(Vec3<double> p, const std::array<Vec3<double>, 3>& t) {
  const Vec3<double> normal = cross(t[1] - t[0], t[2] - t[0]);
  bool above = true;
  double least = std::numeric_limits<double>::infinity();
  Vec3<double> best = t[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<double> from = t[i], to = t[(i + 1) % 3];
    above = above && dot(cross(to - from, p - from), normal) >= 0;
    const Vec3<double> q = nearest_on_segment(p, from, to);
    if (length(p - q) < least) least = length(p - q), best = q;
  }
  return above ? p - normal * (dot(normal, p - t[0]) / dot(normal, normal)) : best;
}

/// The points whose hull the core of a solid is, in its own frame: a hull's vertices, 64 of each rim of a cylinder or
/// cone, else the corners of `half`.
inline std::vector<Vec3<double>> core_points(const Solid& solid) {
  if (solid.type == ShapeType::hull) return {solid.hull->vertices.begin(), solid.hull->vertices.end()};
  std::vector<Vec3<double>> points;
  if (solid.type == ShapeType::cylinder || solid.type == ShapeType::cone) {
    for (int k = 0; k < 64; ++k) {
      const double turn = k * std::numbers::pi / 32, x = std::cos(turn), z = std::sin(turn);
      const double top = solid.type == ShapeType::cylinder ? solid.radius : 0.0;
      points.push_back({solid.radius * x, -solid.half.y, solid.radius * z});
      points.push_back({top * x, solid.half.y, top * z});
    }
    return points;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](int axis) { return (corner >> axis & 1) != 0 ? solid.half[axis] : -solid.half[axis]; };
    points.push_back({side(0), side(1), side(2)});
  }
  return points;
}

}  // namespace isostep::scenes
