// The cells of seeded points.
// SPDX-License-Identifier: MIT
#include <utility>

#include "fracture_shards.hpp"

namespace isostep::detail {
namespace {

bool holds(const ConvexHull& hull, GridPoint p) {
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const GridPoint at = hull.vertices[hull.half_edges[hull.faces[f]].origin];
    if (dot(hull.normal(static_cast<std::uint8_t>(f)), p - at) > 0) return false;
  }
  return true;
}

/// Evenly in the solid; after 64 vain draws, which only slivers need, anywhere in its box.
GridPoint draw_in(const ConvexHull& hull, const HullBox& box, Pcg32& random) {
  GridPoint p = {0, 0, 0};
  for (int attempt = 0; attempt < 64; ++attempt) {
    p.x = random_between(random, box.low.x, box.high.x);
    p.y = random_between(random, box.low.y, box.high.y);
    p.z = random_between(random, box.low.z, box.high.z);
    if (holds(hull, p)) break;
  }
  return p;
}

/// The point moved towards the impact by up to `gathering` / 256 of the way.
GridPoint gathered(GridPoint p, GridPoint impact, std::uint32_t gathering, Pcg32& random) {
  const std::int64_t share = std::int64_t{gathering} * random_below(random, 1u << 16);  // [2^-24]
  const GridVector way = impact - p;
  const auto moved = [&](std::int32_t from, std::int64_t by) {
    return static_cast<std::int32_t>(from + nearest_quotient(Int128(by) * share, 1 << 24));
  };
  return {moved(p.x, way.x), moved(p.y, way.y), moved(p.z, way.z)};
}

/// The plane with the points nearer to a than to b inside.
FinePlane bisector(GridPoint a, GridPoint b) {
  const GridVector normal = b - a, sum = {std::int64_t{a.x} + b.x, std::int64_t{a.y} + b.y, std::int64_t{a.z} + b.z};
  return {normal, dot(normal, sum) * (1 << (kFineBits - 1))};
}

/// The cell of one point among the others; false where it is too small, or the point is another's double.
bool cell_at(const FractureShards& shards, const FractureCell& solid, const std::vector<GridPoint>& points,
             std::size_t own, FractureShard& shard) {
  shard.cell = solid;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == own) continue;
    if (points[i] == points[own]) return false;
    shard.cell = clipped(shard.cell, bisector(points[own], points[i]));
    if (shard.cell.corners.empty()) return false;
  }
  return shards.bake(shard.cell, shard.hull);
}

}  // namespace

void shatter_voronoi(FractureShards& shards, const VoronoiCells& pattern, const FractureImpact& impact, Pcg32 random) {
  const FractureShard solid = shards.shards[0];
  const HullBox box = box_of(solid.hull);
  std::vector<GridPoint> points;
  for (std::uint32_t i = 0; i < pattern.cells; ++i) {
    const GridPoint p = draw_in(solid.hull, box, random);
    points.push_back(gathered(p, impact.point, pattern.gathering, random));
  }
  // A point that is dropped only enlarges other cells, but may change those found before it: so once more from the
  // first.
  for (bool complete = false; !complete;) {
    complete = true;
    shards.shards.clear();
    for (std::size_t i = 0; i < points.size() && points.size() > 1;) {
      FractureShard shard;
      if (cell_at(shards, solid.cell, points, i, shard)) {
        shards.shards.push_back(std::move(shard));
        ++i;
      } else {
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
        ++shards.refused;
        complete = i == 0 && complete;
      }
    }
  }
  if (points.size() == 1) shards.shards.assign(1, solid);
}

}  // namespace isostep::detail
