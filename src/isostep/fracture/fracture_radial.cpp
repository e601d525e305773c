// The cracks of glass: sectors about the line of a blow, and chords across them.
// SPDX-License-Identifier: MIT
#include "fracture_directions.hpp"
#include "fracture_shards.hpp"

namespace isostep::detail {
namespace {

/// The plane that holds the line and a spoke; what comes before the spoke, within half a turn, is inside.
FinePlane plane_of_spoke(const Frame3& frame, GridPoint centre, std::uint32_t turn) {
  return plane_through(centre, frame.spoke(turn + kQuarterCircle));
}

/// More of a shard lies in the half turn after `turn` than before.
bool lies_after(const FractureShard& shard, const FinePlane& plane) {
  const Span64 span = extent_along(shard.cell, plane.normal);
  return span.high - plane.offset > plane.offset - span.low;
}

/// Cuts a shard that spans half a turn from `start` into `parts` sectors.
void cut_sectors(FractureShards& shards, std::size_t shard, const Frame3& frame, GridPoint centre, std::uint32_t start,
                 std::uint32_t parts, Pcg32& random) {
  const std::uint32_t width = kHalfCircle / parts;
  shards.shards[shard].from = start;
  shards.shards[shard].to = start + kHalfCircle;
  std::size_t rest = shard;
  for (std::uint32_t k = 1; k < parts; ++k) {
    const std::uint32_t shift = random_below(random, width / 2);
    const std::uint32_t turn = start + width * k - width / 4 + shift;
    if (!shards.cut(rest, plane_of_spoke(frame, centre, turn))) continue;
    shards.shards[rest].to = turn;
    rest = shards.shards.size() - 1;
    shards.shards[rest].from = turn;
  }
}

GridVector middle_direction(const Frame3& frame, const FractureShard& shard) {
  return frame.spoke(shard.from + (shard.to - shard.from) / 2);
}

/// Chords of rings 1 to n at (k / (n + 1))^2 of the way to the furthest corner, moved by up to a quarter of that step.
void cut_rings(FractureShards& shards, const Frame3& frame, GridPoint centre, std::uint32_t rings, Pcg32& random) {
  std::int64_t furthest = 0;  // [fine steps times kSpokeLength]
  for (const FractureShard& shard : shards.shards) {
    const FinePlane middle = plane_through(centre, middle_direction(frame, shard));
    furthest = max(furthest, extent_along(shard.cell, middle.normal).high - middle.offset);
  }
  const std::size_t sectors = shards.shards.size();
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < sectors; ++i) rest.push_back(i);
  for (std::uint32_t k = 1; k <= rings; ++k) {
    const std::int64_t shift = random_between(random, -(1 << 14), 1 << 14);
    const std::int64_t at = (std::int64_t{k} << 16) + shift, all = std::int64_t{rings + 1} << 16;  // [2^-16 rings]
    const std::int64_t distance = nearest_quotient(Int128(furthest) * (at * at), all * all);
    for (std::size_t& shard : rest) {
      FinePlane chord = plane_through(centre, middle_direction(frame, shards.shards[shard]));
      chord.offset += distance;
      if (shards.cut(shard, chord)) shard = shards.shards.size() - 1;
    }
  }
}

}  // namespace

void shatter_radial(FractureShards& shards, const RadialCracks& pattern, const FractureImpact& impact, Pcg32 random) {
  const Frame3 frame = frame_along(impact.direction);
  const std::uint32_t start = random.next(), first = pattern.sectors / 2;
  const FinePlane plane = plane_of_spoke(frame, impact.point, start);
  if (shards.cut(0, plane)) {
    cut_sectors(shards, 1, frame, impact.point, start, first, random);
    cut_sectors(shards, 0, frame, impact.point, start + kHalfCircle, pattern.sectors - first, random);
  } else {
    const bool after = lies_after(shards.shards[0], plane);
    const std::uint32_t parts = after ? first : pattern.sectors - first;
    cut_sectors(shards, 0, frame, impact.point, after ? start : start + kHalfCircle, parts, random);
  }
  cut_rings(shards, frame, impact.point, pattern.rings, random);
}

}  // namespace isostep::detail
