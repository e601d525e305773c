// World<S> and its commands for every shipped scalar; its step: world_step.cpp.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

#include "isostep/instantiate/executing_commands.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_COMMANDS)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_WORLD)

}  // namespace isostep
