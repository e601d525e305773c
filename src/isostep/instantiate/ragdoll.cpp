// add_ragdoll for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/effects/ragdoll.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_RAGDOLL_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
