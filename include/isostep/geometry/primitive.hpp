// Primitive: the record in which the engine stores one shape of any type.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/geometry/shape_type.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// A core box (of spheres a point, of capsules a segment along y, of hulls a blob's) thickened by a radius; or a plane,
/// cylinder or cone. It has no padding: 2 x 4 bytes and eight numbers of one width. Fields that the type does not use
/// are 0.
template <class S> struct Primitive {
  ShapeType type;
  std::uint32_t blob;    // 1 + the place of its blob, for shapes that have one; else 0
  Vec3<S> half;          // [m] half extents of the core; of a cylinder or cone its half height is y
  S radius;              // [m] added around the core, which then holds the whole shape; of a cylinder or cone its own
  Vec3<Unit<S>> normal;  // [1] half-space only
  S offset;              // [m] half-space only

  ISO_FIELDS(type, blob, half, radius, normal, offset)

  friend ISO_INLINE constexpr bool operator==(const Primitive& a, const Primitive& b) {
    return a.type == b.type && a.blob == b.blob && a.half == b.half && a.radius == b.radius && a.normal == b.normal &&
           a.offset == b.offset;
  }
};

}  // namespace isostep
