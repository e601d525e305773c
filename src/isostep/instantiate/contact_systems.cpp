// The systems that find contacts in a step of World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/contact_systems.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_CONTACT_SYSTEMS)

}  // namespace isostep
