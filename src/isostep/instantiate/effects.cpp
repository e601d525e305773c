// Effects for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/effects/particle_coupling.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_PARTICLE_COUPLING_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
