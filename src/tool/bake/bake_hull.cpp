// Polygons' corners into a convex hull.
// SPDX-License-Identifier: MIT
#include "baked.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::tool::bake {
namespace {

std::vector<GridPoint> grid_points(const Placed& source, int exponent) {
  std::vector<GridPoint> points;
  for (const std::vector<Vec3<double>>& face : source.corners) {
    for (const Vec3<double>& p : face) points.push_back(rounded<GridPoint>(p, exponent));
  }
  return points;
}

std::string said(const Error& error) { return std::string(error.message.view()); }

/// [m] The largest distance of a point outside of a face's plane.
double outside(const std::vector<GridPoint>& points, const GridHull& hull) {
  double most = 0;
  for (std::uint8_t f = 0; f < hull.hull.faces.size(); ++f) {
    const GridVector n = hull.hull.normal(f);
    const GridPoint on = hull.hull.vertices[hull.hull.half_edges[hull.hull.faces[f]].origin];
    const double x = static_cast<double>(n.x), y = static_cast<double>(n.y), z = static_cast<double>(n.z);
    const double unit = 1 / sqrt(x * x + y * y + z * z);
    for (const GridPoint& p : points) {
      const GridVector d = p - on;
      most = max(most,
                 unit * (x * static_cast<double>(d.x) + y * static_cast<double>(d.y) + z * static_cast<double>(d.z)));
    }
  }
  return most * from_lattice<double>(1, hull.exponent);
}

}  // namespace

Baked bake_hull(const SourceMesh& source, const BakeOptions& options) {
  const Placed chosen = placed(source, options);
  Baked baked = {};
  baked.exponent = exponent_for(chosen.most, GridPoint::kLimit, GridHull::kFinest, options);
  const std::vector<GridPoint> all = grid_points(chosen, baked.exponent);
  std::vector<GridPoint> points = all;
  if (options.points > 0) {
    const auto fewer = simplified(all, static_cast<std::uint32_t>(options.points));
    if (!fewer.ok()) fail(options, said(fewer.error()));
    points = fewer.value();
  }
  const Result<BlobRef> blob = hull_blob(points, baked.exponent);
  if (!blob.ok())
    fail(options, said(blob.error()) + (blob.error().code == ErrorCode::limit
                                            ? " (--points N takes the N that reach furthest; 44 always fit)"
                                            : ""));
  baked.blob = blob.value();
  const Result<GridHull> hull = read_hull(baked.blob->bytes());
  baked.outside = outside(all, hull.value());
  baked.counts = {{"faces", hull.value().hull.faces.size()},
                  {"edges", hull.value().hull.half_edges.size() / 2},
                  {"vertices", hull.value().hull.vertices.size()}};
  return baked;
}

}  // namespace isostep::tool::bake
