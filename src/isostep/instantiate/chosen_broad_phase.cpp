// The broad phase that a world chooses, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/store/chosen_broad_phase.inl"

#include "isostep/collision/broadphase/instantiate.inl"

namespace isostep {

#define ISO_IS_BROAD_PHASE(name, Structure) &&BroadPhase<Structure<S>, S>
template <class S> inline constexpr bool kAreBroadPhases = true ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_IS_BROAD_PHASE);
#define ISO_INSTANTIATE(S)           \
  static_assert(kAreBroadPhases<S>); \
  ISO_CHOSEN_BROAD_PHASE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
