// Bodies of force_list.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/records/force_list.hpp"

namespace isostep {

template <class S> ForceRecords<S>::ForceRecords() = default;
template <class S> ForceRecords<S>::ForceRecords(const ForceRecords&) = default;
template <class S> ForceRecords<S>::~ForceRecords() = default;

}  // namespace isostep

#define ISO_INSTANTIATE_FORCE_RECORDS(S) template struct ForceRecords<S>;
