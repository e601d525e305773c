// Bodies of pieces for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/shatter.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_SHATTER_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
