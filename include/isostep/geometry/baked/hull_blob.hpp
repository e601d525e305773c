// Convex hulls as blobs: what their bytes are, and how points become one.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/geometry/baked/convex_hull.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

/// The vertices of a convex hull, ascending, and the step of their grid. Its bytes are the exponent, the number of
/// vertices and their coordinates; the rest of the hull follows from them.
struct GridHull {
  static constexpr int kFinest = 16;  // [1] exponent: 15 um, below which Q16.16 has no digits

  int exponent;  // a step is 2^-exponent m, 0 to kFinest
  ConvexHull hull;
};

/// Makes the blob of the points' hull. Errors: of convex_hull; ErrorCode::invalid, whose place is "exponent".
Result<BlobRef> hull_blob(std::span<const GridPoint> points, int exponent, BlobHome home = BlobHome::carried);
/// Reads a hull's bytes. Errors: ErrorCode::corrupt, ::truncated or those above for anything but the bytes that
/// hull_blob makes.
Result<GridHull> read_hull(Bytes bytes);

namespace detail {
/// Returns true if a magnitude is beyond the coarsest grid.
template <class S> ISO_INLINE bool is_off_grids(S magnitude) {
  return exponent_above(magnitude) > 19 || floor_scaled(magnitude, 0) + 1 >= GridPoint::kLimit;
}
Error bad_hull_point(std::size_t index, const char* expected);
}  // namespace detail

/// Makes the hull of points [m]. They are rounded to the finest grid that holds all of them: 2^-16 m up to 8 m from the
/// origin, 2^-15 m up to 16 m, and so on: 1 m up to 524 287 m.
/// Errors: as above; ErrorCode::invalid for a coordinate that is not finite or beyond the grid, with its point's index.
template <class S>
ISO_INLINE Result<BlobRef> hull_blob(std::span<const Vec3<S>> points, BlobHome home = BlobHome::carried) {
  S most = S(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) return detail::bad_hull_point(i, "finite numbers");
    if (detail::is_off_grids(max_abs(points[i]))) return detail::bad_hull_point(i, "coordinates below 524287 m");
    most = max(most, max_abs(points[i]));
  }
  const int exponent = finest_lattice(most, GridPoint::kLimit, GridHull::kFinest);
  const auto steps = [&](S v) ISO_INLINE_LAMBDA { return static_cast<std::int32_t>(nearest_scaled(v, exponent)); };
  std::vector<GridPoint> grid;
  for (const Vec3<S>& p : points) grid.push_back({steps(p.x), steps(p.y), steps(p.z)});
  return hull_blob(grid, exponent, home);
}

}  // namespace isostep
