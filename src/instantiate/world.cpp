// World<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template class World<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
