// The checks of fracture's arguments, and from shards to pieces.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/fracture.hpp"

#include <utility>

#include "fracture_shards.hpp"
#include "isostep/geometry/baked/hull_mass.hpp"

namespace isostep {
namespace {

using detail::bad_fracture_number;

bool is_on_grid(GridPoint p) {
  constexpr std::int32_t kLimit = GridPoint::kLimit;
  const auto within = [](std::int32_t v) { return -kLimit < v && v < kLimit; };
  return within(p.x) && within(p.y) && within(p.z);
}
bool is_direction(GridVector d) {
  constexpr std::int64_t kLimit = GridPoint::kLimit;
  const auto within = [](std::int64_t v) { return -kLimit < v && v < kLimit; };
  return within(d.x) && within(d.y) && within(d.z);
}
bool is_zero(GridVector d) { return d.x == 0 && d.y == 0 && d.z == 0; }

/// The greatest number of pieces of a pattern, or the error in it.
Result<std::uint32_t> most_pieces_of(const FracturePattern& pattern, const FractureImpact& impact) {
  if (const auto* grain = std::get_if<GrainPlanes>(&pattern)) {
    if (!is_direction(grain->grain) || is_zero(grain->grain))
      return bad_fracture_number("pattern.grain", "a direction that is not zero, components below 2^19");
    if (grain->along > GrainPlanes::kMost) return bad_fracture_number("pattern.along", "0 to 64");
    if (grain->across > GrainPlanes::kMost) return bad_fracture_number("pattern.across", "0 to 64");
    return (grain->along + 1) * (grain->across + 1);
  }
  if (const auto* radial = std::get_if<RadialCracks>(&pattern)) {
    if (is_zero(impact.direction))
      return bad_fracture_number("impact.direction", "a direction that is not zero, for RadialCracks");
    if (radial->sectors < 2 || radial->sectors > RadialCracks::kMost)
      return bad_fracture_number("pattern.sectors", "2 to 64");
    if (radial->rings > RadialCracks::kMost) return bad_fracture_number("pattern.rings", "0 to 64");
    return radial->sectors * (radial->rings + 1);
  }
  if (const auto* voronoi = std::get_if<VoronoiCells>(&pattern)) {
    if (voronoi->cells < 1 || voronoi->cells > FractureLimits::kMostPieces)
      return bad_fracture_number("pattern.cells", "1 to 256");
    if (voronoi->gathering > 256) return bad_fracture_number("pattern.gathering", "0 to 256");
    return voronoi->cells;
  }
  return 8u;
}

Error too_many(std::uint32_t count, std::uint32_t most) {
  ShortText<112> text = "the pattern may make ";
  text.append_number(count).append(" pieces; expected at most ").append_number(most);
  return {ErrorCode::limit, text, "limits.most_pieces"};
}

Result<void> checked(const GridHull& solid, const FracturePattern& pattern, const FractureImpact& impact,
                     const FractureLimits& limits) {
  if (solid.exponent < 0 || solid.exponent > GridHull::kFinest) return bad_fracture_number("solid.exponent", "0 to 16");
  if (solid.hull.vertices.size() < 4 || solid.hull.faces.size() < 4)
    return bad_fracture_number("solid.hull", "a hull of convex_hull, read_hull or grid_box");
  if (!is_on_grid(impact.point)) return bad_fracture_number("impact.point", "coordinates below 2^19 steps");
  if (!is_direction(impact.direction)) return bad_fracture_number("impact.direction", "components below 2^19");
  if (limits.most_pieces < 1 || limits.most_pieces > FractureLimits::kMostPieces)
    return bad_fracture_number("limits.most_pieces", "1 to 256");
  if (limits.least_width < 0 || limits.least_width > GridPoint::kLimit)
    return bad_fracture_number("limits.least_width", "0 to 2^19 steps");
  const Result<std::uint32_t> count = most_pieces_of(pattern, impact);
  if (!count.ok()) return count.error();
  if (count.value() > limits.most_pieces) return too_many(count.value(), limits.most_pieces);
  return {};
}

std::int64_t least_width_for(const GridHull& solid, const FractureLimits& limits) {
  if (limits.least_width != 0) return limits.least_width;
  const std::int64_t for_all_scalars = solid.exponent > 5 ? std::int64_t{1} << (solid.exponent - 5) : 1;
  return min(for_all_scalars, detail::least_width_of(solid.hull) * 7 / 8);
}

void run(detail::FractureShards& shards, const FracturePattern& pattern, const FractureImpact& impact,
         std::uint64_t seed) {
  const Pcg32 random = Pcg32::seeded(seed, pattern.index());
  if (const auto* grain = std::get_if<GrainPlanes>(&pattern)) return shatter_grain(shards, *grain, impact, random);
  if (const auto* radial = std::get_if<RadialCracks>(&pattern)) return shatter_radial(shards, *radial, impact, random);
  if (const auto* cells = std::get_if<VoronoiCells>(&pattern)) return shatter_voronoi(shards, *cells, impact, random);
  shatter_boxes(shards, impact);
}

/// The hull is its box: eight corners, each at an end of every axis.
bool is_box(const ConvexHull& hull, const detail::HullBox& box) {
  if (hull.vertices.size() != 8) return false;
  const auto at_end = [](std::int32_t v, std::int32_t low, std::int32_t high) { return v == low || v == high; };
  for (const GridPoint p : hull.vertices) {
    if (!at_end(p.x, box.low.x, box.high.x) || !at_end(p.y, box.low.y, box.high.y) ||
        !at_end(p.z, box.low.z, box.high.z))
      return false;
  }
  return true;
}

/// The corners move by whole steps, so the piece is the hull that was judged, bit for bit.
Result<FracturePiece> piece_of(const ConvexHull& hull, int exponent) {
  const detail::HullBox box = detail::box_of(hull);
  FracturePiece piece;
  piece.half_extents = {box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
  piece.volume6 = hull_mass(hull).volume6;
  piece.origin = {box.low.x + box.high.x, box.low.y + box.high.y, box.low.z + box.high.z};
  if (is_box(hull, box)) return piece;
  const GridPoint middle = {piece.origin.x >> 1, piece.origin.y >> 1, piece.origin.z >> 1};
  piece.origin = {middle.x * 2, middle.y * 2, middle.z * 2};
  std::vector<GridPoint> points;
  for (const GridPoint p : hull.vertices) points.push_back({p.x - middle.x, p.y - middle.y, p.z - middle.z});
  Result<BlobRef> blob = hull_blob(points, exponent);
  if (!blob.ok()) return blob.error();
  piece.blob = std::move(blob.value());
  const Result<ConvexHull> moved = convex_hull(points);
  const HullMass mass = hull_mass(moved.value());
  for (int i = 0; i < 3; ++i) piece.centre[i] = mass.centre[i];
  return piece;
}

}  // namespace

Error detail::bad_fracture_number(const char* place, const char* expected) {
  ShortText<112> text = "expected ";
  return {ErrorCode::invalid, text.append(expected), place};
}

Result<GridHull> grid_box(GridPoint half_extents, int exponent) {
  const GridPoint h = half_extents;
  if (h.x <= 0 || h.y <= 0 || h.z <= 0)
    return bad_fracture_number("half_extents", "numbers above 0, of a step or more");
  if (!is_on_grid(h)) return bad_fracture_number("half_extents", "numbers below 2^19 steps");
  if (exponent < 0 || exponent > GridHull::kFinest) return bad_fracture_number("exponent", "0 to 16");
  std::vector<GridPoint> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 4) != 0 ? h.x : -h.x, (i & 2) != 0 ? h.y : -h.y, (i & 1) != 0 ? h.z : -h.z});
  const Result<BlobRef> blob = hull_blob(corners, exponent);  // moving a GridHull here would leave a weak function
  if (!blob.ok()) return blob.error();
  return read_hull(blob.value()->bytes());
}

Result<Fracture> fracture(const GridHull& solid, const FracturePattern& pattern, const FractureImpact& impact,
                          std::uint64_t seed, const FractureLimits& limits) {
  const Result<void> valid = checked(solid, pattern, impact, limits);
  if (!valid.ok()) return valid.error();
  detail::FractureShards shards(solid.hull, least_width_for(solid, limits));
  run(shards, pattern, impact, seed);
  Fracture result;
  result.exponent = solid.exponent;
  result.solid_volume6 = hull_mass(solid.hull).volume6;
  result.refused = shards.refused;
  for (const detail::FractureShard& shard : shards.shards) {
    Result<FracturePiece> piece = piece_of(shard.hull, solid.exponent);
    if (!piece.ok()) return piece.error();
    result.volume6 += piece.value().volume6;
    result.pieces.push_back(std::move(piece.value()));
  }
  return result;
}

}  // namespace isostep
