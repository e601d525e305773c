// HullMass: volume, centre and second moments of a convex hull, in steps of its grid.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/geometry/baked/convex_hull.hpp"

namespace isostep {

/// The mass of a hull as a homogeneous solid. Sums of signed tetrahedra are exact in integers; the results are within
/// two of their last digits.
struct HullMass {
  static constexpr int kFractionBits = 16;

  std::int64_t volume6;      // [steps^3] six times the volume, exact
  std::int64_t centre[3];    // [2^-16 steps] from the grid's origin
  std::int64_t variance[3];  // [2^-16 steps^2] means of x x, y y, z z about the centre
  std::int64_t product[3];   // [2^-16 steps^2] means of y z, z x, x y about the centre
};

HullMass hull_mass(const ConvexHull& hull);

}  // namespace isostep
