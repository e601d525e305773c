// Surfaces of numbers.
// SPDX-License-Identifier: MIT
#include "surface_points.hpp"

#include <algorithm>
#include <cmath>

#include "build.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"

namespace isostep::scenes {
namespace {

using V = Vec3<double>;

std::uint32_t count_of(const Number& number, double most, const std::string& place) {
  const double value = value_of<double>(number, place);
  if (!(value >= 0 && value <= most) || value != std::floor(value))
    throw SceneError(place, "expected a whole number from 0 to " + std::to_string(static_cast<long long>(most)) +
                                ", found " + number.text());
  return static_cast<std::uint32_t>(value);
}
std::vector<std::uint8_t> materials_of(const ScenePart& part, const std::string& place) {
  std::vector<std::uint8_t> materials;
  for (std::size_t i = 0; i < part.materials.size(); ++i) {
    materials.push_back(
        static_cast<std::uint8_t>(count_of(part.materials[i], 255, place + "/materials/" + std::to_string(i))));
  }
  return materials;
}
std::vector<SurfaceMaterial> table_of(const ScenePart& part, const std::string& place) {
  std::vector<SurfaceMaterial> table;
  for (std::size_t i = 0; i < part.surfaces.size(); ++i) {
    const std::string at = place + "/surfaces/" + std::to_string(i);
    const auto material = surface_material(value_of<double>(part.surfaces[i].friction, at + "/friction"),
                                           value_of<double>(part.surfaces[i].restitution, at + "/restitution"));
    if (!material.ok()) throw SceneError(at, std::string(material.error().message.view()));
    table.push_back(material.value());
  }
  return table;
}
BlobRef checked(const Result<BlobRef>& blob, const std::string& place) {
  if (!blob.ok()) throw SceneError(place, std::string(blob.error().message.view()));
  return blob.value();
}

template <class G> void take_triangles(const G& surface, SolidSurface& solid) {
  const double step = std::ldexp(1.0, -surface.exponent());
  for (std::uint32_t id = 0; id < surface.triangle_count(); ++id) {
    if (!surface.has_triangle(id)) continue;
    const BakedTriangle baked = surface.triangle(id);
    SolidSurface::Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshPoint p = baked.points[i];
      triangle[i] = V{double(p.x), double(p.y), double(p.z)} * step;
    }
    solid.triangles.push_back(triangle);
  }
}
int cell_of(double metres) { return static_cast<int>(std::floor(metres)); }

}  // namespace

BlobRef mesh_of_part(const ScenePart& part, const std::string& place) {
  if (part.blob != nullptr) return part.blob;
  std::vector<V> points;
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const std::string at = place + "/vertices/" + std::to_string(i) + "/";
    const Vector& v = part.vertices[i];
    points.push_back(
        {value_of<double>(v[0], at + "0"), value_of<double>(v[1], at + "1"), value_of<double>(v[2], at + "2")});
  }
  std::vector<MeshTriangle> triangles;
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    const std::string at = place + "/triangles/" + std::to_string(i) + "/";
    const Vector& t = part.triangles[i];
    MeshTriangle triangle = {};
    for (std::size_t k = 0; k < 3; ++k) triangle.vertices[k] = count_of(t[k], 0xffffffffu, at + std::to_string(k));
    triangles.push_back(triangle);
  }
  return checked(mesh_blob(points, triangles, {materials_of(part, place), table_of(part, place)}), place);
}

BlobRef height_field_of_part(const ScenePart& part, const std::string& place) {
  if (part.blob != nullptr) return part.blob;
  const HeightSheet sheet = {count_of(part.columns, 0xffffffffu, place + "/columns"),
                             count_of(part.rows, 0xffffffffu, place + "/rows"),
                             value_of<double>(part.pitch, place + "/pitch")};
  std::vector<double> heights;
  for (std::size_t i = 0; i < part.heights.size(); ++i)
    heights.push_back(value_of<double>(part.heights[i], place + "/heights/" + std::to_string(i)));
  return checked(height_field_blob(sheet, heights, {materials_of(part, place), table_of(part, place)}), place);
}

std::shared_ptr<const SolidSurface> solid_surface(const Blob& blob) {
  auto solid = std::make_shared<SolidSurface>();
  if (blob.type() == ShapeType::mesh) {
    const auto mesh = read_triangle_mesh(blob.bytes());
    if (!mesh.ok()) return nullptr;
    take_triangles(mesh.value(), *solid);
  } else if (blob.type() == ShapeType::height_field) {
    const auto field = read_height_field(blob.bytes());
    if (!field.ok()) return nullptr;
    take_triangles(field.value(), *solid);
  }
  for (std::size_t i = 0; i < solid->triangles.size(); ++i) {
    const SolidSurface::Triangle& t = solid->triangles[i];
    const V low = min(t[0], min(t[1], t[2])), high = max(t[0], max(t[1], t[2]));
    for (int x = cell_of(low.x); x <= cell_of(high.x); ++x) {
      for (int z = cell_of(low.z); z <= cell_of(high.z); ++z) solid->cells[{x, z}].push_back(i);
    }
  }
  return solid;
}

std::vector<std::size_t> SolidSurface::near(V p, double reach) const {
  std::vector<std::size_t> found;
  for (int x = cell_of(p.x - reach); x <= cell_of(p.x + reach); ++x) {
    for (int z = cell_of(p.z - reach); z <= cell_of(p.z + reach); ++z) {
      const auto cell = cells.find({x, z});
      if (cell != cells.end()) found.insert(found.end(), cell->second.begin(), cell->second.end());
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace isostep::scenes
