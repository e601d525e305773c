// Articulations for the shipped scalars that have the bits for them.
// SPDX-License-Identifier: MIT
#include "isostep/articulation/articulation.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_ARTICULATION_OF(, S)
ISO_IF_FLOAT(ISO_INSTANTIATE) ISO_IF_DOUBLE(ISO_INSTANTIATE) ISO_IF_Q32_32(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
