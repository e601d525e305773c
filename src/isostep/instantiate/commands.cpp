// Commands that worlds execute, for every shipped scalar; the world that takes them: world.cpp.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/executing_commands.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_COMMANDS)

}  // namespace isostep
