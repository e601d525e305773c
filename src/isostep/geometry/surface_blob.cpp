// Meshes and height fields to bytes and back.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/surface_blob.hpp"

#include <concepts>
#include <utility>
#include <vector>

#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {
namespace {

Error bad_number(const char* place, const char* expected) { return {ErrorCode::invalid, expected, place}; }

/// The finest grid at which magnitudes up to `most` [m] are below `limit` steps; negative where there is none.
int finest_grid(double most, std::int64_t limit) { return finest_lattice(most, limit, TriangleMesh::kMaxExponent); }
constexpr double kMostMetres = 0x1p23 - 1;

template <class G> Result<G> read(Bytes bytes) {
  if constexpr (std::same_as<G, TriangleMesh>) return read_triangle_mesh(bytes);
  else return read_height_field(bytes);
}

}  // namespace

BlobRef mesh_blob(const TriangleMesh& mesh, BlobHome home) { return Blob::make(ShapeType::mesh, mesh.bytes(), home); }
BlobRef height_field_blob(const BakedHeightField& field, BlobHome home) {
  return Blob::make(ShapeType::height_field, field.bytes(), home);
}

Result<BlobRef> mesh_blob(std::span<const Vec3<double>> points, std::span<const MeshTriangle> triangles,
                          const SurfaceMaterials& materials, BlobHome home) {
  return pin_floats([&]() -> Result<BlobRef> {
    double most = 0;
    for (const Vec3<double>& p : points) {
      if (!is_finite(p) || max_abs(p) > kMostMetres)
        return bad_number("points", "a mesh's points have coordinates up to 8388607 m");
      most = max(most, max_abs(p));
    }
    const int exponent = finest_grid(most, MeshPoint::kLimit);
    std::vector<MeshPoint> grid;
    grid.reserve(points.size());
    for (const Vec3<double>& p : points) {
      grid.push_back({static_cast<std::int32_t>(nearest_scaled(p.x, exponent)),
                      static_cast<std::int32_t>(nearest_scaled(p.y, exponent)),
                      static_cast<std::int32_t>(nearest_scaled(p.z, exponent))});
    }
    const Result<TriangleMesh> mesh = triangle_mesh(grid, triangles, materials, exponent);
    if (!mesh.ok()) return mesh.error();
    return mesh_blob(mesh.value(), home);
  });
}

Result<BlobRef> height_field_blob(const HeightSheet& sheet, std::span<const double> heights,
                                  const SurfaceMaterials& materials, BlobHome home) {
  return pin_floats([&]() -> Result<BlobRef> {
    const double widest = static_cast<double>(max(sheet.columns, sheet.rows)) * sheet.pitch;
    if (!(sheet.pitch > 0) || !(widest <= kMostMetres))
      return bad_number("pitch", "a height field is at most 8388607 m wide");
    double most = 0;
    for (const double h : heights) {
      if (!is_finite(h) || abs(h) > kMostMetres) return bad_number("heights", "a height field's heights are numbers");
      most = max(most, abs(h));
    }
    HeightGrid grid = {};
    const int exponent = min(finest_grid(widest, MeshPoint::kLimit), finest_grid(most, MeshPoint::kLimit));
    const int fine = finest_grid(most, INT16_MAX);
    int shift = exponent > fine ? exponent - fine : 0;
    int used = exponent;
    for (; shift > static_cast<int>(BakedHeightField::kMaxHeightShift); --shift) --used;
    if (used < 0) return bad_number("heights", "a height field's heights fit 16 bits of a step");
    grid.exponent = static_cast<std::uint32_t>(used);
    grid.height_shift = static_cast<std::uint32_t>(shift);
    grid.columns = sheet.columns;
    grid.rows = sheet.rows;
    grid.pitch = static_cast<std::uint32_t>(nearest_scaled(sheet.pitch, used));
    std::vector<std::int16_t> rounded;
    rounded.reserve(heights.size());
    for (const double h : heights) rounded.push_back(static_cast<std::int16_t>(nearest_scaled(h, used - shift)));
    const Result<BakedHeightField> field = height_field(grid, rounded, materials);
    if (!field.ok()) return field.error();
    return height_field_blob(field.value(), home);
  });
}

template <class G> std::shared_ptr<const void> SurfaceContent<G>::make(Bytes bytes) {
  auto content = std::make_shared<SurfaceContent>();
  Result<G> surface = read<G>(bytes);
  if (surface.ok()) content->surface = std::move(surface.value());
  return content;
}
template struct SurfaceContent<TriangleMesh>;
template struct SurfaceContent<BakedHeightField>;

}  // namespace isostep
