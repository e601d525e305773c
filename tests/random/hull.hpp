// Hulls for random worlds of any kind.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Draws a hull of up to fifteen points in a box of half extents `half`. Four of them are the corners of a tetrahedron:
/// it is never flat. `source` has below(n) and point(reach).
template <class Source> BlobRef draw_hull(Source& source, D3 half) {
  std::vector<D3> points = {
      {half.x, half.y, half.z}, {-half.x, -half.y, half.z}, {-half.x, half.y, -half.z}, {half.x, -half.y, -half.z}};
  for (std::uint32_t more = 4 + source.below(8); more > 0; --more) {
    const D3 at = source.point(1);
    points.push_back({half.x * at.x, half.y * at.y, half.z * at.z});
  }
  return hull_blob(std::span<const D3>(points)).value();
}

/// A hull with a radius [m] in a world.
template <class S> ShapeId add_hull(World<S>& world, const BlobRef& blob, double radius) {
  const Child<S> part = {primitive_of(Hull<S>{1, num<S>(radius)}), Pose<S>::identity()};
  return world.add_shape(std::span<const Child<S>>(&part, 1), std::span<const BlobRef>(&blob, 1));
}

}  // namespace isostep::test
