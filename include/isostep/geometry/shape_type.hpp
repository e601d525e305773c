// The closed list of shapes. To add one: its line here, its file in shapes/, and what collision/README.md says.
// Whatever is missing does not compile.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

/// ISO_FOR_EACH_SHAPE(X) expands X(name, Shape): the name in ShapeType and in scene files, and the class.
#define ISO_FOR_EACH_SHAPE(X)                                                                                       \
  X(sphere, Sphere)                                                                                                 \
  X(box, Box) X(capsule, Capsule) X(half_space, HalfSpace) X(hull, Hull) X(mesh, Mesh) X(height_field, HeightField) \
      X(cylinder, Cylinder) X(cone, Cone)

namespace isostep {

#define ISO_ENUMERATOR(name, Shape) name,
enum class ShapeType : std::uint32_t { ISO_FOR_EACH_SHAPE(ISO_ENUMERATOR) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name, Shape) #name,
inline constexpr const char* kShapeNames[] = {ISO_FOR_EACH_SHAPE(ISO_NAME)};
#undef ISO_NAME
inline constexpr int kShapeTypes = sizeof kShapeNames / sizeof kShapeNames[0];

}  // namespace isostep
