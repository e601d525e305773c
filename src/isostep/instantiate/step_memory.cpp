// The memory of steps of World<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/world/resimulation/step_memory.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_STEP_MEMORY)

}  // namespace isostep
