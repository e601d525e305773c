// The recipes of hulls in scenes, in steps of the grid of hulls.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/geometry/baked/grid_point.hpp"
#include "scenes/hull_recipes.hpp"

namespace isostep::test {

/// Steps of 2^-16 m; the points lie on multiples of 64.
inline std::vector<GridPoint> in_steps(const std::vector<scenes::Point>& points) {
  const auto steps = [](double metres) { return static_cast<std::int32_t>(metres * 65536); };
  std::vector<GridPoint> grid;
  for (const scenes::Point& p : points) grid.push_back({steps(p.x), steps(p.y), steps(p.z)});
  return grid;
}
inline std::vector<GridPoint> drawn_points(int n, scenes::Draws& draws) {
  return in_steps(scenes::drawn_hull(n, draws).points);
}

}  // namespace isostep::test
