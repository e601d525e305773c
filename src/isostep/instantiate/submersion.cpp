// The part of a shape below a plane, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/submersion.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_SUBMERSION_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
