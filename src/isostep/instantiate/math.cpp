// Mathematics for games, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/instantiate.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_MATH_OF(, S) ISO_UNIT_ROTATIONS_OF(, Unit<S>) ISO_UNIT_CURVES_OF(, Unit<S>)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
