// Distance and depth of two hulls by looking at every pair of features, in double: what the algorithms are held
// against.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "hull_pairs.hpp"

namespace isostep::bench {

/// A hull in the frame of the pair.
struct PlacedHull {
  std::vector<Vec3<double>> vertices, normals;         // [m], [1]
  std::vector<std::array<Vec3<double>, 2>> edges;      // [m]
  std::vector<std::array<Vec3<double>, 3>> triangles;  // [m]
};
PlacedHull placed_hull(const BenchHull& hull, const Transform<double>& at);

struct Exact {
  double gap;       // [m] widest along an axis of faces or of two edges; negative: the depth
  double distance;  // [m] of the nearest points; 0 where they overlap
};
Exact brute_force(const PlacedHull& a, const PlacedHull& b);

/// [m] The gap between the two along a direction from a to b, of any length.
double gap_along(const PlacedHull& a, const PlacedHull& b, Vec3<double> direction);

}  // namespace isostep::bench
