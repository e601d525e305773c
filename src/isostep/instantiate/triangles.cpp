// Contacts with triangles of surfaces for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/polyhedron_triangle.inl"
#include "isostep/collision/narrowphase/round_triangle.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)   \
  ISO_ROUND_TRIANGLE_OF(, S) \
  ISO_POLYHEDRON_TRIANGLE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
