// Polyhedra and their collision for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/polyhedra.inl"

#include "isostep/collision/narrowphase/gjk.inl"
#include "isostep/collision/narrowphase/round_polyhedron.inl"
#include "isostep/geometry/baked/polyhedron.inl"
#include "isostep/geometry/baked/polyhedron_surface.inl"
#include "isostep/geometry/baked/rounded_polyhedron.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)       \
  ISO_HULL_SOLID_OF(, S)         \
  ISO_POLYHEDRON_SURFACE_OF(, S) \
  ISO_ROUNDED_POLYHEDRON_OF(, S) \
  ISO_POLYHEDRA_OF(, S)          \
  ISO_GJK_OF(, S)                \
  ISO_ROUND_POLYHEDRON_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
