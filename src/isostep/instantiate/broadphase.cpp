// The broad phase for the shipped scalars.
// SPDX-License-Identifier: MIT
#include "isostep/collision/broadphase/instantiate.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_BOX_TREES_OF)

}  // namespace isostep
