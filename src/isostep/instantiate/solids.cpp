// The pairs of all solids, and of them with triangles, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/solid_pairs.inl"
#include "isostep/collision/narrowphase/solid_triangle.inl"

namespace isostep {

#define ISO_SOLIDS(S)     \
  ISO_SOLID_PAIRS_OF(, S) \
  ISO_SOLID_TRIANGLE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_SOLIDS)

}  // namespace isostep
