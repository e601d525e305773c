// The parts of a triangle mesh: distinct points, and edges with what is across them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/result.hpp"
#include "isostep/geometry/baked/triangle_mesh.hpp"

namespace isostep {

struct WeldedMesh {
  std::vector<MeshPoint> points;        // distinct, in the order in which the triangles first name them
  std::vector<MeshTriangle> triangles;  // as they came, of those points

  // These are what the compiler would make, but without weak functions in two files.
  ISO_INLINE WeldedMesh() = default;
  ISO_INLINE WeldedMesh(const WeldedMesh&) = default;
  ISO_INLINE WeldedMesh(WeldedMesh&&) = default;
  ISO_INLINE WeldedMesh& operator=(const WeldedMesh&) = default;
  ISO_INLINE WeldedMesh& operator=(WeldedMesh&&) = default;
  ISO_INLINE ~WeldedMesh() = default;
};
/// Makes points with equal coordinates one. Vertices must be points.
WeldedMesh weld(std::span<const MeshPoint> points, std::span<const MeshTriangle> triangles);

/// Finds the edges of each triangle. Errors: see triangle_mesh.
Result<std::vector<MeshEdges>> find_edges(const WeldedMesh& mesh);

}  // namespace isostep
