// The builders of bodies for a scalar: ISO_INSTANTIATE_PARTICLE_BODIES(it), inside namespace isostep.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/blob.inl"
#include "isostep/particles/bodies/bridge.inl"
#include "isostep/particles/bodies/cloth.inl"
#include "isostep/particles/bodies/platform.inl"
#include "isostep/particles/bodies/rope.inl"
#include "isostep/particles/bodies/soft_box.inl"

#define ISO_INSTANTIATE_PARTICLE_BODIES(S)                                         \
  template void remove<S>(ParticleWorld<S>&, ParticleBody&);                       \
  template ParticleBody build<S>(ParticleWorld<S>&, const RopeDefinition<S>&);     \
  template ParticleBody build<S>(ParticleWorld<S>&, const BridgeDefinition<S>&);   \
  template ParticleBody build<S>(ParticleWorld<S>&, const PlatformDefinition<S>&); \
  template ParticleBody build<S>(ParticleWorld<S>&, const ClothDefinition<S>&);    \
  template ParticleBody build<S>(ParticleWorld<S>&, const SoftBoxDefinition<S>&);  \
  template ParticleBody build<S>(ParticleWorld<S>&, const BlobDefinition<S>&);
