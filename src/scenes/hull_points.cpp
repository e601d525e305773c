// Hulls of points, and their volumes by signed tetrahedra.
// SPDX-License-Identifier: MIT
#include "hull_points.hpp"

#include <limits>

#include "build.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::scenes {
namespace {

using V = Vec3<double>;

/// Sums over tetrahedra from the first vertex, which then is taken off again.
void add_mass(SolidHull& hull) {
  const V origin = hull.vertices[0];
  double six_volumes = 0;
  V first = {0, 0, 0};
  Mat3<double> second = Mat3<double>::diagonal({0, 0, 0});
  for (const auto& t : hull.triangles) {
    const V p[3] = {t[0] - origin, t[1] - origin, t[2] - origin}, sum = p[0] + p[1] + p[2];
    const double d = dot(cross(p[0], p[1]), p[2]);
    six_volumes += d;
    first += sum * d;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        second.rows[i][k] += d * (sum[i] * sum[k] + p[0][i] * p[0][k] + p[1][i] * p[1][k] + p[2][i] * p[2][k]);
    }
  }
  const V mean = first * (1 / (4 * six_volumes));
  hull.volume = six_volumes / 6;
  hull.centre = origin + mean;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) hull.moments.rows[i][k] = second.rows[i][k] / (20 * six_volumes) - mean[i] * mean[k];
  }
}

}  // namespace

BlobRef hull_of_part(const ScenePart& part, const std::string& place) {
  if (part.blob != nullptr) return part.blob;
  const std::vector<Vector>& points = part.points;
  std::vector<V> numbers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string at = place + "/points/" + std::to_string(i) + "/";
    numbers.push_back({value_of<double>(points[i][0], at + "0"), value_of<double>(points[i][1], at + "1"),
                       value_of<double>(points[i][2], at + "2")});
  }
  const Result<BlobRef> hull = hull_blob(std::span<const V>(numbers));
  if (!hull.ok()) throw SceneError(place + "/points", std::string(hull.error().message.view()));
  return hull.value();
}

std::shared_ptr<const SolidHull> solid_hull(const Blob& blob) {
  const Result<GridHull> read = read_hull(blob.bytes());
  if (!read.ok()) return nullptr;
  const ConvexHull& grid = read.value().hull;
  const auto hull = std::make_shared<SolidHull>();
  const double step = from_lattice<double>(1, read.value().exponent);
  for (const GridPoint p : grid.vertices) hull->vertices.push_back(V{double(p.x), double(p.y), double(p.z)} * step);
  for (std::size_t e = 0; e < grid.half_edges.size(); e += 2)
    hull->edges.push_back({hull->vertices[grid.half_edges[e].origin], hull->vertices[grid.half_edges[e + 1].origin]});
  for (std::size_t f = 0; f < grid.faces.size(); ++f) {
    const GridVector n = grid.normal(static_cast<std::uint8_t>(f));
    const V normal = {double(n.x), double(n.y), double(n.z)};
    hull->normals.push_back(normal * (1 / sqrt(dot(normal, normal))));
    const auto at = [&](std::uint8_t e) { return hull->vertices[grid.half_edges[e].origin]; };
    std::uint8_t edge = grid.half_edges[grid.faces[f]].next;
    for (std::uint8_t next = grid.half_edges[edge].next; next != grid.faces[f]; next = grid.half_edges[next].next) {
      hull->triangles.push_back({at(grid.faces[f]), at(edge), at(next)});
      edge = next;
    }
  }
  add_mass(*hull);
  hull->inner_radius = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < hull->normals.size(); ++f) {
    const V on_face = hull->vertices[grid.half_edges[grid.faces[f]].origin];
    hull->inner_radius = min(hull->inner_radius, dot(hull->normals[f], on_face - hull->centre));
  }
  return hull;
}

StretchedHull stretched(const SolidHull& hull, double radius) {
  V low = hull.vertices[0], high = low;
  for (const V v : hull.vertices) low = min(low, v), high = max(high, v);
  StretchedHull result = {hull.volume, hull.moments};
  double by[3];
  for (int i = 0; i < 3; ++i) {
    by[i] = 1 + 2 * radius / (high[i] - low[i]);
    result.volume *= by[i];
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) result.moments.rows[i][k] *= by[i] * by[k];
  }
  return result;
}

}  // namespace isostep::scenes
