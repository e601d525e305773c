// The narrow phase for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/collide.inl"

namespace isostep {

#define ISO_NARROWPHASE(S)     \
  ISO_SPHERE_PAIRS_OF(, S)     \
  ISO_BOX_BOX_OF(, S)          \
  ISO_BOX_CAPSULE_OF(, S)      \
  ISO_CAPSULE_PAIRS_OF(, S)    \
  ISO_HALF_SPACE_PAIRS_OF(, S) \
  ISO_HULL_PAIRS_OF(, S)       \
  ISO_SURFACE_PAIRS_OF(, S)    \
  ISO_COLLIDE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_NARROWPHASE)

}  // namespace isostep
