// Meshes and height fields as blobs: their canonical bytes, and what they are when they are read.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "isostep/geometry/baked/height_field.hpp"
#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

BlobRef mesh_blob(const TriangleMesh& mesh, BlobHome home = BlobHome::carried);
BlobRef height_field_blob(const BakedHeightField& field, BlobHome home = BlobHome::carried);

/// Makes a mesh of triangles of points [m]; see triangle_mesh. Points are rounded to the finest grid that holds all of
/// them: 2^-16 m up to 128 m from the origin, 2^-15 m up to 256 m, and so on.
/// Errors: of triangle_mesh; ErrorCode::invalid for a coordinate that is not finite or beyond 8388607 m.
Result<BlobRef> mesh_blob(std::span<const Vec3<double>> points, std::span<const MeshTriangle> triangles,
                          const SurfaceMaterials& materials = {}, BlobHome home = BlobHome::carried);

/// Heights [m] over a grid whose columns and rows are `pitch` [m] apart, by rows: column i is at x = i pitch, row k at
/// z = k pitch. The pitch is rounded to 2^-16 m or, of a large field, coarser, heights to the finest steps that hold
/// all of them in 16 bits: 2^-16 m up to 0.5 m, 2^-15 m up to 1 m, 2^-10 m up to 32 m.
/// Errors: of height_field; ErrorCode::invalid for numbers that are not finite or too large.
struct HeightSheet {
  std::uint32_t columns, rows;
  double pitch;  // [m]
};
Result<BlobRef> height_field_blob(const HeightSheet& sheet, std::span<const double> heights,
                                  const SurfaceMaterials& materials = {}, BlobHome home = BlobHome::carried);

/// The surface that a blob's bytes are, the same for all scalars. There is no surface where the bytes are none.
template <class G> struct SurfaceContent {
  std::optional<G> surface;
  static std::shared_ptr<const void> make(Bytes bytes);
  ISO_INLINE std::size_t memory() const { return sizeof *this + (surface ? surface->memory() : 0); }  // [bytes]
};
extern template struct SurfaceContent<TriangleMesh>;
extern template struct SurfaceContent<BakedHeightField>;

}  // namespace isostep
