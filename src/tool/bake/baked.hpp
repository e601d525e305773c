// Polygons into a blob: rounded to the grid, cut into triangles or wrapped into a hull; and what was left out.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "isostep/geometry/blob.hpp"
#include "source_mesh.hpp"

namespace isostep::tool::bake {

struct Baked {
  BlobRef blob;
  int exponent;                                               // a step is 2^-exponent m
  std::vector<std::pair<const char*, std::size_t>> counts;    // "triangles", ...
  std::vector<std::pair<const char*, std::size_t>> left_out;  // likewise; 0 where nothing is
  double outside = 0;  // [m] how far the furthest point of the file is outside of a hull of fewer points
};

// Throw ToolError 64, which names the file.
Baked bake_mesh(const SourceMesh& source, const BakeOptions& options);
Baked bake_hull(const SourceMesh& source, const BakeOptions& options);

/// The faces that the options choose, in metres, y up.
struct Placed {
  std::vector<SourceFace> faces;
  std::vector<std::vector<Vec3<double>>> corners;  // [m] of each face
  double most;                                     // [m] of all coordinates
};
/// Throws when there are no faces, or a coordinate is not finite.
Placed placed(const SourceMesh& source, const BakeOptions& options);

/// That of the options, or the finest; coordinates are below `limit` steps. Throws when they cannot be.
int exponent_for(double most, std::int64_t limit, int finest, const BakeOptions& options);
/// The point in steps.
template <class Point> Point rounded(const Vec3<double>& p, int exponent);

[[noreturn]] void fail(const BakeOptions& options, const std::string& message);

}  // namespace isostep::tool::bake
