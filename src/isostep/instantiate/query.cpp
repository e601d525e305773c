// The collision queries, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) \
  ISO_RAY_CAST_OF(, S)     \
  ISO_CLOSEST_POINT_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
