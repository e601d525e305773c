// The geometry module's functions, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_content.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/mass_tensor.inl"
#include "isostep/geometry/validate.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)    \
  ISO_HULL_CONTENT_OF(, S)    \
  ISO_CONTENT_OF(, S)         \
  ISO_MASS_PROPERTIES_OF(, S) \
  ISO_MASS_TENSOR_OF(, S)     \
  ISO_VALIDATE_OF(, S)

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
