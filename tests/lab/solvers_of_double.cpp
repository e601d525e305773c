// The step of the rigid world, compiled once more: src/isostep/instantiate/world_step.cpp for double alone.
// SPDX-License-Identifier: MIT
#include "isostep/world/engine_step.inl"

namespace isostep {

ISO_INSTANTIATE_WORLD_STEP(double)

}  // namespace isostep
