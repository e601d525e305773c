// The coarse structures beside the tree of boxes, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/collision/broadphase/instantiate.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_COARSE_STRUCTURES_OF)

#define ISO_IS_BROAD_PHASE(name, Structure) &&BroadPhase<Structure<S>, S>
template <class S> inline constexpr bool kAreBroadPhases = true ISO_FOR_EACH_BROAD_PHASE(ISO_IS_BROAD_PHASE);
#define ISO_CHECK(S) static_assert(kAreBroadPhases<S>);
ISO_FOR_EACH_SCALAR(ISO_CHECK)
#undef ISO_CHECK

}  // namespace isostep
