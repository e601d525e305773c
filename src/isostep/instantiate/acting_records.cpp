// Records that act in a step of World<S>, for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/acting_records.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_ACTING_RECORDS)

}  // namespace isostep
