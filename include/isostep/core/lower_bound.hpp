// Binary search: over indices, and of records that ascend by slot.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Returns the first of 0..count-1 for which before(index) is false, or count. `before` is true for the indices below.
template <class Before> ISO_INLINE constexpr std::size_t lower_bound(std::size_t count, const Before& before) {
  std::size_t low = 0, high = count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (before(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}

/// Returns the index at which the record of a slot stands or belongs. `records` ascend by their field `slot`.
template <class Records> ISO_INLINE std::size_t place_of_slot(const Records& records, std::uint32_t slot) {
  return lower_bound(records.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return records[i].slot < slot; });
}
/// Returns the record of `fresh`'s slot. If there is none yet, inserts `fresh` at its place and returns that.
template <class Record> ISO_INLINE Record& find_or_insert(std::vector<Record>& records, const Record& fresh) {
  const std::size_t at = place_of_slot(records, fresh.slot);
  if (at == records.size() || records[at].slot != fresh.slot)
    records.insert(records.begin() + static_cast<std::ptrdiff_t>(at), fresh);
  return records[at];
}

}  // namespace isostep
