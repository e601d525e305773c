// The triangle mesh.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/surface_shape.hpp"

namespace isostep {

/// The triangles that its blob has, see mesh_blob.
template <class S = Literal> using Mesh = SurfaceShape<S, ShapeType::mesh, TriangleMesh>;

}  // namespace isostep
