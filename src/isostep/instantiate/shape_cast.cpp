// Shape casts and times of impact for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/shape_cast.inl"

#include "isostep/collision/continuous/plane_impact.inl"
#include "isostep/collision/continuous/shape_impact.inl"
#include "isostep/collision/continuous/time_of_impact.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)   \
  ISO_SHAPE_CAST_OF(, S)     \
  ISO_TIME_OF_IMPACT_OF(, S) \
  ISO_PLANE_IMPACT_OF(, S)   \
  ISO_SHAPE_IMPACT_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
