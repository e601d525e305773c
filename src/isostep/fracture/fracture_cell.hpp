// FractureCell: a convex polyhedron while planes cut it, on a grid finer than that of its solid.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/fracture/fracture_pattern.hpp"
#include "isostep/geometry/baked/convex_hull.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep::detail {

inline constexpr int kFineBits = 10;  // a fine step is 2^-10 steps; coordinates are below 2^29

/// [fine steps] All p with normal . p <= offset. Components of a normal are below 2^20, so a product has 51 bits and
/// the difference of two 53.
struct FinePlane {
  GridVector normal;
  std::int64_t offset;

  ISO_INLINE FinePlane flipped() const { return {{-normal.x, -normal.y, -normal.z}, -offset}; }
  ISO_INLINE std::int64_t height(GridVector p) const { return dot(normal, p) - offset; }
};
/// The point in fine steps, from steps.
ISO_INLINE GridVector fine(GridPoint p) {
  constexpr std::int64_t kOne = 1 << kFineBits;
  return {p.x * kOne, p.y * kOne, p.z * kOne};
}
ISO_INLINE FinePlane plane_through(GridPoint p, GridVector normal) { return {normal, dot(normal, fine(p))}; }

/// The planes that a corner lies on, by their numbers in its cell: up to 128 faces of the solid and 255 cuts.
struct PlaneSet {
  static constexpr std::uint32_t kMost = 384, kWords = kMost / 64;

  std::uint64_t words[kWords];

  ISO_INLINE void add(std::uint32_t plane) { words[plane / 64] |= std::uint64_t{1} << plane % 64; }
};
struct CellCorner {
  GridVector at;  // [fine steps]
  PlaneSet planes;
};

/// Two corners that share two planes are the ends of an edge. That is all a cell knows of its faces, so no rounding can
/// make it contradict itself: at worst it keeps points that lie inside of the hull of the others.
struct FractureCell {
  std::vector<CellCorner> corners;  // none: it is empty
  std::uint32_t planes = 0;

  ISO_INLINE FractureCell() = default;
  ISO_INLINE FractureCell(const FractureCell&) = default;
  ISO_INLINE FractureCell(FractureCell&&) = default;
  ISO_INLINE FractureCell& operator=(const FractureCell&) = default;
  ISO_INLINE FractureCell& operator=(FractureCell&&) = default;
  ISO_INLINE ~FractureCell() = default;
};

struct Span64 {
  std::int64_t low, high;
};

FractureCell cell_of(const ConvexHull& hull);
/// The part of a cell inside of the plane.
FractureCell clipped(const FractureCell& cell, const FinePlane& plane);
/// [fine steps times the normal's length] The extent of a cell's corners along a normal.
Span64 extent_along(const FractureCell& cell, GridVector normal);
/// The corners on the solid's grid, to nearest, halves upwards.
std::vector<GridPoint> rounded_corners(const FractureCell& cell);

/// numerator / divisor to nearest, halves away from zero; the divisor is positive and the quotient below 2^63.
std::int64_t nearest_quotient(Int128 numerator, std::int64_t divisor);

}  // namespace isostep::detail
