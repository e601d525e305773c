// The collision queries, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                                                                       \
  template bool ray_cast<S>(ShapeView<S>, const Transform<S>&, Vec3<S>, Vec3<S>, S, RayHit<S>&); \
  template ClosestPoint<S> closest_point<S>(ShapeView<S>, const Transform<S>&, Vec3<S>);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
