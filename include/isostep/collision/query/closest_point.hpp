// The point of a primitive's surface that is closest to a given one.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Returns the surface point closest to `query` [m], world frame, from outside or inside.
/// Error:  fixed: point and distance within 4 raw units; float, double: 4 ulp of the largest coordinate. The normal is
///         as good as that error over the distance to the core (centre, segment or box).
/// Order:  where several points are closest, a box takes the lowest axis, towards plus from its very centre; a
///         sphere's centre and a capsule's segment take local +x.
template <class S>
ClosestPoint<S> closest_point(std::type_identity_t<ShapeView<S>> shape, const Transform<S>& transform, Vec3<S> query);

#define ISO_CLOSEST_POINT_OF(extern, S) \
  extern template ClosestPoint<S> closest_point<S>(ShapeView<S>, const Transform<S>&, Vec3<S>);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CLOSEST_POINT_OF)

}  // namespace isostep
