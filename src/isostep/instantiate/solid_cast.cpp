// Casts against every stored shape for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/collision/query/solid_cast.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_SOLID_CAST_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
