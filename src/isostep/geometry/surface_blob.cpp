// Meshes and height fields to bytes and back.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/surface_blob.hpp"

#include <utility>
#include <vector>

#include "isostep/scalar/math.hpp"

namespace isostep {
namespace {

Error bad_number(const char* place, const char* expected) { return {ErrorCode::invalid, expected, place}; }

/// To nearest, halves upwards.
std::int64_t steps_of(double v, int exponent) { return (floor_scaled(v, exponent + 1) + 1) >> 1; }

/// The finest grid at which magnitudes up to `most` [m] are below `limit` steps; negative: none.
int grid_exponent(double most, std::int64_t limit) {
  int exponent = TriangleMesh::kMaxExponent;
  while (exponent >= 0 && floor_scaled(most, exponent) + 1 >= limit) --exponent;
  return exponent;
}
constexpr double kMostMetres = 0x1p23 - 1;

template <class Content, class Read> std::shared_ptr<const void> content_of_bytes(Bytes bytes, Read read) {
  auto content = std::make_shared<Content>();
  auto surface = read(bytes);
  if (surface.ok()) content->surface = std::move(surface.value());
  return content;
}

}  // namespace

BlobRef mesh_blob(const TriangleMesh& mesh, BlobHome home) { return Blob::make(ShapeType::mesh, mesh.bytes(), home); }
BlobRef height_field_blob(const BakedHeightField& field, BlobHome home) {
  return Blob::make(ShapeType::height_field, field.bytes(), home);
}

Result<BlobRef> mesh_blob(std::span<const Vec3<double>> points, std::span<const MeshTriangle> triangles,
                          std::span<const std::uint8_t> materials, BlobHome home) {
  double most = 0;
  for (const Vec3<double>& p : points) {
    if (!is_finite(p) || max_abs(p) > kMostMetres)
      return bad_number("points", "a mesh's points have coordinates up to 8388607 m");
    most = max(most, max_abs(p));
  }
  const int exponent = grid_exponent(most, MeshPoint::kLimit);
  std::vector<MeshPoint> grid;
  grid.reserve(points.size());
  for (const Vec3<double>& p : points) {
    grid.push_back({static_cast<std::int32_t>(steps_of(p.x, exponent)),
                    static_cast<std::int32_t>(steps_of(p.y, exponent)),
                    static_cast<std::int32_t>(steps_of(p.z, exponent))});
  }
  const Result<TriangleMesh> mesh = triangle_mesh(grid, triangles, materials, exponent);
  if (!mesh.ok()) return mesh.error();
  return mesh_blob(mesh.value(), home);
}

Result<BlobRef> height_field_blob(const HeightSheet& sheet, std::span<const double> heights,
                                  std::span<const std::uint8_t> materials, BlobHome home) {
  const double widest = static_cast<double>(max(sheet.columns, sheet.rows)) * sheet.pitch;
  if (!(sheet.pitch > 0) || !(widest <= kMostMetres))
    return bad_number("pitch", "a height field is at most 8388607 m wide");
  double most = 0;
  for (const double h : heights) {
    if (!is_finite(h) || abs(h) > kMostMetres) return bad_number("heights", "a height field's heights are numbers");
    most = max(most, abs(h));
  }
  HeightGrid grid = {};
  const int exponent = min(grid_exponent(widest, MeshPoint::kLimit), grid_exponent(most, MeshPoint::kLimit));
  const int fine = grid_exponent(most, INT16_MAX);
  int shift = exponent > fine ? exponent - fine : 0;
  int used = exponent;
  for (; shift > static_cast<int>(BakedHeightField::kMaxHeightShift); --shift) --used;
  if (used < 0) return bad_number("heights", "a height field's heights fit 16 bits of a step");
  grid.exponent = static_cast<std::uint32_t>(used);
  grid.height_shift = static_cast<std::uint32_t>(shift);
  grid.columns = sheet.columns;
  grid.rows = sheet.rows;
  grid.pitch = static_cast<std::uint32_t>(steps_of(sheet.pitch, used));
  std::vector<std::int16_t> rounded;
  rounded.reserve(heights.size());
  for (const double h : heights) rounded.push_back(static_cast<std::int16_t>(steps_of(h, used - shift)));
  const Result<BakedHeightField> field = height_field(grid, rounded, materials);
  if (!field.ok()) return field.error();
  return height_field_blob(field.value(), home);
}

std::shared_ptr<const void> MeshContent::make(Bytes bytes) {
  return content_of_bytes<MeshContent>(bytes, read_triangle_mesh);
}
std::shared_ptr<const void> HeightFieldContent::make(Bytes bytes) {
  return content_of_bytes<HeightFieldContent>(bytes, read_height_field);
}

}  // namespace isostep
