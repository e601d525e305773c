// The coarse structures beside the tree of boxes, for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/book/instantiate.inl"
#include "isostep/core/instantiate.hpp"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_COARSE_STRUCTURES_OF)

}  // namespace isostep
