// Implicit springs, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/particles/implicit_springs.inl"

#include "isostep/core/instantiate.hpp"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_IMPLICIT_SPRINGS_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
