// MeshBuilder: a mesh of quads, and of blocks of cells that a formula bends.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "level.hpp"

namespace isostep::scenes {

/// A map from place to place; it mirrors nothing.
using Warp = std::function<Point(Point)>;
/// Cells between planes; `round`: the last of x are beside the first.
struct Planes {
  std::vector<double> x, y, z;
  bool round = false;
};
/// The choice of cells by their numbers along x, y, z.
using Filled = std::function<bool(int i, int j, int k)>;

/// `count` + 1 planes.
std::vector<double> evenly(double from, double to, int count);
/// Cell `i` of the planes is between two places.
bool is_between(const std::vector<double>& planes, int i, double from, double to);

class MeshBuilder {
 public:
  MeshBuilder() { part_.type = ShapeType::mesh; }
  /// Sets the material of what follows.
  void use(int material) { material_ = material; }
  /// Counter-clockwise seen from outside. A side without length makes it a triangle.
  void quad(Point a, Point b, Point c, Point d);
  /// Adds what is filled, closed all around: a quad wherever a filled cell is beside an empty one.
  void add_cells(const Planes& planes, const Filled& filled, const Warp& warp);
  /// A closed column about an upright axis.
  void add_column(Point foot, double radius, double height, int sides);
  const ScenePart& part() const { return part_; }

 private:
  double vertex(Point p);
  void triangle(double a, double b, double c);

  ScenePart part_;
  int material_ = 0;
  std::map<std::array<double, 3>, double> vertices_;
};

}  // namespace isostep::scenes
