// Meshes and height fields as peers are given them: doubles, from the exact points that ours has.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/math/vec3.hpp"
#include "scenes/scene.hpp"

namespace isostep::bench {

/// One of the two; the other's vectors are empty.
struct PeerSurface {
  std::vector<Vec3<double>> points;    // [m] of a mesh
  std::vector<std::uint32_t> corners;  // three of `points` a triangle, counter-clockwise seen from outside

  std::uint32_t columns = 0, rows = 0;  // of a height field's places
  double pitch = 0;                     // [m] between them
  std::vector<double> heights;          // [m] by rows: column i is at x = i pitch, row k at z = k pitch

  /// [m] The place by which peers hold a height field: its middle in x and z, at height 0.
  Vec3<double> middle() const { return {(columns - 1.0) * pitch / 2, 0, (rows - 1.0) * pitch / 2}; }
  /// [m] The largest height, either way.
  double highest() const;
};

/// The surface of a part that is a mesh or a height field. Throws SceneError with the reason where peers cannot be
/// told: holes, and friction by triangle.
std::shared_ptr<const PeerSurface> peer_surface(const scenes::ScenePart& part);

}  // namespace isostep::bench
