// The fields of World<S> for every shipped scalar: apart from world.cpp, for a step has nothing of them.
// SPDX-License-Identifier: MIT
#include "isostep/world/engine_fields.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                                                                       \
  template void WorldEngine<S>::walk_fields(void*, FieldGroup, std::uint32_t, const FieldSink&); \
  template StageView WorldEngine<S>::view(std::uint32_t);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
