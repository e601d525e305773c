// The builders of bodies for a scalar: ISO_INSTANTIATE_PARTICLE_BODIES(it), inside namespace isostep.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/bodies/blob.inl"
#include "isostep/particles/bodies/bridge.inl"
#include "isostep/particles/bodies/cloth.inl"
#include "isostep/particles/bodies/platform.inl"
#include "isostep/particles/bodies/rope.inl"
#include "isostep/particles/bodies/soft_box.inl"

#define ISO_INSTANTIATE_PARTICLE_BODIES(S) \
  ISO_PARTICLE_BODY_OF(, S)                \
  ISO_ROPE_OF(, S)                         \
  ISO_BRIDGE_OF(, S)                       \
  ISO_PLATFORM_OF(, S)                     \
  ISO_CLOTH_OF(, S)                        \
  ISO_SOFT_BOX_OF(, S)                     \
  ISO_BLOB_OF(, S)
