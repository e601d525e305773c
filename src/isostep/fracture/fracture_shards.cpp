// Shards that are cut, and the least size of one.
// SPDX-License-Identifier: MIT
#include "fracture_shards.hpp"

#include <utility>

namespace isostep::detail {
namespace {

/// floor(sqrt(n)), n below 2^124, by bits from above.
std::int64_t whole_root(Int128 n) {
  std::int64_t root = 0;
  for (int bit = 61; bit >= 0; --bit) {
    const std::int64_t more = root + (std::int64_t{1} << bit);
    if (Int128(more) * more <= n) root = more;
  }
  return root;
}

}  // namespace

HullBox box_of(const ConvexHull& hull) {
  GridPoint low = hull.vertices[0], high = low;
  for (const GridPoint p : hull.vertices) {
    low = {min(low.x, p.x), min(low.y, p.y), min(low.z, p.z)};
    high = {max(high.x, p.x), max(high.y, p.y), max(high.z, p.z)};
  }
  return {low, high};
}

std::int64_t least_width_of(const ConvexHull& hull) {
  const HullBox box = box_of(hull);
  const GridVector size = box.high - box.low;
  std::int64_t least = min(size.x, min(size.y, size.z));
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const GridVector normal = hull.normal(static_cast<std::uint8_t>(f));
    const GridPoint at = hull.vertices[hull.half_edges[hull.faces[f]].origin];
    std::int64_t deepest = 0;
    for (const GridPoint vertex : hull.vertices) deepest = max(deepest, dot(normal, at - vertex));
    // The length is rounded up, so the depth is rounded down.
    least = min(least, deepest / (whole_root(squared_length(normal)) + 1));
  }
  return least;
}

FractureShards::FractureShards(const ConvexHull& solid, std::int64_t least_width) : least_width_(least_width) {
  shards.emplace_back();
  shards[0].cell = cell_of(solid);
  shards[0].hull = solid;
}

bool FractureShards::bake(const FractureCell& cell, ConvexHull& hull) const {
  if (cell.corners.size() < 4) return false;
  Result<ConvexHull> made = convex_hull(rounded_corners(cell));
  if (!made.ok() || least_width_of(made.value()) < least_width_) return false;
  hull = std::move(made.value());
  return true;
}

bool FractureShards::cut(std::size_t shard, const FinePlane& plane) {
  const Span64 span = extent_along(shards[shard].cell, plane.normal);
  if (plane.offset <= span.low || span.high <= plane.offset) return false;
  FractureShard inside = shards[shard], outside = shards[shard];
  inside.cell = clipped(shards[shard].cell, plane);
  outside.cell = clipped(shards[shard].cell, plane.flipped());
  if (!bake(inside.cell, inside.hull) || !bake(outside.cell, outside.hull)) {
    ++refused;
    return false;
  }
  shards[shard] = std::move(inside);
  shards.push_back(std::move(outside));
  return true;
}

}  // namespace isostep::detail
