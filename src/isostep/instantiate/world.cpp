// World<S> for every shipped scalar; its commands: commands.cpp; its step: world_step.cpp.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_WORLD)

}  // namespace isostep
