// fracture: a convex solid into convex pieces, in integers alone: the same pieces for every scalar and machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/result.hpp"
#include "isostep/fracture/fracture_pattern.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/shapes/box.hpp"

namespace isostep {

/// A piece's frame has the axes of the solid's, and its origin in the middle of the piece's box.
struct FracturePiece {
  BlobRef blob;            // a hull's; null: a box
  GridPoint origin;        // [half steps] of its frame, in the solid's frame
  GridPoint half_extents;  // [half steps] of its box
  std::int64_t volume6;    // [steps^3] six times its volume, exact
  std::int64_t centre[3];  // [2^-16 steps] of mass, in its frame

  // These are what the compiler would make, but without weak functions in each of the files that hold pieces.
  ISO_INLINE FracturePiece() : origin{0, 0, 0}, half_extents{0, 0, 0}, volume6(0), centre{0, 0, 0} {}
  ISO_INLINE FracturePiece(const FracturePiece&) = default;
  ISO_INLINE FracturePiece(FracturePiece&&) = default;
  ISO_INLINE FracturePiece& operator=(const FracturePiece&) = default;
  ISO_INLINE FracturePiece& operator=(FracturePiece&&) = default;
  ISO_INLINE ~FracturePiece() = default;
};

/// A piece's share of the mass is volume6 over `volume6` of all, so shares add up to one.
struct Fracture {
  int exponent = 0;                   // a step is 2^-exponent m
  std::vector<FracturePiece> pieces;  // one or more, in an order that the arguments alone decide
  std::int64_t volume6 = 0;           // [steps^3] of all pieces, exact
  std::int64_t solid_volume6 = 0;     // [steps^3] of the solid, exact
  std::uint32_t refused = 0;          // cuts that were not made and Voronoi points that were dropped

  ISO_INLINE Fracture() = default;
  ISO_INLINE Fracture(const Fracture&) = default;
  ISO_INLINE Fracture(Fracture&&) = default;
  ISO_INLINE Fracture& operator=(const Fracture&) = default;
  ISO_INLINE Fracture& operator=(Fracture&&) = default;
  ISO_INLINE ~Fracture() = default;
};

/// The pieces of a solid. A function of its arguments: equal ones give equal bytes.
/// Method:  planes cut convex cells on a grid 2^10 times finer than the solid's, by exact signs; a new corner is
///          rounded to that grid once, from the lower end of its edge, so both sides of a cut have the same corners. A
///          finished cell's corners are rounded to the solid's grid, halves upwards, and the piece is their hull.
/// Small:   a cut that would leave a side which is too narrow, or which no hull can hold, is not made on that piece; a
///          Voronoi point whose cell would be so is dropped, and its neighbours grow into the room. So the pieces
///          always make up the solid.
/// Error:   corners lie within 5/8 of a step, along each axis, of the exact ones. So pieces reach out of the solid and
///          into each other by less than 1.1 and 2.2 steps, and their volumes add up to the solid's within 1.1 steps
///          times the area of all pieces: measured, 0.12 steps too much, 4e-5 of a solid of 1.2 m in 21 pieces. Exact
///          where all corners fall on the grid, as those of EightBoxes of a box do.
/// Errors:  ErrorCode::invalid, with the argument and field as its place; ErrorCode::limit, with the count, for a
///          pattern that may make more pieces than limits.most_pieces.
/// Solids:  boxes by grid_box, hulls by read_hull. Cylinders, capsules and spheres go by hulls of points on them.
Result<Fracture> fracture(const GridHull& solid, const FracturePattern& pattern, const FractureImpact& impact,
                          std::uint64_t seed, const FractureLimits& limits = {});

/// Makes the hull of a box about the origin, of half extents [steps]. Errors: as below; ErrorCode::invalid, "exponent",
/// for one that is not 0 to 16.
Result<GridHull> grid_box(GridPoint half_extents, int exponent);

namespace detail {
Error bad_fracture_number(const char* place, const char* expected);
}  // namespace detail

/// Makes a box for `fracture`: its half extents [m], rounded to the finest grid that holds them (see hull_blob).
/// Errors: ErrorCode::invalid, "half_extents", for one that is not finite, 0 or less, or beyond the grid; those of
/// convex_hull for a box that is too flat.
template <class S> ISO_INLINE Result<GridHull> grid_box(const Box<S>& box) {
  const Vec3<S>& half = box.half_extents;
  if (!is_finite(half)) return detail::bad_fracture_number("half_extents", "finite numbers");
  if (detail::is_off_grids(max_abs(half))) return detail::bad_fracture_number("half_extents", "numbers below 524287 m");
  const int exponent = finest_lattice(max_abs(half), GridPoint::kLimit, GridHull::kFinest);
  const auto steps = [&](S v) ISO_INLINE_LAMBDA { return static_cast<std::int32_t>(nearest_scaled(v, exponent)); };
  return grid_box(GridPoint{steps(half.x), steps(half.y), steps(half.z)}, exponent);
}

/// Makes an impact [m] in the frame of a solid, as `fracture` takes it: the point to the nearest step, the direction to
/// 15 bits. Errors: ErrorCode::invalid for a number that is not finite, and for a point beyond the solid's grid.
template <class S>
ISO_INLINE Result<FractureImpact> grid_impact(const GridHull& solid, Vec3<S> point, Vec3<S> direction) {
  constexpr std::int64_t kLimit = GridPoint::kLimit;
  if (!is_finite(point)) return detail::bad_fracture_number("point", "finite numbers");
  if (!is_finite(direction)) return detail::bad_fracture_number("direction", "finite numbers");
  if (detail::is_off_grids(max_abs(point)) || floor_scaled(max_abs(point), solid.exponent) + 1 >= kLimit)
    return detail::bad_fracture_number("point", "a point on the solid's grid");
  const auto steps = [&](S v)
                         ISO_INLINE_LAMBDA { return static_cast<std::int32_t>(nearest_scaled(v, solid.exponent)); };
  const int above = exponent_above(max_abs(direction));
  const auto digits = [&](S v) ISO_INLINE_LAMBDA { return above < -60 ? 0 : nearest_scaled(v, 15 - above); };
  return FractureImpact{{steps(point.x), steps(point.y), steps(point.z)},
                        {digits(direction.x), digits(direction.y), digits(direction.z)}};
}

}  // namespace isostep
