// The step of World<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/world/engine_step.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_WORLD_STEP)

}  // namespace isostep
