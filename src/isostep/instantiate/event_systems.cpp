// Systems that tell events in a step of World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/event_systems.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_EVENT_SYSTEMS)

}  // namespace isostep
