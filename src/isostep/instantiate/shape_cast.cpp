// Shape casts for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/shape_cast.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_SHAPE_CAST_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
