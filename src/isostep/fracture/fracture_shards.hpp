// FractureShards: the pieces of a solid while a pattern cuts it, and the one rule for pieces that are too small.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "fracture_cell.hpp"
#include "isostep/core/random.hpp"
#include "isostep/fracture/fracture.hpp"

namespace isostep::detail {

struct FractureShard {
  FractureCell cell;
  ConvexHull hull;                 // of its rounded corners
  std::uint32_t from = 0, to = 0;  // [2^-32 turns] RadialCracks: the sector that it lies in

  ISO_INLINE FractureShard() = default;
  ISO_INLINE FractureShard(const FractureShard&) = default;
  ISO_INLINE FractureShard(FractureShard&&) = default;
  ISO_INLINE FractureShard& operator=(const FractureShard&) = default;
  ISO_INLINE FractureShard& operator=(FractureShard&&) = default;
  ISO_INLINE ~FractureShard() = default;
};

/// Starts with the solid as one shard.
class FractureShards {
 public:
  FractureShards(const ConvexHull& solid, std::int64_t least_width);
  ISO_INLINE FractureShards(const FractureShards&) = default;
  ISO_INLINE ~FractureShards() = default;

  std::vector<FractureShard> shards;
  std::uint32_t refused = 0;

  /// A shard keeps what lies inside of the plane; the rest becomes the last shard, with the same sector. False: the
  /// plane misses the shard, or one side would be too small, which is counted.
  bool cut(std::size_t shard, const FinePlane& plane);
  /// The hull of a cell's rounded corners; false: it is too small, flat or has too many corners for one.
  bool bake(const FractureCell& cell, ConvexHull& hull) const;

 private:
  std::int64_t least_width_;  // [steps]
};

/// [steps] The least of a hull's widths along the axes and of its depths below its faces, rounded down.
std::int64_t least_width_of(const ConvexHull& hull);
/// A hull's box.
struct HullBox {
  GridPoint low, high;  // [steps]
};
HullBox box_of(const ConvexHull& hull);

// One function a pattern; see fracture_pattern.hpp. Arguments are valid.
void shatter_boxes(FractureShards& shards, const FractureImpact& impact);
void shatter_grain(FractureShards& shards, const GrainPlanes& pattern, const FractureImpact& impact, Pcg32 random);
void shatter_radial(FractureShards& shards, const RadialCracks& pattern, const FractureImpact& impact, Pcg32 random);
void shatter_voronoi(FractureShards& shards, const VoronoiCells& pattern, const FractureImpact& impact, Pcg32 random);

}  // namespace isostep::detail
