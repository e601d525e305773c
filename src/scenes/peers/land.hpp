// Ground for scenes after the peers' own: a mesh over a grid, centred on the origin.
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/shapes.hpp"

namespace isostep::scenes {

/// `height(i, k)` [m] at the corner of column i and row k; cells of `pitch` [m].
template <class Height> ScenePart land(int columns, int rows, double pitch, const Height& height) {
  ScenePart part;
  part.type = ShapeType::mesh;
  for (int i = 0; i <= columns; ++i) {
    for (int k = 0; k <= rows; ++k) {
      part.vertices.push_back({(i - columns * 0.5) * pitch, height(i, k), (k - rows * 0.5) * pitch});
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      const double a = i * (rows + 1) + k, b = a + rows + 1, c = a + 1, d = b + 1;
      part.triangles.push_back({a, c, d});
      part.triangles.push_back({d, b, a});
    }
  }
  return part;
}

}  // namespace isostep::scenes
