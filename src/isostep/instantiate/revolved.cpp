// Cylinders and cones against polyhedra, triangles, capsules and each other, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/capsule_revolved.inl"
#include "isostep/collision/narrowphase/revolved_polyhedron.inl"
#include "isostep/collision/narrowphase/revolved_revolved.inl"
#include "isostep/collision/narrowphase/revolved_triangle.inl"

namespace isostep {

#define ISO_REVOLVED(S)           \
  ISO_REVOLVED_POLYHEDRON_OF(, S) \
  ISO_REVOLVED_TRIANGLE_OF(, S)   \
  ISO_REVOLVED_REVOLVED_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_REVOLVED)

}  // namespace isostep
