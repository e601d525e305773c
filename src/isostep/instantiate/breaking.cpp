// break_bodies for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/breaking.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) template BreakReport break_bodies<S>(World<S>&, std::uint32_t);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
