// Rounded hulls against polyhedra, triangles, cylinders and cones, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/rounded_polyhedra.inl"
#include "isostep/collision/narrowphase/rounded_revolved.inl"

namespace isostep {

#define ISO_ROUNDED(S)          \
  ISO_ROUNDED_POLYHEDRA_OF(, S) \
  ISO_ROUNDED_REVOLVED_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_ROUNDED)
#undef ISO_ROUNDED

}  // namespace isostep
