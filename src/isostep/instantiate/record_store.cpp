// RecordStore<S> for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/records/record_store.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_RECORD_STORE)

}  // namespace isostep
