// Random solids on grids of all sizes, hit anywhere: pieces stay inside and add up, and are the same on every machine.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "isostep/core/random.hpp"
#include "unit/effects/fractured.hpp"

namespace isostep::test {
namespace fracture_random_test {

GridPoint point_within(Pcg32& random, std::int32_t most, int flat = 0) {
  GridPoint p = {0, 0, 0};
  p.x = random_between(random, -most, most);
  p.y = random_between(random, -most, most) >> flat;
  p.z = random_between(random, -most, most);
  return p;
}
/// A solid of 4 to 60 points up to 2^19 steps away, a third of them boxes, some of them flat.
Result<GridHull> random_solid(Pcg32& random, std::int32_t most) {
  const int flat = random_between(random, -6, 6);
  const std::int32_t kind = random_between(random, 0, 2);
  if (kind == 0) return grid_box(GridPoint{most, most >> std::max(flat, 0), most}, 16);
  std::vector<GridPoint> points;
  const std::int32_t count = random_between(random, 4, 60);
  for (std::int32_t i = 0; i < count; ++i) points.push_back(point_within(random, most, std::max(flat, 0)));
  const Result<BlobRef> blob = hull_blob(points, 16);
  if (!blob.ok()) return blob.error();
  return read_hull(blob.value()->bytes());
}
std::vector<FracturePattern> random_patterns(Pcg32& random, GridVector grain) {
  GrainPlanes planes = {grain};
  planes.along = random_below(random, 10);
  planes.across = random_below(random, 10);
  RadialCracks cracks;
  cracks.sectors = 2 + random_below(random, 28);
  cracks.rings = random_below(random, 6);
  VoronoiCells cells;
  cells.cells = 1 + random_below(random, 100);
  cells.gathering = random_below(random, 257);
  return {EightBoxes{}, planes, cracks, cells};
}

/// [steps] The distance by which the pieces reach out.
double reach_out_of(const GridHull& solid, const Fracture& fracture) {
  double out = -1;
  for (std::size_t f = 0; f < solid.hull.faces.size(); ++f) {
    const GridPoint at = solid.hull.vertices[solid.hull.half_edges[solid.hull.faces[f]].origin];
    const D3 normal = unit_normal(solid.hull, f), from = {double(at.x), double(at.y), double(at.z)};
    for (const FracturePiece& piece : fracture.pieces) {
      for (const D3 corner : corners_of(piece)) out = std::max(out, dot(normal, corner - from));
    }
  }
  return out;
}
/// [steps^2] The area of its box, which is no less than its own: it is convex.
double area_around(const FracturePiece& piece) {
  const D3 h = {double(piece.half_extents.x), double(piece.half_extents.y), double(piece.half_extents.z)};
  return 2 * (h.x * h.y + h.y * h.z + h.z * h.x);
}

TEST(FractureOfRandomSolids, stays_inside_and_adds_up) {
  Pcg32 random = Pcg32::seeded(405);
  std::uint64_t digest = 0;
  std::size_t solids = 0, pieces = 0;
  for (int round = 0; round < 60; ++round) {
    const std::int32_t most = (1 << random_between(random, 4, 19)) - 1;
    const Result<GridHull> solid = random_solid(random, most);
    FractureImpact impact = {point_within(random, most), {1, 2, 3}};
    impact.direction.y = random_between(random, -524287, 524287);
    const std::vector<FracturePattern> patterns = random_patterns(random, impact.direction);
    if (!solid.ok()) continue;
    ++solids;
    for (const FracturePattern& pattern : patterns) {
      FractureLimits limits = {.most_pieces = 256};
      limits.least_width = round % 3 == 0 ? 4 : 0;
      const Result<Fracture> f = fracture(solid.value(), pattern, impact, random.next(), limits);
      ASSERT_TRUE(f.ok()) << f.error().message.view();
      double area = 0;
      for (const FracturePiece& piece : f.value().pieces) area += area_around(piece);
      EXPECT_LT(std::fabs(double(f.value().volume6 - f.value().solid_volume6)) / 6, 1.1 * area);
      EXPECT_LT(reach_out_of(solid.value(), f.value()), 1.1);
      const std::vector<std::uint8_t> bytes = bytes_of(f.value());
      digest = digest * 31 + hash_bytes(bytes.data(), bytes.size());
      pieces += f.value().pieces.size();
    }
  }
  EXPECT_GT(solids, 40u);
  EXPECT_GT(pieces, 3000u);
  EXPECT_EQ(digest, 10983483179193545914u);
}

}  // namespace fracture_random_test
}  // namespace isostep::test
