// Maps, sleep and waking in a step of World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/island_systems.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_ISLAND_SYSTEMS)

}  // namespace isostep
