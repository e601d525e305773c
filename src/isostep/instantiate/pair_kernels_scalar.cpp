// The pair kernels of one lane: the reference.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_scalar.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_DEFINE_SCALAR_PAIR_KERNELS)

}  // namespace isostep
