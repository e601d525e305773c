// same_bits: whether records, tables and lists of two states are equal, bit for bit.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "isostep/core/paged_array.hpp"
#include "isostep/core/slot_map.hpp"
#include "isostep/state/pack.hpp"

namespace isostep::detail {

template <class Record> ISO_INLINE bool same_bits(const Record& a, const Record& b) {
  if constexpr (kHasNoPadding<Record>) {
    return std::memcmp(&a, &b, sizeof(Record)) == 0;
  } else {
    std::uint8_t bytes_a[kPackedSize<Record>], bytes_b[kPackedSize<Record>];
    pack(bytes_a, a);
    pack(bytes_b, b);
    return std::memcmp(bytes_a, bytes_b, sizeof bytes_a) == 0;
  }
}
template <class Record> ISO_INLINE bool same_bits(const std::vector<Record>& a, const std::vector<Record>& b) {
  if (a.size() != b.size()) return false;
  if constexpr (kHasNoPadding<Record>) {
    return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Record)) == 0;
  } else {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!same_bits(a[i], b[i])) return false;
    }
    return true;
  }
}

/// Calls visit(index) for every item that only one of two arrays has, or that same(a, b) denies. Skips shared pages.
template <class T, std::uint32_t kPageSize, class Same, class Visit>
ISO_INLINE void each_other(const PagedArray<T, kPageSize>& a, const PagedArray<T, kPageSize>& b, const Same& same,
                           const Visit& visit) {
  const std::size_t most = a.size() < b.size() ? b.size() : a.size(),
                    common = a.size() < b.size() ? a.size() : b.size();
  for (std::size_t i = 0; i < most; ++i) {
    if (i % kPageSize == 0 && a.shares_page(i / kPageSize, b)) i += kPageSize - 1;
    else if (i >= common || !same(a[i], b[i])) visit(i);
  }
}
template <class T, std::uint32_t kPageSize, class Same>
ISO_INLINE bool all_same(const PagedArray<T, kPageSize>& a, const PagedArray<T, kPageSize>& b, const Same& same) {
  bool equal = true;
  each_other(a, b, same, [&](std::size_t) ISO_INLINE_LAMBDA { equal = false; });
  return equal;
}
ISO_INLINE bool all_same(const SlotMap& a, const SlotMap& b) {
  return a.first_free() == b.first_free() &&
         all_same(a.entries(), b.entries(),
                  [](const SlotEntry& x, const SlotEntry& y) ISO_INLINE_LAMBDA { return same_bits(x, y); });
}
/// Islands and shapes never change once they are made, and states share them.
struct SameObject {
  template <class T>
  ISO_INLINE bool operator()(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) const {
    return a == b;
  }
};

}  // namespace isostep::detail
