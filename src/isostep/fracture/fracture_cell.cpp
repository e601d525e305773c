// Cells of a fracture, cut by planes.
// SPDX-License-Identifier: MIT
#include "fracture_cell.hpp"

#include <bit>

namespace isostep::detail {
namespace {

PlaneSet common(const PlaneSet& a, const PlaneSet& b) {
  PlaneSet both;
  for (std::uint32_t i = 0; i < PlaneSet::kWords; ++i) both.words[i] = a.words[i] & b.words[i];
  return both;
}
bool is_edge(const PlaneSet& both) {
  int planes = 0;
  for (const std::uint64_t word : both.words) planes += std::popcount(word);
  return planes >= 2;
}

bool is_lower(GridVector a, GridVector b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// The point where the edge from a to b crosses the plane, at heights of either sign. It is found from the lower end,
/// so that both sides of a cut round alike.
GridVector crossing(GridVector a, std::int64_t height_a, GridVector b, std::int64_t height_b) {
  if (is_lower(b, a)) return crossing(b, height_b, a, height_a);
  const std::int64_t part = height_a < 0 ? -height_a : height_a;
  const std::int64_t whole = part + (height_b < 0 ? -height_b : height_b);
  const auto along = [&](std::int64_t from, std::int64_t to) {
    return from + nearest_quotient(Int128(to - from) * part, whole);
  };
  return {along(a.x, b.x), along(a.y, b.y), along(a.z, b.z)};
}

}  // namespace

std::int64_t nearest_quotient(Int128 numerator, std::int64_t divisor) {
  const bool negative = numerator < Int128(0);
  const Int128 magnitude = (negative ? -numerator : numerator) + Int128(divisor / 2);
  const auto quotient =
      static_cast<std::int64_t>(divide(parts(magnitude), static_cast<std::uint64_t>(divisor)).quotient);
  return negative ? -quotient : quotient;
}

FractureCell cell_of(const ConvexHull& hull) {
  FractureCell cell;
  for (const GridPoint p : hull.vertices) cell.corners.push_back({fine(p), {}});
  for (const HalfEdge& edge : hull.half_edges) cell.corners[edge.origin].planes.add(edge.face);
  cell.planes = static_cast<std::uint32_t>(hull.faces.size());
  return cell;
}

FractureCell clipped(const FractureCell& cell, const FinePlane& plane) {
  std::vector<std::int64_t> heights;
  bool any_above = false, any_below = false;
  for (const CellCorner& corner : cell.corners) {
    heights.push_back(plane.height(corner.at));
    any_above = any_above || heights.back() > 0;
    any_below = any_below || heights.back() < 0;
  }
  if (!any_above) return cell;
  FractureCell kept;
  if (!any_below || cell.planes == PlaneSet::kMost) return kept;
  kept.planes = cell.planes + 1;
  const std::size_t count = cell.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (heights[i] > 0) continue;
    kept.corners.push_back(cell.corners[i]);
    if (heights[i] == 0) kept.corners.back().planes.add(cell.planes);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; heights[i] < 0 && j < count; ++j) {
      if (heights[j] <= 0) continue;
      PlaneSet both = common(cell.corners[i].planes, cell.corners[j].planes);
      if (!is_edge(both)) continue;
      both.add(cell.planes);
      kept.corners.push_back({crossing(cell.corners[i].at, heights[i], cell.corners[j].at, heights[j]), both});
    }
  }
  return kept;
}

Span64 extent_along(const FractureCell& cell, GridVector normal) {
  Span64 span = {dot(normal, cell.corners[0].at), dot(normal, cell.corners[0].at)};
  for (const CellCorner& corner : cell.corners) {
    const std::int64_t at = dot(normal, corner.at);
    span = {min(span.low, at), max(span.high, at)};
  }
  return span;
}

std::vector<GridPoint> rounded_corners(const FractureCell& cell) {
  std::vector<GridPoint> points;
  const auto step = [](std::int64_t v) {
    return static_cast<std::int32_t>((v + (std::int64_t{1} << (kFineBits - 1))) >> kFineBits);
  };
  for (const CellCorner& corner : cell.corners)
    points.push_back({step(corner.at.x), step(corner.at.y), step(corner.at.z)});
  return points;
}

}  // namespace isostep::detail
