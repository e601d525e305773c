// The step of ParticleWorld<S>, and stiff springs, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/particles/engine_step.inl"
#include "isostep/particles/stiff_spring.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) \
  ISO_STIFF_SPRING_OF(, S) \
  ISO_INSTANTIATE_PARTICLE_STEP(S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
