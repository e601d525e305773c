// The fields of ParticleWorld<S> for every shipped scalar: apart from its own file, for a step has nothing of them.
// SPDX-License-Identifier: MIT
#include "isostep/particles/engine_fields.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                                                                          \
  template void ParticleEngine<S>::walk_fields(void*, FieldGroup, std::uint32_t, const FieldSink&); \
  template StageView ParticleEngine<S>::view(std::uint32_t);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
