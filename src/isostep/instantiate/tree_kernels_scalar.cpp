// The tree kernels of one lane: the reference.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernel.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_DEFINE_SCALAR_TREE_KERNELS)

}  // namespace isostep
