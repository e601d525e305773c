// World<S> for every shipped scalar; its step: world_step.cpp, its commands: executing_commands.cpp.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_WORLD)

}  // namespace isostep
