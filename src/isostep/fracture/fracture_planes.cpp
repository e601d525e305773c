// Patterns of planes: the eight boxes, and the grain of wood.
// SPDX-License-Identifier: MIT
#include "fracture_directions.hpp"
#include "fracture_shards.hpp"

namespace isostep::detail {
namespace {

/// The impact, moved along the blow to the middle of the solid's box.
GridPoint middle_of_blow(const HullBox& box, const FractureImpact& impact) {
  const GridPoint p = impact.point;
  const GridVector d = impact.direction, doubled = {std::int64_t{2} * p.x - box.low.x - box.high.x,
                                                    std::int64_t{2} * p.y - box.low.y - box.high.y,
                                                    std::int64_t{2} * p.z - box.low.z - box.high.z};
  const std::int64_t square = dot(d, d);
  if (square == 0) return p;
  const std::int64_t along = dot(d, doubled);  // [half steps] times the length of d
  const auto moved = [&](std::int32_t from, std::int64_t component) {
    const std::int64_t by = nearest_quotient(Int128(along) * component, 2 * square);
    return static_cast<std::int32_t>(from - by);
  };
  return {moved(p.x, d.x), moved(p.y, d.y), moved(p.z, d.z)};
}

/// The k-th of `count` places that cut a span into even parts, moved by up to a quarter of a part.
std::int64_t place_between(Span64 span, std::uint32_t k, std::uint32_t count, Pcg32& random) {
  const std::int64_t even = std::int64_t{k + 1} << 16;
  const std::int64_t share = (even + random_between(random, -(1 << 14), 1 << 14)) / (count + 1);  // [2^-16]
  return span.low + nearest_quotient(Int128(span.high - span.low) * share, 1 << 16);
}

/// One board, cut across from its low end to its high end.
void cut_board(FractureShards& shards, std::size_t board, const GrainPlanes& pattern, const Frame3& frame,
               GridPoint impact, Pcg32& random) {
  std::size_t rest = board;
  const FractureCell whole = shards.shards[board].cell;
  for (std::uint32_t k = 0; k < pattern.across; ++k) {
    const std::int32_t t = random_between(random, -kSpokeLength / 8, kSpokeLength / 8);
    const std::int32_t u = random_between(random, -kSpokeLength / 8, kSpokeLength / 8);
    const GridVector normal = frame.combined(kSpokeLength, t, u);
    const Span64 span = extent_along(whole, normal);
    const std::int64_t hit = clamp(dot(normal, fine(impact)), span.low, span.high);
    const std::int64_t even = place_between(span, k, pattern.across, random);
    if (shards.cut(rest, {normal, even + (hit - even) / 2})) rest = shards.shards.size() - 1;
  }
}

}  // namespace

void shatter_boxes(FractureShards& shards, const FractureImpact& impact) {
  const GridPoint centre = middle_of_blow(box_of(shards.shards[0].hull), impact);
  for (const GridVector axis : {GridVector{1, 0, 0}, GridVector{0, 1, 0}, GridVector{0, 0, 1}}) {
    const std::size_t count = shards.shards.size();
    for (std::size_t i = 0; i < count; ++i) shards.cut(i, plane_through(centre, axis));
  }
}

void shatter_grain(FractureShards& shards, const GrainPlanes& pattern, const FractureImpact& impact, Pcg32 random) {
  const Frame3 frame = frame_along(pattern.grain);
  const GridVector normal = frame.spoke(random.next());
  const Span64 span = extent_along(shards.shards[0].cell, normal);
  for (std::uint32_t k = 0; k < pattern.along; ++k) {
    const FinePlane plane = {normal, place_between(span, k, pattern.along, random)};
    const std::size_t count = shards.shards.size();
    for (std::size_t i = 0; i < count; ++i) shards.cut(i, plane);
  }
  const std::size_t boards = shards.shards.size();
  for (std::size_t i = 0; i < boards; ++i) cut_board(shards, i, pattern, frame, impact.point, random);
}

}  // namespace isostep::detail
