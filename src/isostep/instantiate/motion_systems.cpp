// Systems that look after motion in a step of World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/motion_systems.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_MOTION_SYSTEMS)

}  // namespace isostep
