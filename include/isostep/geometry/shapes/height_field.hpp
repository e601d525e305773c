// The height field.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/surface_shape.hpp"

namespace isostep {

/// The heights that its blob has, see height_field_blob.
template <class S = Literal> using HeightField = SurfaceShape<S, ShapeType::height_field, BakedHeightField>;

}  // namespace isostep
