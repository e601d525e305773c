// Rounded hulls against polyhedra and triangles, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/rounded_polyhedra.inl"

namespace isostep {

#define ISO_ROUNDED(S) ISO_ROUNDED_POLYHEDRA_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_ROUNDED)
#undef ISO_ROUNDED

}  // namespace isostep
