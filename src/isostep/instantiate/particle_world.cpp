// ParticleWorld<S> and its commands for every shipped scalar; its step: particle_step.cpp.
// SPDX-License-Identifier: MIT
#include "isostep/particles/particle_world.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_PARTICLE_WORLD)

}  // namespace isostep
