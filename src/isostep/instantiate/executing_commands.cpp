// What commands do to World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/world/executing_commands.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_COMMANDS)

}  // namespace isostep
