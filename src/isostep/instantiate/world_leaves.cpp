// The leaves of World<S> for every shipped scalar: apart from world.cpp, for a step has nothing of them.
// SPDX-License-Identifier: MIT
#include "isostep/world/engine_leaves.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) \
  template void WorldEngine<S>::walk_leaves(void*, LeafPart, std::uint32_t, const LeafSink&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
