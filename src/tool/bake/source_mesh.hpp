// SourceMesh: the polygons of a file, whatever its format, and who reads which.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isostep/math/vec3.hpp"

namespace isostep::tool::bake {

/// A polygon, counter-clockwise seen from outside.
struct SourceFace {
  std::size_t first, count;  // of SourceMesh::corners
  std::uint32_t material;    // of SourceMesh::materials
  std::uint32_t object;      // of SourceMesh::objects
};

/// A mesh in the file's units and axes, with the transforms of its nodes.
struct SourceMesh {
  std::vector<Vec3<double>> points;
  std::vector<std::uint32_t> corners;  // points of the faces, one face after another
  std::vector<SourceFace> faces;       // of three corners or more
  std::vector<std::string> objects, materials;
  std::size_t bare = 0;  // lines and single points, which have no area and are left out
};

/// Reads by the file's ending: OBJ by tinyobjloader, all else by assimp. Throws ToolError: 66 for a file that cannot be
/// read, 69 where the library is missing, 64 for what is wrong in the file.
SourceMesh read_source(const std::string& path);

// Those that read_source chooses from.
SourceMesh read_obj(const std::string& path);
SourceMesh read_by_assimp(const std::string& path);

/// The place of a name in a list, at its end if it is new.
std::uint32_t place_of(const std::string& name, std::vector<std::string>& names);

}  // namespace isostep::tool::bake
