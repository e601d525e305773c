// The narrow phase for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/collide.inl"

namespace isostep {

#define ISO_PAIR(name, S)                                                                                      \
  template void name<S>(const Primitive<S>&, const Transform<S>&, const Primitive<S>&, const Transform<S>&, S, \
                        Manifold<S>&);
#define ISO_NARROWPHASE(S)                \
  ISO_PAIR(collide_sphere_sphere, S)      \
  ISO_PAIR(collide_sphere_box, S)         \
  ISO_PAIR(collide_sphere_capsule, S)     \
  ISO_PAIR(collide_sphere_half_space, S)  \
  ISO_PAIR(collide_box_box, S)            \
  ISO_PAIR(collide_box_capsule, S)        \
  ISO_PAIR(collide_box_half_space, S)     \
  ISO_PAIR(collide_capsule_capsule, S)    \
  ISO_PAIR(collide_capsule_half_space, S) \
  ISO_HULL_PAIRS_OF(, S)                  \
  ISO_SURFACE_PAIRS_OF(, S)               \
  ISO_COLLIDE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_NARROWPHASE)

}  // namespace isostep
