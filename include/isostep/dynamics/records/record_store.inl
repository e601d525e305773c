// Bodies of record_store.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/records/record_store.hpp"

namespace isostep {

template <class S> RecordStore<S>::RecordStore() = default;
template <class S> RecordStore<S>::RecordStore(const RecordStore&) = default;
template <class S> RecordStore<S>::~RecordStore() = default;

}  // namespace isostep

#define ISO_INSTANTIATE_RECORD_STORE(S) template struct RecordStore<S>;
