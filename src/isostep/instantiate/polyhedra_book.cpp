// What the step does not use of polyhedra: penetration by EPA, and distance by V-Clip, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/epa.inl"
#include "isostep/collision/narrowphase/v_clip.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) \
  ISO_EPA_OF(, S)          \
  ISO_V_CLIP_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
