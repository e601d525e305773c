// The common part of meshes and hulls: the chosen faces, the units and axes, the grid.
// SPDX-License-Identifier: MIT
#include "baked.hpp"
#include "isostep/geometry/baked/mesh_point.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/math.hpp"
#include "isostep/scalar/text.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::bake {

void fail(const BakeOptions& options, const std::string& message) {
  throw ToolError(exit_status::kUsage, options.file + ": " + message);
}

namespace {

[[noreturn]] void fail_without_faces(const SourceMesh& source, const BakeOptions& options) {
  if (source.faces.empty()) fail(options, "expected triangles or other faces, found none");
  std::string names;
  for (const std::string& name : source.objects) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  fail(options, "no face is of an object \"" + options.object + "\"; the objects are " + names);
}

}  // namespace

Placed placed(const SourceMesh& source, const BakeOptions& options) {
  Placed chosen = {{}, {}, 0};
  for (const SourceFace& face : source.faces) {
    if (!options.object.empty() && source.objects[face.object] != options.object) continue;
    chosen.faces.push_back(face);
    std::vector<Vec3<double>>& corners = chosen.corners.emplace_back();
    for (std::size_t i = face.first; i < face.first + face.count; ++i) {
      const Vec3<double> p = source.points[source.corners[i]] * options.scale;
      if (!is_finite(p))
        fail(options, "vertex " + std::to_string(source.corners[i]) + " has a coordinate that is not finite");
      corners.push_back(options.up == "z" ? Vec3<double>{p.x, p.z, -p.y} : p);
      chosen.most = max(chosen.most, max_abs(p));
    }
  }
  if (chosen.faces.empty()) fail_without_faces(source, options);
  return chosen;
}

int exponent_for(double most, std::int64_t limit, int finest, const BakeOptions& options) {
  const int asked = options.exponent < 0 ? finest : options.exponent;
  const int exponent = most < static_cast<double>(limit) ? finest_lattice(most, limit, asked) : -1;
  if (exponent >= 0 && (options.exponent < 0 || exponent == asked)) return exponent;
  const std::string widest = std::to_string((limit - 1) >> (options.exponent < 0 ? 0 : options.exponent));
  fail(options, "a coordinate of " + to_text(most) + " m, expected " + widest + " m at most" +
                    (options.exponent < 0 ? "" : " with this exponent"));
}

template <class Point> Point rounded(const Vec3<double>& p, int exponent) {
  const auto steps = [&](double v) { return static_cast<std::int32_t>(nearest_scaled(v, exponent)); };
  return {steps(p.x), steps(p.y), steps(p.z)};
}
template MeshPoint rounded<MeshPoint>(const Vec3<double>&, int);
template GridPoint rounded<GridPoint>(const Vec3<double>&, int);

}  // namespace isostep::tool::bake
