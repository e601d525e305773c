// Instances of hulls and meshes.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/instance.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"

namespace isostep {
namespace {

constexpr int kMostDoublings = 64;  // beyond it no point but 0 has an instance

/// Points on their grid; both kinds of points have a limit and coordinates that may be exact multiples.
template <class Point> struct PointGrid {
  std::vector<Point> points;
  int exponent;  // a step is 2^-exponent m

  /// Doubles all points, or the step where they do not fit. Returns false where both end.
  bool double_all() {
    const auto fits = [](std::int32_t v) { return 2 * std::abs(v) < Point::kLimit; };
    const bool all =
        std::all_of(points.begin(), points.end(), [&](Point p) { return fits(p.x) && fits(p.y) && fits(p.z); });
    if (!all) return --exponent >= 0;
    for (Point& p : points) p = {2 * p.x, 2 * p.y, 2 * p.z};
    return true;
  }
  /// Halves the step, or at the finest one all points. Returns false where a point falls between the steps.
  bool halve_all() {
    if (exponent < GridHull::kFinest) {
      ++exponent;
      return true;
    }
    for (Point& p : points) {
      if (p.x % 2 != 0 || p.y % 2 != 0 || p.z % 2 != 0) return false;
      p = {p.x / 2, p.y / 2, p.z / 2};
    }
    return true;
  }
};
static_assert(GridHull::kFinest == TriangleMesh::kMaxExponent);

template <class Point> Result<void> change(PointGrid<Point>& grid, const Instance& instance) {
  for (Point& p : grid.points) {
    p = {instance.mirror_x ? -p.x : p.x, instance.mirror_y ? -p.y : p.y, instance.mirror_z ? -p.z : p.z};
  }
  bool fits = std::abs(instance.doublings) <= kMostDoublings;
  for (int i = 0; fits && i < instance.doublings; ++i) fits = grid.double_all();
  for (int i = 0; fits && i < -instance.doublings; ++i) fits = grid.halve_all();
  if (fits) return {};
  return Error{ErrorCode::invalid, "a point leaves the range, or falls between steps of 2^-16 m", "doublings"};
}

Result<BlobRef> hull_instance(const Blob& blob, const Instance& instance, BlobHome home) {
  const Result<GridHull> hull = read_hull(blob.bytes());
  if (!hull.ok()) return hull.error();
  PointGrid<GridPoint> grid = {hull.value().hull.vertices, hull.value().exponent};
  const Result<void> changed = change(grid, instance);
  if (!changed.ok()) return changed.error();
  return hull_blob(grid.points, grid.exponent, home);
}

Result<BlobRef> mesh_instance(const Blob& blob, const Instance& instance, BlobHome home) {
  const Result<TriangleMesh> mesh = read_triangle_mesh(blob.bytes());
  if (!mesh.ok()) return mesh.error();
  const TriangleMesh& from = mesh.value();
  PointGrid<MeshPoint> grid = {{from.points().begin(), from.points().end()}, from.exponent()};
  const Result<void> changed = change(grid, instance);
  if (!changed.ok()) return changed.error();
  std::vector<MeshTriangle> triangles(from.triangles().begin(), from.triangles().end());
  if ((instance.mirror_x != instance.mirror_y) != instance.mirror_z) {
    for (MeshTriangle& triangle : triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
  const SurfaceMaterials materials = {from.materials(), from.table()};
  const Result<TriangleMesh> made = triangle_mesh(grid.points, triangles, materials, grid.exponent);
  if (!made.ok()) return made.error();
  return mesh_blob(made.value(), home);
}

}  // namespace

Result<BlobRef> instance_of(const Blob& blob, const Instance& instance, BlobHome home) {
  if (blob.type() == ShapeType::hull) return hull_instance(blob, instance, home);
  if (blob.type() == ShapeType::mesh) return mesh_instance(blob, instance, home);
  return Error{ErrorCode::invalid, "instances are of hulls and meshes", "type"};
}

}  // namespace isostep
