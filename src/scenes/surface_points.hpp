// The meshes and height fields of scenes: from the numbers that a file has to a blob, and from a blob to what judges
// measure.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "isostep/geometry/blob.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// The blob of a part's numbers, or of its baked file. These throw SceneError.
BlobRef mesh_of_part(const ScenePart& part, const std::string& place);
BlobRef height_field_of_part(const ScenePart& part, const std::string& place);

/// A surface in double, from its exact points: judges do not ask the engine that they judge.
struct SolidSurface {
  using Triangle = std::array<Vec3<double>, 3>;

  std::vector<Triangle> triangles;                                // [m]
  std::map<std::pair<int, int>, std::vector<std::size_t>> cells;  // by x and z, 1 m wide: triangles that meet them

  /// The triangles whose x and z are within `reach` [m] of a point, each once.
  std::vector<std::size_t> near(Vec3<double> p, double reach) const;
};
/// The surface of a mesh's or height field's blob.
std::shared_ptr<const SolidSurface> solid_surface(const Blob& blob);

}  // namespace isostep::scenes
