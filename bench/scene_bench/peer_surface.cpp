// Surfaces of peers, read from the blobs of ours.
// SPDX-License-Identifier: MIT
#include "peer_surface.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "scenes/surface_points.hpp"

namespace isostep::bench {
namespace {

using scenes::SceneError;

template <class Surface> void require_plain(const Surface& surface) {
  if (!surface.table().empty()) throw SceneError("", "peers are given no friction by triangle");
  for (std::uint32_t id = 0; id < surface.triangle_count(); ++id) {
    if (!surface.has_triangle(id)) throw SceneError("", "peers are given no surfaces with holes");
  }
}

PeerSurface surface_of(const TriangleMesh& mesh) {
  require_plain(mesh);
  PeerSurface made;
  const double step = std::ldexp(1.0, -mesh.exponent());
  for (const MeshPoint p : mesh.points()) {
    made.points.push_back(Vec3<double>{double(p.x), double(p.y), double(p.z)} * step);
  }
  for (const MeshTriangle& triangle : mesh.triangles()) {
    made.corners.insert(made.corners.end(), std::begin(triangle.vertices), std::end(triangle.vertices));
  }
  return made;
}

PeerSurface surface_of(const BakedHeightField& field) {
  require_plain(field);
  PeerSurface made;
  const HeightGrid& grid = field.grid();
  const double step = std::ldexp(1.0, -field.exponent());
  const double height = std::ldexp(step, static_cast<int>(grid.height_shift));
  made.columns = grid.columns;
  made.rows = grid.rows;
  made.pitch = grid.pitch * step;
  for (const std::int16_t h : field.heights()) made.heights.push_back(h * height);
  return made;
}

template <class Read> std::shared_ptr<const PeerSurface> read_surface(const Read& read) {
  if (!read.ok()) throw SceneError("", "the surface cannot be read");
  return std::make_shared<const PeerSurface>(surface_of(read.value()));
}

}  // namespace

double PeerSurface::highest() const {
  double most = 0;
  for (const double h : heights) most = std::max(most, std::abs(h));
  return most;
}

std::shared_ptr<const PeerSurface> peer_surface(const scenes::ScenePart& part) {
  if (part.type == ShapeType::mesh) {
    return read_surface(read_triangle_mesh(scenes::mesh_of_part(part, "peer")->bytes()));
  }
  return read_surface(read_height_field(scenes::height_field_of_part(part, "peer")->bytes()));
}

}  // namespace isostep::bench
