// Polygons into a triangle mesh.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>

#include "baked.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "tool/common/tool.hpp"
#include "triangulate.hpp"

namespace isostep::tool::bake {
namespace {

/// The triangles in the order of the file.
struct Triangles {
  std::vector<MeshPoint> points;  // three of each
  std::vector<std::uint32_t> faces;
  std::size_t size() const { return faces.size(); }
  void add(const MeshPoint* corners, std::uint32_t face) {
    points.insert(points.end(), corners, corners + 3);
    faces.push_back(face);
  }
};

Triangles cut(const Placed& source, int exponent) {
  Triangles triangles;
  for (std::uint32_t f = 0; f < source.faces.size(); ++f) {
    stop_if_interrupted();
    for (const auto& corners : triangulated(source.corners[f])) {
      MeshPoint points[3];
      for (std::size_t k = 0; k < 3; ++k) points[k] = rounded<MeshPoint>(source.corners[f][corners[k]], exponent);
      triangles.add(points, f);
    }
  }
  return triangles;
}

/// The triangle has an area on the grid.
bool has_area(const MeshPoint* p) { return !(cross(p[1] - p[0], p[2] - p[0]) == GridVector{0, 0, 0}); }

/// Two that turn the same way through the same points are equal, whichever comes first.
std::array<std::int32_t, 9> key_of(const MeshPoint* p) {
  using Corner = std::array<std::int32_t, 3>;
  std::array<Corner, 3> corners = {Corner{p[0].x, p[0].y, p[0].z}, Corner{p[1].x, p[1].y, p[1].z},
                                   Corner{p[2].x, p[2].y, p[2].z}};
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  std::array<std::int32_t, 9> key;
  for (std::size_t i = 0; i < 9; ++i) key[i] = corners[i / 3][i % 3];
  return key;
}
/// A triangle repeats an equal one: the first remains.
std::vector<bool> is_repeated(const Triangles& triangles) {
  std::vector<std::pair<std::array<std::int32_t, 9>, std::size_t>> sorted;
  for (std::size_t i = 0; i < triangles.size(); ++i) sorted.push_back({key_of(&triangles.points[3 * i]), i});
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> repeated(triangles.size(), false);
  for (std::size_t i = 1; i < sorted.size(); ++i) repeated[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  return repeated;
}

Triangles without_faults(const Triangles& all, Baked& baked) {
  const std::vector<bool> repeated = is_repeated(all);
  Triangles kept;
  std::size_t flat = 0, twice = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!has_area(&all.points[3 * i])) ++flat;
    else if (repeated[i]) ++twice;
    else kept.add(&all.points[3 * i], all.faces[i]);
  }
  baked.left_out = {{"triangles without area", flat}, {"triangles that were there already", twice}};
  return kept;
}

std::vector<std::uint8_t> materials_of(const Triangles& triangles, const Placed& source, const BakeOptions& options) {
  std::vector<std::uint8_t> materials;
  for (const std::uint32_t face : triangles.faces) {
    const std::uint32_t material = source.faces[face].material;
    if (material > 255)
      fail(options,
           "face " + std::to_string(face) + " has material " + std::to_string(material) + ", expected 0 to 255");
    materials.push_back(static_cast<std::uint8_t>(material));
  }
  return materials;
}

/// Fails with the place of the triangle, for whoever looks for it in a modeller.
[[noreturn]] void fail_mesh(const Error& error, const Triangles& triangles, const SourceMesh& source,
                            const Placed& placed, const BakeOptions& options) {
  std::string text = std::string(error.place.view()) + ": " + std::string(error.message.view());
  unsigned long i = 0;
  if (std::sscanf(text.c_str(), "triangles[%lu]", &i) == 1 && i < triangles.size()) {
    const std::uint32_t face = triangles.faces[i];
    const Vec3<double> at = placed.corners[face][0];
    char where[160];
    std::snprintf(where, sizeof where, " (a corner of its face is at %g %g %g m)", at.x, at.y, at.z);
    text += " in object \"" + source.objects[placed.faces[face].object] + "\"" + where;
  }
  fail(options, text);
}

}  // namespace

Baked bake_mesh(const SourceMesh& source, const BakeOptions& options) {
  const Placed chosen = placed(source, options);
  Baked baked = {};
  baked.exponent = exponent_for(chosen.most, MeshPoint::kLimit, TriangleMesh::kMaxExponent, options);
  const Triangles triangles = without_faults(cut(chosen, baked.exponent), baked);
  if (triangles.size() == 0) fail(options, "expected triangles, found none that has an area");
  std::vector<MeshTriangle> corners;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) corners.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  const Result<TriangleMesh> mesh =
      triangle_mesh(triangles.points, corners, materials_of(triangles, chosen, options), baked.exponent);
  if (!mesh.ok()) fail_mesh(mesh.error(), triangles, source, chosen, options);
  baked.blob = mesh_blob(mesh.value());
  baked.counts = {{"triangles", triangles.size()}, {"vertices", mesh.value().points().size()}};
  return baked;
}

}  // namespace isostep::tool::bake
