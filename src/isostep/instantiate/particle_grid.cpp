// The particles' grid for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/particles/grid.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class ParticleGrid<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
