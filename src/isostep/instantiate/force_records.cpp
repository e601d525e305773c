// ForceRecords<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/records/force_list.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_FORCE_RECORDS)

}  // namespace isostep
