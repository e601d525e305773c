// Penetration by EPA for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/epa.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_EPA_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
