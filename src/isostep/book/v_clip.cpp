// V-Clip for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/book/v_clip.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_V_CLIP_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
