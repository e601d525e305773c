// The contact kernels of one lane: the reference.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/contact_kernel.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_DEFINE_SCALAR_CONTACT_KERNELS)

}  // namespace isostep
