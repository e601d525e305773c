// The body kernels of one lane: the reference.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_DEFINE_SCALAR_BODY_KERNELS)

}  // namespace isostep
