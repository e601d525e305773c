// Blobs: baked from points, triangles and heights, or read from files.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/blob_file.hpp"
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// Hands out a handle of the blob that was made, or tells why none was.
iso_status put_blob(const char* call, Result<BlobRef> made, iso_blob** out) {
  if (!made) {
    const ErrorCode code = made.error().code;
    const bool is_file = code == ErrorCode::truncated || code == ErrorCode::corrupt;
    return refuse(is_file ? ISO_CORRUPT : iso_status{ISO_FAULT_BAD_SHAPE}, call, made.error());
  }
  auto object = std::make_unique<BlobObject>(BlobObject{made.value()});
  *out = open_handle<iso_blob>(object.get());
  object.release();
  return kOk;
}

iso_status check(const char* call, iso_blob_home home, iso_blob** out) {
  ISO_C_REQUIRE(call, out);
  *out = nullptr;
  return home < Enumerators<BlobHome>::kCount ? kOk : refuse(ISO_BAD_ENUM, call, "home");
}

struct Materials {
  std::vector<SurfaceMaterial> table;
  SurfaceMaterials all;
};
iso_status take_materials(const char* call, const void* from, Materials& materials) {
  if (from == nullptr) return kOk;
  CSurfaceMaterials taken;
  const iso_status status = take_sized(call, from, taken);
  if (status != kOk) return status;
  if (taken.count != 0) ISO_C_REQUIRE(call, taken.numbers.at);
  if (taken.table_count != 0) ISO_C_REQUIRE(call, taken.table.at);
  for (std::size_t i = 0; i < taken.table_count; ++i) {
    const auto made = surface_material(taken.table.at[2 * i], taken.table.at[2 * i + 1]);
    if (!made) return refuse(ISO_FAULT_BAD_SHAPE, call, made.error());
    materials.table.push_back(made.value());
  }
  materials.all = SurfaceMaterials(std::span<const std::uint8_t>(taken.numbers.at, taken.count), materials.table);
  return kOk;
}

template <class S> iso_status create_hull(const void* points, std::size_t count, iso_blob_home home, iso_blob** out) {
  constexpr const char* kCall = "blob_create_hull";
  return guarded(kCall, [&] {
    const iso_status status = check(kCall, home, out);
    if (status != kOk) return status;
    if (count != 0) ISO_C_REQUIRE(kCall, points);
    std::vector<Vec3<S>> taken(count);
    for (std::size_t i = 0; i < count; ++i) {
      take_at(static_cast<const std::uint8_t*>(points) + i * sizeof(Vec3<S>), taken[i]);
    }
    return put_blob(kCall, hull_blob<S>(std::span<const Vec3<S>>(taken), static_cast<BlobHome>(home)), out);
  });
}

}  // namespace

iso_status iso_blob_create_mesh(const iso_triangles* triangles, const iso_surface_materials* materials_or_null,
                                iso_blob_home home, iso_blob** out) {
  constexpr const char* kCall = "blob_create_mesh";
  return guarded(kCall, [&] {
    iso_status status = check(kCall, home, out);
    CTriangles from;
    Materials materials;
    if (status == kOk) status = take_sized(kCall, triangles, from);
    if (status == kOk) status = take_materials(kCall, materials_or_null, materials);
    if (status != kOk) return status;
    if (from.point_count != 0) ISO_C_REQUIRE(kCall, from.points.at);
    if (from.triangle_count != 0) ISO_C_REQUIRE(kCall, from.vertices.at);
    std::vector<Vec3<double>> points(from.point_count);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {from.points.at[3 * i], from.points.at[3 * i + 1], from.points.at[3 * i + 2]};
    }
    std::vector<MeshTriangle> faces(from.triangle_count);
    for (std::size_t i = 0; i < faces.size(); ++i) std::memcpy(faces[i].vertices, from.vertices.at + 3 * i, 12);
    return put_blob(kCall, mesh_blob(points, faces, materials.all, static_cast<BlobHome>(home)), out);
  });
}

iso_status iso_blob_create_height_field(const iso_height_sheet* sheet, const iso_surface_materials* materials_or_null,
                                        iso_blob_home home, iso_blob** out) {
  constexpr const char* kCall = "blob_create_height_field";
  return guarded(kCall, [&] {
    iso_status status = check(kCall, home, out);
    CHeightSheet from;
    Materials materials;
    if (status == kOk) status = take_sized(kCall, sheet, from);
    if (status == kOk) status = take_materials(kCall, materials_or_null, materials);
    if (status != kOk) return status;
    const std::uint64_t places = std::uint64_t{from.columns} * from.rows;
    if (places > SetHeights::kMost) return refuse(ISO_FAULT_BAD_SHAPE, kCall, "columns, rows", "2^26 places at most");
    if (places != 0) ISO_C_REQUIRE(kCall, from.heights.at);
    const std::span<const double> heights(from.heights.at, static_cast<std::size_t>(places));
    const HeightSheet shape = {from.columns, from.rows, from.pitch};
    return put_blob(kCall, height_field_blob(shape, heights, materials.all, static_cast<BlobHome>(home)), out);
  });
}

iso_status iso_blob_read(const void* bytes, size_t size, iso_blob_home home, iso_blob** out) {
  constexpr const char* kCall = "blob_read";
  return guarded(kCall, [&] {
    const iso_status status = check(kCall, home, out);
    if (status != kOk) return status;
    if (size != 0) ISO_C_REQUIRE(kCall, bytes);
    const Bytes file(static_cast<const std::uint8_t*>(bytes), size);
    Result<BlobRef> read = read_blob_file(file, static_cast<BlobHome>(home));
    return read ? put_blob(kCall, read, out) : refuse(ISO_CORRUPT, kCall, read.error());
  });
}

iso_status iso_blob_write(const iso_blob* blob, void* bytes, size_t* size) {
  constexpr const char* kCall = "blob_write";
  return guarded(kCall, [&] {
    const Found<iso_blob> found(blob, kCall);
    if (found.status != kOk) return found.status;
    const std::vector<std::uint8_t> file = blob_file(*found.object->blob);
    return copy_out(kCall, file.data(), file.size(), bytes, size);
  });
}
iso_status iso_blob_get_name(const iso_blob* blob, uint64_t* low, uint64_t* high) {
  constexpr const char* kCall = "blob_get_name";
  const Found<iso_blob> found(blob, kCall);
  if (found.status != kOk) return found.status;
  ISO_C_REQUIRE(kCall, low);
  ISO_C_REQUIRE(kCall, high);
  *low = found.object->blob->id().low;
  *high = found.object->blob->id().high;
  return kOk;
}
iso_status iso_blob_get_type(const iso_blob* blob, iso_shape_type* out) {
  const Found<iso_blob> found(blob, "blob_get_type");
  if (found.status != kOk) return found.status;
  ISO_C_REQUIRE("blob_get_type", out);
  *out = static_cast<iso_shape_type>(found.object->blob->type());
  return kOk;
}
iso_status iso_blob_destroy(iso_blob* blob) { return destroy_handle(blob, "blob_destroy"); }

#define ISO_HULL(P, S)                                                                                  \
  iso_status iso_##P##_blob_create_hull(const iso_##P##_vec3* points, size_t count, iso_blob_home home, \
                                        iso_blob** out) {                                               \
    return create_hull<S>(points, count, home, out);                                                    \
  }
ISO_C_FAMILIES(ISO_HULL)
